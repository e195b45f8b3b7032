// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "common/base/result.h"

namespace selvage {

/// `selvage-client compare`: are two meshes the same up to the numbering of vertices and triangles? Either
/// may be a mesh file or a pack.
struct CompareCommand {
  std::filesystem::path a, b;
  std::optional<double> tolerance;  ///< model units on each axis; default: half a grid step
  int bits = 14;                    ///< the grid, where neither is a pack
  bool json = false;
};

/// True if they are the same. Prints the verdict on stdout.
Result<bool> run(const CompareCommand& command);

}  // namespace selvage
