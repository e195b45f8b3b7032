// SPDX-License-Identifier: MIT
//
// Sews regions together (dissertation Ch. 5.2.2): add regions and bundles in any order, ask for the mesh so
// far. A boundary triangle appears as soon as all regions that it touches are there; vertices that were cut
// apart at non-manifold spots are one again as soon as two of them are there. With everything added the mesh
// is the input, up to the order of vertices and triangles.
#pragma once

#include <map>
#include <vector>

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
  explicit Stitcher(const Directory& directory) : directory_(directory) {}

  /// BadStream if the region's loops are not those that the directory states: joins would name other
  /// vertices. A region added again replaces the one before.
  Result<void> add_region(RegionId region, RegionMesh mesh);
  /// BadStream if a corner is beyond its region's loops.
  Result<void> add_bundle(RegionId region, std::vector<BoundaryTriangle> triangles);

  const std::map<RegionId, RegionMesh>& regions() const { return regions_; }

  /// The mesh so far, built anew: linear in what was added.
  StitchedMesh mesh() const;

 private:
  const Directory& directory_;
  std::map<RegionId, RegionMesh> regions_;
  std::map<RegionId, std::vector<BoundaryTriangle>> bundles_;
};

}  // namespace selvage
