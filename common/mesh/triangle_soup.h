// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/mesh/vec3.h"

namespace selvage {

/// Three vertex indices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// A triangle mesh as a file states it: the file's own vertex indices, its own order, nothing implied about
/// manifoldness. What a reader gives, what a writer takes, and what "lossless" is judged against.
/// Invariant (readers check it): indices are within `positions`, coordinates are finite.
struct TriangleSoup {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
};

}  // namespace selvage
