// SPDX-License-Identifier: MIT
#include "server/simplify/level_bounds.h"

#include <algorithm>
#include <array>
#include <optional>

#include "server/simplify/level_precision.h"
#include "server/simplify/near_surface.h"
#include "server/simplify/surface_cover.h"

namespace selvage {
namespace {

/// No bound is less, in grid steps: below it lies no difference that anyone could see.
constexpr double kLeastBound = 0.05;

/// A level of the whole model, or a strip, its vertices renumbered; of a strip without regions.
struct LevelSurface {
  std::vector<Triangle> triangles;
  std::vector<CornerId> opposite;
  std::vector<Vec3> positions;
  std::vector<RegionId> region_of_vertex;
};

struct Neighbour {
  RegionId region;
  const Strip* strip;
};

/// Strays of one region at one level, by the region that they strayed to; kNone: none that it has a strip to.
struct StraysTo {
  RegionId region;
  std::vector<ConvexPiece> pieces;
};

/// What a mix of two levels costs one of them.
struct Charge {
  RegionId region;
  std::uint32_t level;
  double bound;
};

class Bounds {
 public:
  Bounds(const LevelSource& source, std::span<const Strip> strips, LevelledMesh& levels,
         const SimplifyProgress& progress);

  void bound_insides(const ParallelFor& parallel);
  void bound_strips(const ParallelFor& parallel);
  void repeat_bounds();

 private:
  using Corners = std::array<Vec3, 3>;

  std::uint32_t level_count() const { return static_cast<std::uint32_t>(levels_.regions.size()); }
  RegionLevel& at(RegionId region, std::uint32_t level) { return levels_.regions[level][region]; }
  /// Whether the level has a shape of its own.
  bool is_own(RegionId region, std::uint32_t level) const {
    const auto& regions = levels_.regions;
    return level == 0 || !regions[level][region].is_repeat ||
           regions[level][region].dropped_bits != regions[level - 1][region].dropped_bits;
  }
  Vec3 position(VertexId finest, std::uint32_t level) const;
  Corners corners(TriangleId t, RegionId region, std::uint32_t level, std::uint32_t elsewhere) const;

  LevelSurface make_surface(std::uint32_t level) const;
  LevelSurface make_strip(const Strip& strip, RegionId region, std::uint32_t level,
                          std::uint32_t elsewhere) const;
  void bound_inside(RegionId region, std::uint32_t level);
  void sort_strays(RegionId region, std::uint32_t level, const std::vector<Stray>& strays);
  void bound_mixes(RegionId region, std::uint32_t level, std::vector<Charge>& charges);
  double bound_mix(RegionId region, std::uint32_t level, const Neighbour& neighbour, std::uint32_t other,
                   std::span<const ConvexPiece> strays) const;
  std::size_t step_count() const { return std::size_t{source_.region_count} * (level_count() - 1); }
  /// Whether to go on, with so many of all steps done.
  bool goes_on(std::size_t done) const {
    return !progress_ || progress_(static_cast<double>(done) / static_cast<double>(2 * step_count()));
  }

  const LevelSource& source_;
  LevelledMesh& levels_;
  std::vector<Vec3> finest_positions_;
  std::vector<Triangle> finest_triangles_;
  std::vector<LevelSurface> surfaces_;                      // by level, the finest left empty
  std::vector<NearSurface> near_;                           // by level
  std::vector<std::vector<Neighbour>> neighbours_;          // by region
  std::vector<std::vector<std::vector<StraysTo>>> strays_;  // by level, by region

