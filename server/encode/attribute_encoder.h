// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "common/codec/region_format.h"
#include "common/codec/region_mesh.h"
#include "common/coding/entropy_encoder.h"

namespace selvage {

/// A region's connectivity as the decoder will number it.
struct CodingOrder {
  std::vector<VertexId> vertices;  ///< of the table, in their new order
  std::vector<Triangle> triangles;
  BoundaryLoops loops;
};

/// The positions of a region whose connectivity the decoder already has (docs/FORMAT.md, "Region part");
/// `box` holds them all. Gives what the decoder will make of the connectivity.
/// Mirror: client/decode/attribute_decoder.h.
CodingOrder encode_positions(const FanTable& table, std::span<const GridPoint> positions, const GridBox& box,
                             const CodecTables& tables, EntropyEncoder& out);
/// Positions that no triangle connects.
void encode_loose_positions(std::span<const GridPoint> positions, const GridBox& box, EntropyEncoder& out);

/// What follows the positions.
void encode_turned_and_anchors(const RegionMesh& mesh, EntropyEncoder& out);

}  // namespace selvage
