// SPDX-License-Identifier: MIT
#include "client/stitch/stitcher.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

namespace selvage {
namespace {

/// Where each present region's vertices go in the stitched mesh.
class VertexMap {
 public:
  explicit VertexMap(const std::map<RegionId, RegionMesh>& regions) {
    std::unordered_map<std::uint32_t, VertexId> vertex_of_group;
    for (const auto& [id, mesh] : regions) {
      std::vector<VertexId>& map = vertex_of_region_[id];
      map.assign(mesh.table.vertex_count(), kNone);
      for (const Anchor& anchor : mesh.anchors) {
        const auto [it, is_first] = vertex_of_group.try_emplace(anchor.group, count_);
        count_ += is_first;
        map[anchor.vertex] = it->second;
      }
      for (VertexId& v : map) {
        if (v == kNone) v = count_++;
      }
    }
  }

  std::uint32_t count() const { return count_; }
  const std::vector<VertexId>& of(RegionId region) const { return vertex_of_region_.at(region); }

 private:
  std::map<RegionId, std::vector<VertexId>> vertex_of_region_;
  std::uint32_t count_ = 0;
};

/// On coarser levels a triangle may have lost a corner to its neighbour, or lie between copies of one vertex.
void append_triangle(TriangleSoup& soup, Triangle triangle, bool is_turned) {
  const auto [a, b, c] = triangle;
  if (a == b || b == c || c == a) return;
  if (is_turned) std::swap(triangle[1], triangle[2]);
  soup.triangles.push_back(triangle);
}

Vec3 position_of(const RegionMesh& region, VertexId v, const Grid& grid) {
  if (region.exact.empty()) return grid.position(region.positions[v]);
  const ExactPosition& exact = region.exact[v];
  return {exact[0], exact[1], exact[2]};
}

}  // namespace

Result<void> Stitcher::add_region(RegionId region, RegionMesh mesh) {
  // A level that leaves boundary vertices out has shorter loops; its map was checked when it was decoded.
  const bool is_finest = mesh.vertex_of_boundary == mesh.loops.vertices;
  const bool is_sound =
      region < directory_.regions.size() &&
      (is_finest ? mesh.loops.lengths == directory_.regions[region].loop_lengths
                 : mesh.vertex_of_boundary.size() == directory_.regions[region].boundary_vertices());
  if (!is_sound) {
    return fail(ErrorCode::BadStream,
                "region " + std::to_string(region) + ": boundary loops differ from the directory's");
  }
  regions_.insert_or_assign(region, std::move(mesh));
  return {};
}

Result<void> Stitcher::add_bundle(RegionId region, std::vector<BoundaryTriangle> triangles) {
  for (const BoundaryTriangle& triangle : triangles) {
    for (const BoundaryRef& corner : triangle.corners) {
      const bool is_there = corner.region < directory_.regions.size() &&
                            corner.index < directory_.regions[corner.region].boundary_vertices();
      if (!is_there)
        return fail(ErrorCode::BadStream,
                    "bundle " + std::to_string(region) + ": names a vertex that is not there");
    }
  }
  bundles_.insert_or_assign(region, std::move(triangles));
  return {};
}

StitchedMesh Stitcher::mesh() const {
  StitchedMesh stitched;
  const VertexMap map(regions_);
  stitched.soup.positions.resize(map.count());
  stitched.region_of_vertex.assign(map.count(), kNone);
  for (const auto& [id, region] : regions_) {
    const std::vector<VertexId>& vertex = map.of(id);
    for (VertexId v = 0; v < vertex.size(); ++v) {
      stitched.soup.positions[vertex[v]] = position_of(region, v, directory_.grid);
      RegionId& region_of = stitched.region_of_vertex[vertex[v]];
      region_of = std::min(region_of, id);
    }
    for (TriangleId t = 0; t < region.table.triangle_count(); ++t) {
      const auto [a, b, c] = region.table.triangle(t);
      append_triangle(stitched.soup, {vertex[a], vertex[b], vertex[c]},
                      !region.is_turned.empty() && region.is_turned[t]);
    }
  }
  for (const auto& [id, triangles] : bundles_) {
    for (const BoundaryTriangle& triangle : triangles) {
      Triangle corners;
      bool is_complete = true;
      for (std::size_t k = 0; k < 3 && is_complete; ++k) {
        const auto& [region, index] = triangle.corners[k];
        const auto present = regions_.find(region);
        is_complete = present != regions_.end();
        if (is_complete) corners[k] = map.of(region)[present->second.vertex_of_boundary[index]];
      }
      if (is_complete) append_triangle(stitched.soup, corners, triangle.is_turned);
    }
  }
  return stitched;
}

}  // namespace selvage