  const SimplifyProgress& progress_;
};

Bounds::Bounds(const LevelSource& source, std::span<const Strip> strips, LevelledMesh& levels,
               const SimplifyProgress& progress)
    : source_(source), levels_(levels), neighbours_(source.region_count + 1), progress_(progress) {
  for (const GridPoint& p : source.positions) finest_positions_.push_back(without_low_bits(p, 0));
  for (TriangleId t = 0; t < source.mesh.triangle_count(); ++t)
    finest_triangles_.push_back(source.mesh.triangle(t));
  for (const Strip& strip : strips) {
    neighbours_[strip.low].push_back({strip.high, &strip});
    neighbours_[strip.high].push_back({strip.low, &strip});
  }
  strays_.resize(level_count());
  for (auto& by_region : strays_) by_region.resize(source.region_count + 1);
  near_.emplace_back(finest_triangles_, finest_positions_, source.mesh.opposite, source.region_of_vertex);
  surfaces_.emplace_back();
  for (std::uint32_t level = 1; level < level_count(); ++level) surfaces_.push_back(make_surface(level));
  for (std::uint32_t level = 1; level < level_count(); ++level) {
    const LevelSurface& surface = surfaces_[level];
    near_.emplace_back(surface.triangles, surface.positions, surface.opposite, surface.region_of_vertex);
  }
}

Vec3 Bounds::position(VertexId finest, std::uint32_t level) const {
  if (level == 0) return finest_positions_[finest];
  const RegionId region = source_.region_of_vertex[finest];
  return without_low_bits(source_.positions[levels_.representative_of_vertex[level][finest]],
                          levels_.regions[level][region].dropped_bits);
}

/// Of a triangle with `region` at a level, and any others at another.
Bounds::Corners Bounds::corners(TriangleId t, RegionId region, std::uint32_t level,
                                std::uint32_t elsewhere) const {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexId v = finest_triangles_[t][k];
    corners[k] = position(v, source_.region_of_vertex[v] == region ? level : elsewhere);
  }
  return corners;
}

LevelSurface Bounds::make_surface(std::uint32_t level) const {
  const auto& representative = levels_.representative_of_vertex[level];
  std::vector<TriangleId> sources;
  LevelSurface surface;
  surface.triangles = substituted_triangles(source_.mesh, representative, &sources);
  std::vector<std::uint32_t> new_triangle(source_.mesh.triangle_count(), kNone);
  for (std::uint32_t i = 0; i < sources.size(); ++i) new_triangle[sources[i]] = i;
  surface.opposite.reserve(3 * sources.size());
  for (const TriangleId t : sources) {
    for (CornerId c = 3 * t; c < 3 * t + 3; ++c) {
      const CornerId across = corner_across(source_.mesh, representative, c);
      surface.opposite.push_back(across == kNone ? kNone
                                                 : 3 * new_triangle[triangle_of(across)] + across % 3);
    }
  }
  std::vector<VertexId> new_vertex(source_.mesh.vertex_count(), kNone);
  for (Triangle& triangle : surface.triangles) {
    for (VertexId& v : triangle) {
      if (new_vertex[v] == kNone) {
        new_vertex[v] = static_cast<VertexId>(surface.positions.size());
        surface.positions.push_back(position(v, level));
        surface.region_of_vertex.push_back(source_.region_of_vertex[v]);
      }
      v = new_vertex[v];
    }
  }
  return surface;
}

/// A strip with `region` at one level and the other region at another.
LevelSurface Bounds::make_strip(const Strip& strip, RegionId region, std::uint32_t level,
                                std::uint32_t elsewhere) const {
  const auto level_at = [&](VertexId v) { return source_.region_of_vertex[v] == region ? level : elsewhere; };
  std::vector<std::pair<VertexId, Vec3>> vertices;
  LevelSurface surface;
  for (const TriangleId t : strip.triangles) {
    Triangle triangle = finest_triangles_[t];
    for (VertexId& v : triangle) v = levels_.representative_of_vertex[level_at(v)][v];
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
    surface.triangles.push_back(triangle);
    for (const VertexId v : triangle) vertices.emplace_back(v, position(v, level_at(v)));
  }
  const auto by_vertex = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::sort(vertices.begin(), vertices.end(), by_vertex);
  vertices.erase(std::unique(vertices.begin(), vertices.end(),
                             [](const auto& a, const auto& b) { return a.first == b.first; }),
                 vertices.end());
  for (Triangle& triangle : surface.triangles) {
    for (VertexId& v : triangle) {
      const auto at = std::lower_bound(vertices.begin(), vertices.end(), std::pair(v, Vec3{}), by_vertex);
      v = static_cast<VertexId>(at - vertices.begin());
    }
  }
  for (const auto& [v, position] : vertices) surface.positions.push_back(position);
  surface.opposite =
      build_corner_table(surface.triangles, static_cast<std::uint32_t>(vertices.size())).opposite;
  return surface;
}

void Bounds::bound_insides(const ParallelFor& parallel) {
  parallel(step_count(), [&](std::size_t i) {
    if (!goes_on(i)) return;
    bound_inside(static_cast<RegionId>(i % source_.region_count + 1),
                 static_cast<std::uint32_t>(i / source_.region_count + 1));
  });
}

/// Against the whole model at this level; sorts out what depends on the neighbours' levels.
void Bounds::bound_inside(RegionId region, std::uint32_t level) {
  if (!is_own(region, level)) return;
  const CoverTarget all_coarse[] = {{&near_[level]}}, all_finest[] = {{&near_[0]}};
  CoverBound out(all_coarse, std::max(at(region, level).deviation, kLeastBound));
  std::vector<Stray> strays;
  out.keep_strays(region, strays);
  for (const TriangleId t : at(region, 0).triangles) {
    const auto [a, b, c] = corners(t, region, 0, 0);
    out.add(a, b, c);
  }
  CoverBound back(all_finest, out.bound());
  for (const TriangleId t : at(region, level).triangles) {
    const auto [a, b, c] = corners(t, region, level, level);
    back.add(a, b, c);
  }
  at(region, level).bound = back.bound();
  sort_strays(region, level, strays);
}

void Bounds::sort_strays(RegionId region, std::uint32_t level, const std::vector<Stray>& strays) {
  auto& sorted = strays_[level][region];
  for (const Neighbour& neighbour : neighbours_[region]) sorted.push_back({neighbour.region, {}});
  sorted.push_back({kNone, {}});
  const LevelSurface& surface = surfaces_[level];
  for (const Stray& stray : strays) {
    const auto is_touched = [&](const StraysTo& to) {
      const Triangle& t = surface.triangles[stray.triangle];
      return std::any_of(t.begin(), t.end(),
                         [&](VertexId v) { return surface.region_of_vertex[v] == to.region; });
    };
    const auto to = std::find_if(sorted.begin(), sorted.end() - 1, is_touched);
    to->pieces.push_back(stray.piece);
  }
}

void Bounds::bound_strips(const ParallelFor& parallel) {
  std::vector<std::vector<Charge>> charges(step_count());
  parallel(charges.size(), [&](std::size_t i) {
    if (!goes_on(step_count() + i)) return;
    bound_mixes(static_cast<RegionId>(i % source_.region_count + 1),
                static_cast<std::uint32_t>(i / source_.region_count + 1), charges[i]);
  });
  for (const auto& some : charges) {
    for (const Charge& charge : some) {
      double& bound = at(charge.region, charge.level).bound;
      bound = std::max(bound, charge.bound);
    }
  }
}

/// The region at this level, each neighbour at every level.
void Bounds::bound_mixes(RegionId region, std::uint32_t level, std::vector<Charge>& charges) {
  const auto& strays = strays_[level][region];
  if (!is_own(region, level) || strays.empty()) return;  // empty: stopped before the inside was bounded
  for (std::size_t i = 0; i < neighbours_[region].size(); ++i) {
    const Neighbour& neighbour = neighbours_[region][i];
    for (std::uint32_t other = 0; other < level_count(); ++other) {
      if (!is_own(neighbour.region, other)) continue;
      const double bound = bound_mix(region, level, neighbour, other, strays[i].pieces);
      if (level >= other) charges.push_back({region, level, bound});
      if (level <= other) charges.push_back({neighbour.region, other, bound});
    }
  }
  const CoverTarget own[] = {{&near_[level], region}};
  CoverBound lost(own, at(region, level).bound);
  for (const ConvexPiece& piece : strays.back().pieces) lost.add(piece);
  charges.push_back({region, level, lost.bound()});
}

/// What strays from the region, and what lies between both. A mix is looked at from both sides; the one that
/// pays for it, or of two that do the lower one, covers the strip.
double Bounds::bound_mix(RegionId region, std::uint32_t level, const Neighbour& neighbour,
                         std::uint32_t other, std::span<const ConvexPiece> strays) const {
  const bool covers_strip =
      level > other || (level == other && region < neighbour.region) || neighbour.region == kLooseRegion;
  const auto& regions = levels_.regions;
  const double begin = std::max(regions[level][region].bound, regions[other][neighbour.region].bound);
  if (strays.empty() && !covers_strip) return begin;

  const LevelSurface strip = make_strip(*neighbour.strip, region, level, other);
  // The strip first: it is small, and what is found there shortens the search in the others.
  std::vector<CoverTarget> targets;
  std::optional<NearSurface> near_strip;
  if (!strip.triangles.empty()) {
    near_strip.emplace(strip.triangles, strip.positions, strip.opposite);
    targets.push_back({&*near_strip});
  }
  targets.push_back({&near_[level], region});
  if (neighbour.region != kLooseRegion) targets.push_back({&near_[other], neighbour.region});

  CoverBound out(targets, begin);
  for (const ConvexPiece& piece : strays) out.add(piece);
  if (!covers_strip) return out.bound();
  for (const TriangleId t : neighbour.strip->triangles) {
    const auto [a, b, c] = corners(t, region, 0, 0);
    out.add(a, b, c);
  }
  const CoverTarget finest[] = {{&near_[0]}};
  CoverBound back(finest, out.bound());
  for (const auto& [a, b, c] : strip.triangles)
    back.add(strip.positions[a], strip.positions[b], strip.positions[c]);
  return back.bound();
}

/// A level that is the one before is as far away.
void Bounds::repeat_bounds() {
  for (std::uint32_t level = 1; level < level_count(); ++level) {
    for (RegionId region = 0; region <= source_.region_count; ++region) {
      if (!is_own(region, level)) at(region, level).bound = at(region, level - 1).bound;
    }
  }
}

}  // namespace

void bound_levels(const LevelSource& source, std::span<const Strip> strips, LevelledMesh& levels,
                  const ParallelFor& parallel, const SimplifyProgress& progress) {
  if (source.mesh.triangle_count() == 0 || levels.regions.size() < 2) return;
  Bounds bounds(source, strips, levels, progress);
  bounds.bound_insides(parallel);
  bounds.bound_strips(parallel);
  bounds.repeat_bounds();
}

}  // namespace selvage
