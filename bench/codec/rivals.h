// SPDX-License-Identifier: MIT
//
// Other people's coders on the same integers: Draco, and meshoptimizer followed by zstd.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/mesh/triangle_soup.h"
#include "common/mesh/vec3.h"

namespace selvage::bench {

/// A mesh on the grid as rivals take it.
struct GridMesh {
  std::vector<GridPoint> positions;
  std::vector<Triangle> triangles;
};

/// Draco's Edgebreaker at a compression level, 0..10. Positions are given as floats that are whole numbers
/// and quantised on exactly that grid.
std::vector<char> draco_encode(const GridMesh& mesh, int level, int bits);
/// Positions and indices out; gives the number of triangles.
std::size_t draco_decode(const std::vector<char>& bytes);

/// meshoptimizer's vertex cache order, index and vertex codecs, then zstd -19. 16-bit coordinates.
std::size_t meshoptimizer_size(const GridMesh& mesh);

std::size_t zstd_size(std::span<const std::byte> bytes);

}  // namespace selvage::bench
