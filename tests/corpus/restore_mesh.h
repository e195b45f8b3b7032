// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

#include "common/base/result.h"

namespace selvage {

/// What came of sending one mesh through the whole system.
struct Restoration {
  std::uint32_t vertices = 0, triangles = 0, regions = 0;
  std::uint64_t pack_bytes = 0;
  double pack_seconds = 0, fetch_seconds = 0;
  std::string failure;  ///< empty: every subset had the triangles it must have, and the whole is exact
};

/// Packs the file, serves it on loopback, fetches random subsets of its regions in random order, then the
/// rest, stitches, and compares with the file's own triangles; then regions at random levels, which must
/// leave no hole that the file has not. An error means that the file was refused as a mesh.
Result<Restoration> restore_mesh(const std::filesystem::path& path, std::uint32_t seed);

}  // namespace selvage
