// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "common/base/result.h"
#include "server/simplify/simplify.h"

namespace selvage {

/// `selvage-pack simplify`: a mesh file in, the same model with fewer triangles out. Needs no pack and no
/// segmentation. At least one of the three limits is set; where several are, the first one met ends it.
struct SimplifyCommand {
  std::filesystem::path model;
  std::filesystem::path output;            ///< the extension names the format
  std::optional<double> ratio;             ///< of the file's triangles, 0..1
  std::optional<std::uint32_t> triangles;  ///< that may be left
  std::optional<double> error;             ///< largest deviation, in units of the model
  bool json = false;
  SimplifyOptions options;
};

/// Writes the mesh and prints what became of it on stdout; notes about the input go to stderr.
Result<void> run(const SimplifyCommand& command);

}  // namespace selvage
