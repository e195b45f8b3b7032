// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/mesh_io/mesh_file.h"
#include "server/ingest/parts.h"
#include "server/segment/segment.h"

namespace CLI {
class App;
}

namespace selvage {

/// MODEL and the options that say how it is cut, as `build` and `segment` share them.
struct SegmentationOptions {
  std::filesystem::path model;
  SegmentOptions segment;
  std::vector<std::string> by = {"shape"};  ///< --segment-by: what, and the file of labels

  /// Adds them to a subcommand, which they must outlive.
  void add_to(CLI::App& command);
  /// The parts that --segment-by asks for; none for shape. Errors name the file.
  Result<Parts> load_parts(const MeshFile& file) const;
};

}  // namespace selvage
