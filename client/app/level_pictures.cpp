// SPDX-License-Identifier: MIT
#include "client/app/level_pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "common/render/palette.h"
#include "common/render/render.h"

namespace selvage {
namespace {

constexpr double kWirePx = 0.7;
/// A seam's surroundings, as a share of the model's diagonal.
constexpr double kSeamRadius = 0.045;

Image draw(const StitchedMesh& mesh, const Camera& camera) {
  const auto neighbours = neighbouring_regions(mesh.soup.triangles, mesh.region_of_vertex);
  const RegionId regions =
      mesh.region_of_vertex.empty()
          ? 1
          : *std::max_element(mesh.region_of_vertex.begin(), mesh.region_of_vertex.end()) + 1;
  const auto colours = colours_of_regions(regions, neighbours);
  // Joins in a light colour of their own: on a coarse level they are as wide as other triangles.
  const RegionPaint paint =
      paint_regions(mesh.soup.triangles, mesh.region_of_vertex, colours, {235, 235, 230});
  return render({mesh.soup.positions, mesh.soup.triangles, paint.colour_of_triangle, {}}, camera,
                {.crease_degrees = 0, .wire_px = kWirePx});
}

Vec3 middle_of(const RegionEntry& entry, const Grid& grid) {
  return (grid.position(entry.box_min) + grid.position(entry.box_max)) * 0.5;
}

/// Regions from left to right in groups of about as many, the finest first: the seams lie across the picture.
std::vector<std::uint32_t> levels_across(const Directory& directory, const Camera& camera) {
  std::vector<std::pair<double, RegionId>> by_place;
  for (RegionId id = 1; id < directory.regions.size(); ++id) {
    by_place.emplace_back(dot(middle_of(directory.regions[id], directory.grid), camera.right), id);
  }
  std::sort(by_place.begin(), by_place.end());
  std::vector<std::uint32_t> level_of_region(directory.regions.size(), 0);
  for (std::size_t i = 0; i < by_place.size(); ++i) {
    level_of_region[by_place[i].second] =
        static_cast<std::uint32_t>(i * directory.level_count() / by_place.size());
  }
  return level_of_region;
}

struct Seam {
  Vec3 middle, normal;
};

/// The boundary triangle between the levels that differ most, facing the camera, nearest to it.
Seam find_seam(const StitchedMesh& mesh, const std::vector<std::uint32_t>& level_of_region,
               const Camera& camera) {
  Seam best;
  double best_score = -std::numeric_limits<double>::infinity();
  const double reach = camera.width / camera.scale;
  for (const Triangle& t : mesh.soup.triangles) {
    std::uint32_t low = kNone, high = 0;
    for (const VertexId v : t) {
      const std::uint32_t level = level_of_region[mesh.region_of_vertex[v]];
      low = std::min(low, level);
      high = std::max(high, level);
    }
    if (low == high) continue;
    const Vec3 &a = mesh.soup.positions[t[0]], &b = mesh.soup.positions[t[1]], &c = mesh.soup.positions[t[2]];
    const Vec3 normal = normalised(cross(b - a, c - a)), middle = (a + b + c) * (1.0 / 3);
    const double score =
        2.0 * (high - low) + dot(normal, camera.back) + dot(middle - camera.target, camera.back) / reach;
    if (score > best_score) best_score = score, best = {middle, normal};
  }
  return best;
}

/// Straight at the seam, and nothing of the model but its surroundings.
Image draw_seam(const StitchedMesh& mesh, const Seam& seam, double radius, UpAxis up, const Camera& whole) {
  StitchedMesh near;
  near.soup.positions = mesh.soup.positions;
  near.region_of_vertex = mesh.region_of_vertex;
  const auto is_near = [&](VertexId v) { return length(mesh.soup.positions[v] - seam.middle) < 3 * radius; };
  for (const Triangle& t : mesh.soup.triangles) {
    if (is_near(t[0]) || is_near(t[1]) || is_near(t[2])) near.soup.triangles.push_back(t);
  }
  const Vec3& n = seam.normal;
  const double upwards = up == UpAxis::Y ? n.y : n.z;
  View view{.elevation_degrees = std::asin(std::clamp(upwards, -1.0, 1.0)) * 180 / std::numbers::pi,
            .up = up,
            .projection = Projection::Orthographic};
  view.azimuth_degrees =
      (up == UpAxis::Y ? std::atan2(n.x, n.z) : std::atan2(n.x, -n.y)) * 180 / std::numbers::pi;
  std::vector<Vec3> corners;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-radius, radius}) {
      corners.push_back(seam.middle);
      corners.back()[axis] += side;
    }
  }
  return draw(near, fit_camera(corners, view, whole.width, whole.height));
}

double diagonal_of(const std::vector<Vec3>& positions) {
  Vec3 low = positions.front(), high = low;
  for (const Vec3& p : positions) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  return length(high - low);
}

}  // namespace

Result<std::vector<Panel>> draw_levels(const Directory& directory, const LoadMesh& load, UpAxis up,
                                       int size) {
  const std::uint32_t levels = directory.level_count();
  std::vector<Panel> panels;
  Camera camera;
  for (std::uint32_t level = 0; level < levels; ++level) {
    auto mesh = load({.level = static_cast<std::uint8_t>(level)});
    if (!mesh) return forward_error(mesh);
    if (level == 0) camera = fit_camera(mesh->soup.positions, {.up = up}, size, size * 3 / 4);
    panels.push_back(
        {draw(*mesh, camera), fmt::format("level {}, {} triangles", level, mesh->soup.triangles.size())});
  }
  if (levels < 2 || directory.real_region_count() < 2) return panels;

  const auto level_of_region = levels_across(directory, camera);
  Selection mixed;
  for (RegionId id = 1; id < level_of_region.size(); ++id) {
    mixed.levels.push_back({id, static_cast<std::uint8_t>(level_of_region[id])});
  }
  auto mesh = load(mixed);
  if (!mesh) return forward_error(mesh);
  panels.push_back({draw(*mesh, camera),
                    fmt::format("each region at its level, {} triangles", mesh->soup.triangles.size())});
  const Seam seam = find_seam(*mesh, level_of_region, camera);
  panels.push_back({draw_seam(*mesh, seam, kSeamRadius * diagonal_of(mesh->soup.positions), up, camera),
                    "a seam between levels"});
  return panels;
}

}  // namespace selvage
