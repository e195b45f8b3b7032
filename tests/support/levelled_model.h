// SPDX-License-Identifier: MIT
//
// A segmented and simplified model, in memory as a client has it after decoding, beside what its stitched mix
// must be by definition: the finest mesh with every corner replaced by its representative.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/codec/bundle.h"
#include "common/codec/region_mesh.h"
#include "common/coding/byte_io.h"
#include "common/pack/directory.h"
#include "server/ingest/repair.h"
#include "server/segment/partition.h"
#include "server/simplify/levels.h"

namespace selvage {

/// No level: the region is not there.
inline constexpr std::uint32_t kAbsent = 0xFFFFFFFFu;

struct LevelledModel {
  std::string name;
  RepairedMesh mesh;
  Partition partition;
  LevelledMesh levels;
  /// Grid of step 1 from the origin: a vertex's x says which of the file's vertices it is.
  Directory directory;
  std::vector<std::vector<BoundaryTriangle>> bundles;  ///< by region

  std::uint32_t level_count() const { return static_cast<std::uint32_t>(levels.regions.size()); }
  std::uint32_t region_count() const { return partition.region_count; }

  RegionMesh region(RegionId id, std::uint32_t level) const;

  /// The mix's triangles in the file's vertices, as the file turns them, each from its lowest vertex, sorted.
  /// A level for every region, 0 included.
  std::vector<Triangle> mix(std::span<const std::uint32_t> level_of_region) const;

 private:
  friend LevelledModel levelled_model(std::string name, RepairedMesh mesh,
                                      std::span<const std::uint32_t> label_of_vertex,
                                      std::span<const double> ratios);
  std::vector<std::vector<VertexId>> boundary_of_region_;  ///< finest loops
  std::vector<std::uint32_t> group_of_vertex_;             ///< weld groups; kNone for what is no copy
};

/// Any label a vertex of `mesh`, made codable. Level 0 is the finest, then one a ratio of triangles.
LevelledModel levelled_model(std::string name, RepairedMesh mesh,
                             std::span<const std::uint32_t> label_of_vertex, std::span<const double> ratios);

/// The model as a pack, on a grid of its own positions; its levels keep all bits.
Bytes levelled_pack(const LevelledModel& model, int bits);

/// Each triangle from its lowest vertex, all sorted: equal for meshes that differ in order only.
std::vector<Triangle> in_canonical_order(std::vector<Triangle> triangles);

}  // namespace selvage
