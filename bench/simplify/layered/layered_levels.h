// SPDX-License-Identifier: MIT
//
// A model's regions as both coders want them: each level on its own, and the splits between levels.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/simplify/labelled_levels.h"
#include "bench/simplify/layered/refinement_coder.h"
#include "bench/simplify/layered/split_plan.h"
#include "client/decode/region_decoder.h"
#include "common/codec/region_mesh.h"

namespace selvage::bench {

/// One region. Vertices and corners are its own at the finest level, but for those of `base_mesh`.
struct LayeredRegion {
  CornerTable finest;
  std::vector<GridPoint> positions;
  std::vector<std::uint32_t> loop_lengths;            ///< of the finest level
  std::vector<VertexId> vertex_of_boundary;           ///< of the finest level
  std::vector<LayerSize> sizes;                       ///< by level
  std::vector<std::vector<VertexId>> representative;  ///< by level
  std::vector<Layer> layers;                          ///< finest first

  /// By level, as the pack has them; empty if the level repeats the one before.
  std::vector<Bytes> alone;
  std::vector<DecodeLimits> alone_limits;  ///< borrows `loop_lengths`

  Bytes base;  ///< the coarsest level, alone
  DecodeLimits base_limits;
  RegionMesh base_mesh;
  std::vector<VertexId> source_of_base;
  std::vector<CornerId> corner_of_base;
};

struct LayeredModel {
  std::vector<LayeredRegion> regions;
  std::size_t one_level_bytes = 0, alone_bytes = 0;  ///< of packs
  std::uint32_t vertices = 0;                        ///< of all regions at the finest level
  int refined_precisions =
      0;  ///< levels that drop fewer bits than alone, so as not to drop fewer than a finer one
};

LayeredModel make_layered_model(const LabelledMesh& mesh, int bits);

}  // namespace selvage::bench
