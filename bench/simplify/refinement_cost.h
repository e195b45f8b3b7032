// SPDX-License-Identifier: MIT
//
// What a level of a region would take if the next coarser one were there already: an estimate of a layered
// coder, by ideal adaptive codes.
//
// The finer level's connectivity comes as it does now. Then, for each of its vertices, whether the coarser
// level keeps it, and of one that goes a neighbour that it goes to. Contracting those edges gives the coarser
// level's connectivity, and with it which vertex is which: the positions of those kept are known but for low
// bits. The others are predicted from all neighbours that are known, most of which lie all around.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"

namespace selvage::bench {

/// One region at the finer of two levels. Vertices are its own.
struct Refinement {
  CornerTable table;
  std::vector<Vec3> positions;           ///< in cells of the finer level, whole numbers
  std::vector<VertexId> representative;  ///< at the coarser level, itself where it stays
};

/// Symbols with counts by context, each coded by the share that it has had so far.
class AdaptiveCode {
 public:
  double bits(std::uint64_t context, unsigned symbol, unsigned symbols);

 private:
  std::map<std::uint64_t, std::vector<double>> counts_;
};

struct RefinementBits {
  double kept_flags = 0, targets = 0, positions = 0;
  std::uint32_t vertices = 0, new_vertices = 0;
};

/// All regions of a model at one pair of levels, so that statistics serve for all of them, as trained tables
/// do.
RefinementBits refinement_bits(std::span<const Refinement> regions);

}  // namespace selvage::bench
