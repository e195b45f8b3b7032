// SPDX-License-Identifier: MIT
#include "client/stitch/stitcher.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

namespace selvage {
namespace {

std::array<RegionId, 3> regions_of(const BoundaryTriangle& triangle) {
  std::array<RegionId, 3> regions = {triangle.corners[0].region, triangle.corners[1].region,
                                     triangle.corners[2].region};
  std::sort(regions.begin(), regions.end(), std::greater<>());
  std::fill(std::unique(regions.begin(), regions.end()), regions.end(), kNone);
  return regions;
}

/// On coarser levels a triangle may have lost a corner to its neighbour, or lie between copies of one vertex.
void append_triangle(std::vector<Triangle>& triangles, Triangle triangle, bool is_turned) {
  const auto [a, b, c] = triangle;
  if (a == b || b == c || c == a) return;
  if (is_turned) std::swap(triangle[1], triangle[2]);
  triangles.push_back(triangle);
}

void sort_and_unify(std::vector<VertexId>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

Result<void> Stitcher::add_region(RegionId region, RegionMesh mesh, std::uint8_t level) {
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
  remove_region(region);
  Region& added = regions_[region];
  added.numbers = numbers_.add(region, level, mesh);
  added.mesh = std::move(mesh);
  added.level = level;
  elements_visited_ += added.numbers.size();
  note_change(region);
  return {};
}

void Stitcher::remove_region(RegionId region) {
  const auto found = regions_.find(region);
  if (found == regions_.end()) return;
  const Region& gone = found->second;
  elements_visited_ += gone.numbers.size();
  numbers_.remove(region, gone.level, gone.mesh, gone.numbers);
  regions_.erase(found);
  note_change(region);
}

Result<void> Stitcher::add_bundle(RegionId region, std::vector<BoundaryTriangle> triangles) {
  for (const BoundaryTriangle& triangle : triangles) {
    for (const BoundaryRef& corner : triangle.corners) {
      const bool is_there = corner.region <= region && region < directory_.regions.size() &&
                            corner.index < directory_.regions[corner.region].boundary_vertices();
      if (!is_there)
        return fail(ErrorCode::BadStream,
                    "bundle " + std::to_string(region) + ": names a vertex that is not there");
    }
  }
  remove_bundle(region);
  elements_visited_ += triangles.size();
  for (const BoundaryTriangle& triangle : triangles) {
    const JoinKey key = regions_of(triangle);
    std::vector<BoundaryTriangle>& join = joins_[key];
    if (join.empty()) {
      changed_joins_.insert(key);
      for (const RegionId id : key) {
        if (id != kNone) joins_of_region_[id].insert(key);
      }
    }
    join.push_back(triangle);
  }
  return {};
}

void Stitcher::remove_bundle(RegionId region) {
  const auto begin = joins_.lower_bound({region, 0, 0});
  auto end = begin;
  for (; end != joins_.end() && end->first[0] == region; ++end) {
    changed_joins_.insert(end->first);
    for (const RegionId id : end->first) {
      if (id != kNone) joins_of_region_[id].erase(end->first);
    }
  }
  joins_.erase(begin, end);
}

std::vector<RegionId> Stitcher::regions() const {
  std::vector<RegionId> ids;
  ids.reserve(regions_.size());
  for (const auto& [id, region] : regions_) ids.push_back(id);
  return ids;
}

std::optional<std::uint8_t> Stitcher::level_of(RegionId region) const {
  const auto found = regions_.find(region);
  if (found == regions_.end()) return std::nullopt;
  return found->second.level;
}

void Stitcher::note_change(RegionId region) {
  changed_regions_.insert(region);
  changed_joins_.insert(joins_of_region_[region].begin(), joins_of_region_[region].end());
}

Vec3 Stitcher::position_of(const VertexOwner& owner) const {
  const RegionMesh& mesh = regions_.at(owner.region).mesh;
  if (mesh.exact.empty()) return directory_.grid.position(mesh.positions[owner.vertex]);
  const ExactPosition& exact = mesh.exact[owner.vertex];
  return {exact[0], exact[1], exact[2]};
}

std::vector<Triangle> Stitcher::triangles_of(const Region& region) const {
  std::vector<Triangle> triangles;
  const RegionMesh& mesh = region.mesh;
  triangles.reserve(mesh.triangles.size());
  for (TriangleId t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    append_triangle(triangles, {region.numbers[a], region.numbers[b], region.numbers[c]},
                    !mesh.is_turned.empty() && mesh.is_turned[t]);
  }
  return triangles;
}

/// All of a join's triangles touch the same regions, so they are there together or not at all.
std::vector<Triangle> Stitcher::triangles_of(const Joins::value_type& join) const {
  const auto& [key, boundary_triangles] = join;
  std::array<const Region*, 3> regions{};
  for (std::size_t i = 0; i < 3 && key[i] != kNone; ++i) {
    const auto region = regions_.find(key[i]);
    if (region == regions_.end()) return {};
    regions[i] = &region->second;
  }
  std::vector<Triangle> triangles;
  triangles.reserve(boundary_triangles.size());
  for (const BoundaryTriangle& triangle : boundary_triangles) {
    Triangle corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [id, index] = triangle.corners[k];
      const Region& region = *regions[id == key[0] ? 0 : id == key[1] ? 1 : 2];
      corners[k] = region.numbers[region.mesh.vertex_of_boundary[index]];
    }
    append_triangle(triangles, corners, triangle.is_turned);
  }
  return triangles;
}

StitchUpdate Stitcher::take_update() {
  StitchUpdate update;
  list_vertices(update);
  list_patches(update);
  changed_regions_.clear();
  changed_joins_.clear();
  return update;
}

void Stitcher::list_vertices(StitchUpdate& update) {
  is_published_.resize(numbers_.bound(), false);
  auto [freed, listed] = numbers_.take_changes();
  for (const VertexId number : freed) {
    if (!is_published_[number] || numbers_.owner(number).region != kNone) continue;
    is_published_[number] = false;
    update.removed_vertices.push_back(number);
  }
  std::sort(update.removed_vertices.begin(), update.removed_vertices.end());
  for (const RegionId id : changed_regions_) {
    const auto region = regions_.find(id);
    if (region != regions_.end())
      listed.insert(listed.end(), region->second.numbers.begin(), region->second.numbers.end());
  }
  sort_and_unify(listed);
  for (const VertexId number : listed) {
    const VertexOwner& owner = numbers_.owner(number);
    if (owner.region == kNone) continue;
    is_published_[number] = true;
    update.vertices.push_back({number, position_of(owner), owner.region});
  }
  elements_visited_ += freed.size() + listed.size();
}

void Stitcher::list_patches(StitchUpdate& update) {
  const auto list = [&](const PatchId& id, std::vector<Triangle> triangles) {
    const bool is_new = !triangles.empty();
    if (is_new) {
      published_patches_.insert(id);
    } else if (published_patches_.erase(id) == 0) {
      return;  // nobody knows of it
    }
    update.patches.push_back({id, std::move(triangles)});
  };
  for (const RegionId id : changed_regions_) {
    const auto region = regions_.find(id);
    const bool is_there = region != regions_.end();
    if (is_there) elements_visited_ += region->second.mesh.triangles.size();
    list({PatchId::Kind::Region, {id, kNone, kNone}},
         is_there ? triangles_of(region->second) : std::vector<Triangle>());
  }
  for (const JoinKey& key : changed_joins_) {
    const auto join = joins_.find(key);
    const bool is_there = join != joins_.end();
    if (is_there) elements_visited_ += join->second.size();
    list({PatchId::Kind::Join, key}, is_there ? triangles_of(*join) : std::vector<Triangle>());
  }
}

StitchedMesh Stitcher::mesh() const {
  StitchedMesh stitched;
  std::vector<VertexId> vertex_of_number(numbers_.bound(), kNone);
  for (const auto& [id, region] : regions_) {
    for (const VertexId number : region.numbers) {
      if (vertex_of_number[number] != kNone) continue;
      vertex_of_number[number] = static_cast<VertexId>(stitched.soup.positions.size());
      stitched.soup.positions.push_back(position_of(numbers_.owner(number)));
      stitched.region_of_vertex.push_back(id);
    }
  }
  const auto append = [&](std::vector<Triangle> triangles) {
    for (Triangle& triangle : triangles) {
      for (VertexId& v : triangle) v = vertex_of_number[v];
    }
    stitched.soup.triangles.insert(stitched.soup.triangles.end(), triangles.begin(), triangles.end());
  };
  for (const auto& [id, region] : regions_) append(triangles_of(region));
  for (const auto& join : joins_) append(triangles_of(join));
  return stitched;
}

}  // namespace selvage
