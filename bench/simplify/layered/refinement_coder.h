// SPDX-License-Identifier: MIT
//
// A layered coder for a region's levels: the coarsest as a part that stands alone, every finer one as what
// leads to it from the next coarser. A part is the low bits that the coarser level's coordinates lacked, and
// then the splits (refinement_walk.h).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bench/simplify/layered/refinement_walk.h"
#include "bench/simplify/layered/split_plan.h"
#include "common/codec/region_mesh.h"
#include "common/coding/byte_io.h"
#include "common/coding/entropy_encoder.h"

namespace selvage::bench {

/// What a directory says of one level.
struct LayerSize {
  std::uint32_t vertices = 0, triangles = 0;
  int dropped_bits = 0;
};

/// A region as its coarsest level came out of its part, about to grow.
GrowingRegion start_growing(const RegionMesh& base, std::span<const std::uint32_t> finest_loop_lengths,
                            const LayerSize& coarsest, const LayerSize& finest);
/// The region as it is now.
RegionMesh grown(const GrowingRegion& region, std::span<const std::uint32_t> finest_loop_lengths,
                 const LayerSize& level);

/// False if the bytes are no such part. Bounded by the sizes whatever the bytes; that positions lie in a box
/// is not looked at.
bool decode_layer(std::span<const std::byte> bytes, const LayerSize& coarse, const LayerSize& fine,
                  bool is_finest, const RefinementTables& tables, GrowingRegion& region);

/// For training.
struct LayerWatch {
  std::function<void(const PlaceModel::Features&, IntLanes position)> on_place;
  std::function<void(const Surroundings&, const CodedResidual&)> on_residual;
};

class LayerEncoder {
 public:
  /// `positions` by the finest region's vertex, with all bits. `source_of_vertex` is that vertex by the
  /// base's own number; `corner_of_base` the finest region's corner by the base's corner.
  LayerEncoder(GrowingRegion& region, std::span<const GridPoint> positions,
               std::vector<VertexId> source_of_vertex, const CornerTable& finest,
               std::span<const CornerId> corner_of_base);

  EntropyEncoder encode(const std::vector<PlannedSplit>& splits, const LayerSize& coarse,
                        const LayerSize& fine, bool is_finest, const RefinementTables& tables,
                        const LayerWatch* watch = nullptr);

  const std::vector<VertexId>& source_of_vertex() const { return source_of_vertex_; }

  // What the walk asks.
  SplitChoice wanted(VertexId v);
  unsigned symbol(unsigned model, unsigned value) { return out_.symbol(model, value), value; }
  std::uint32_t number(unsigned model, std::uint32_t value) { return out_.number(model, value), value; }
  IntLanes position(const Predictor& sizes, const Surroundings& around, const PlaceModel::Features& features,
                    std::uint32_t& tangential, std::uint32_t& normal);
  void is_split(std::uint32_t triangles);

 private:
  GrowingRegion& region_;
  std::span<const GridPoint> positions_;
  std::vector<VertexId> source_of_vertex_;
  std::vector<CornerId> local_of_corner_;  ///< of the growing region, by the finest region's
  const std::vector<PlannedSplit>* splits_ = nullptr;
  std::vector<std::uint32_t> waits_for_, ready_;  ///< how many, by split; splits that wait for none
  std::uint32_t current_ = 0;                     ///< the split in hand
  int dropped_bits_ = 0;
  EntropyEncoder out_;
  const LayerWatch* watch_ = nullptr;
};

}  // namespace selvage::bench
