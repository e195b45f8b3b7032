// SPDX-License-Identifier: MIT
//
// Makes neighbours agree which side is out. Files turn whole patches, or single triangles, the wrong way
// round; cutting at each such edge would shred the mesh, so triangles are turned instead and remembered.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/triangle_soup.h"

namespace selvage {

struct Orientation {
  std::vector<bool> is_turned;  ///< by triangle
  std::uint32_t turned_triangles = 0;
  std::uint32_t cut_edges = 0;  ///< where a piece is not orientable
};

/// Chooses for every edge-connected piece the orientation that turns fewer triangles; on a tie the piece's
/// first triangle stays. A piece that is not orientable is cut: those entries of `across` become kNone.
/// The cuts never tear a patch that the file orients alike, so a Möbius strip is cut exactly where its file
/// flips. Linear time.
Orientation orient(std::span<const Triangle> triangles, std::span<CornerId> across);

}  // namespace selvage
