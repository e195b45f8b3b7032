// SPDX-License-Identifier: MIT
//
// Sews regions together (dissertation Ch. 5.2.2): add regions and bundles in any order, ask for the mesh so
// far. A boundary triangle appears as soon as all regions that it touches are there; vertices that were cut
// apart at non-manifold spots are one again as soon as two of them are there. With everything added at the
// finest level the mesh is the input, up to the order of vertices and triangles.
//
// Regions may be at any levels of detail, and may go or change their level at any time. A boundary triangle
// names vertices of the finest loops; each region says which of its own vertices stand for them, and a
// triangle whose corners meet in one is left out. So every mix is as watertight as the model.
//
//     stitcher.add_region(3, coarse, 1);
//     draw(stitcher.take_update());
//     stitcher.add_region(3, fine, 0);     // region 3 and the joins around it change, nothing else
//     draw(stitcher.take_update());
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "client/stitch/stitch_update.h"
#include "client/stitch/vertex_numbers.h"
#include "common/base/result.h"
#include "common/codec/bundle.h"
#include "common/codec/region_mesh.h"
#include "common/mesh/triangle_soup.h"
#include "common/pack/directory.h"

namespace selvage {

struct StitchedMesh {
  TriangleSoup soup;                       ///< model units, the file's own orientation
  std::vector<RegionId> region_of_vertex;  ///< of a vertex that several regions share, the lowest
};

class Stitcher {
 public:
  /// `directory` is borrowed and must outlive the stitcher.
  explicit Stitcher(const Directory& directory)
      : directory_(directory), joins_of_region_(directory.regions.size()) {}

  /// BadStream if the region's loops are not those that the directory states: joins would name other
  /// vertices. A region added again replaces the one before, whatever the levels.
  /// Takes time linear in the region, not in what else is there.
  Result<void> add_region(RegionId region, RegionMesh mesh, std::uint8_t level = 0);
  /// A region that is not there is no error.
  void remove_region(RegionId region);
  /// BadStream if a corner is beyond its region's loops. A bundle added again replaces the one before.
  Result<void> add_bundle(RegionId region, std::vector<BoundaryTriangle> triangles);

  std::vector<RegionId> regions() const;  ///< that are there, ascending
  /// Nothing if the region is not there.
  std::optional<std::uint8_t> level_of(RegionId region) const;

  /// What has changed since the last call, from nothing to begin with. Takes time in proportion to the
  /// regions that changed and the joins around them (and to the logarithm of all that is there).
  StitchUpdate take_update();
  /// Vertex numbers of updates are below.
  std::uint32_t vertex_bound() const { return numbers_.bound(); }
  /// Vertices and triangles that add_*, remove_region and take_update have looked at so far.
  std::uint64_t elements_visited() const { return elements_visited_; }

  /// The mesh so far, built anew: linear in what was added. Depends only on the regions, their levels and the
  /// bundles that are there, not on the way they came. Vertices are numbered through, unlike those of
  /// updates.
  StitchedMesh mesh() const;

 private:
  struct Region {
    RegionMesh mesh;
    std::uint8_t level = 0;
    std::vector<VertexId> numbers;  ///< by vertex of `mesh`
  };
  using JoinKey = std::array<RegionId, 3>;  ///< as PatchId::regions
  using Joins = std::map<JoinKey, std::vector<BoundaryTriangle>>;

  void note_change(RegionId region);
  void remove_bundle(RegionId region);
  Vec3 position_of(const VertexOwner& owner) const;
  std::vector<Triangle> triangles_of(const Region& region) const;
  std::vector<Triangle> triangles_of(const Joins::value_type& join) const;
  void list_vertices(StitchUpdate& update);
  void list_patches(StitchUpdate& update);

  const Directory& directory_;
  std::map<RegionId, Region> regions_;
  Joins joins_;  ///< highest region first: a bundle's lie together
  std::vector<std::set<JoinKey>> joins_of_region_;
  VertexNumbers numbers_;

  // Since the last update.
  std::set<RegionId> changed_regions_;
  std::set<JoinKey> changed_joins_;
  std::vector<bool> is_published_;  ///< by vertex number: an update has listed it
  std::set<PatchId> published_patches_;
  std::uint64_t elements_visited_ = 0;
};

}  // namespace selvage
