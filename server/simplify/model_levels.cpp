// SPDX-License-Identifier: MIT
#include "server/simplify/model_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "server/simplify/surface_cover.h"

namespace selvage {
namespace {

/// Half a cell's diagonal, which rounding moves a vertex by at most, per grid step of the cell's side.
constexpr double kHalfDiagonal = 0.8660254037844386;
/// Rounding may move a vertex by this share of what the collapses moved the surface by.
constexpr double kRoundingShare = 1;

Vec3 to_vec(const GridPoint& p) { return {double(p.x), double(p.y), double(p.z)}; }

/// As common/codec/region_format.h's drop_bits and restore_bits do.
Vec3 rounded(const GridPoint& p, int dropped) {
  const auto middle = static_cast<std::int32_t>((1u << dropped) >> 1);
  const auto round = [&](std::int32_t x) { return double((x >> dropped << dropped) + middle); };
  return {round(p.x), round(p.y), round(p.z)};
}

int bits_worth(double deviation) {
  int dropped = 0;
  while (kHalfDiagonal * std::ldexp(1.0, dropped + 1) <= kRoundingShare * deviation && dropped < 23)
    ++dropped;
  return dropped;
}

/// The triangles of one level, by the finest triangle each comes from, in the finest order.
struct LevelSurface {
  std::vector<Triangle> triangles;
  std::vector<TriangleId> sources;
  std::vector<Vec3> positions;  ///< by vertex of the finest mesh, rounded
};

/// The regions that a triangle touches, each once, without the loose one.
struct Touched {
  std::array<RegionId, 3> regions;
  int count = 0;
};
Touched touched_by(const CornerTable& mesh, std::span<const RegionId> region_of_vertex, TriangleId t) {
  Touched touched{};
  for (const VertexId v : mesh.triangle(t)) {
    const RegionId region = region_of_vertex[v];
    const auto end = touched.regions.begin() + touched.count;
    if (region != kLooseRegion && std::find(touched.regions.begin(), end, region) == end)
      touched.regions[static_cast<std::size_t>(touched.count++)] = region;
  }
  return touched;
}

/// Finest triangles by the regions that they touch: boundary triangles come once for each.
std::vector<std::vector<TriangleId>> triangles_by_region(const LevelSource& source) {
  std::vector<std::vector<TriangleId>> by_region(source.region_count + 1);
  for (TriangleId t = 0; t < source.mesh.triangle_count(); ++t) {
    const Touched touched = touched_by(source.mesh, source.region_of_vertex, t);
    for (int i = 0; i < touched.count; ++i) by_region[touched.regions[std::size_t(i)]].push_back(t);
  }
  return by_region;
}

class Level {
 public:
  Level(const LevelSource& source, std::span<const Vec3> finest, LevelledMesh& levels, std::size_t level)
      : source_(source), finest_(finest), regions_(levels.regions[level]) {
    surface_.triangles =
        substituted_triangles(source.mesh, levels.representative_of_vertex[level], &surface_.sources);
    for (std::size_t i = 0; i < regions_.size(); ++i)
      regions_[i].dropped_bits = bits_worth(regions_[i].deviation);
  }

  /// Takes precision back where rounding turns a triangle over. Regions only ever get finer, so this ends.
  void settle_precisions() {
    for (bool has_changed = true; has_changed;) {
      round_positions();
      std::vector<bool> is_finer(regions_.size(), false);
      for (std::size_t i = 0; i < surface_.triangles.size(); ++i) {
        if (!is_turned(surface_.triangles[i])) continue;
        const Touched touched = touched_by(source_.mesh, source_.region_of_vertex, surface_.sources[i]);
        for (int k = 0; k < touched.count; ++k) is_finer[touched.regions[std::size_t(k)]] = true;
      }
      has_changed = false;
      for (std::size_t i = 0; i < regions_.size(); ++i) {
        if (!is_finer[i] || regions_[i].dropped_bits == 0) continue;
        --regions_[i].dropped_bits;
        has_changed = true;
      }
    }
  }

  void bound(const TriangleTree& finest_tree, std::span<const std::vector<TriangleId>> finest_by_region,
             const ParallelFor& parallel) {
    if (surface_.triangles.empty()) return;
    const TriangleTree tree(surface_.triangles, surface_.positions);
    std::vector<std::vector<std::uint32_t>> by_region(regions_.size());
    for (std::uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      const Touched touched = touched_by(source_.mesh, source_.region_of_vertex, surface_.sources[i]);
      for (int k = 0; k < touched.count; ++k) by_region[touched.regions[std::size_t(k)]].push_back(i);
    }
    parallel(regions_.size(), [&](std::size_t region) {
      RegionLevel& level = regions_[region];
      CoverBound out(tree, std::max(level.deviation, 0.05));
      for (const TriangleId t : finest_by_region[region]) {
        const auto [a, b, c] = source_.mesh.triangle(t);
        out.add(finest_[a], finest_[b], finest_[c]);
      }
      CoverBound back(finest_tree, out.bound());
      for (const std::uint32_t i : by_region[region]) {
        const auto [a, b, c] = surface_.triangles[i];
        back.add(surface_.positions[a], surface_.positions[b], surface_.positions[c]);
      }
      level.bound = back.bound();
    });
  }

 private:
  void round_positions() {
    surface_.positions.resize(source_.positions.size());
    for (VertexId v = 0; v < source_.positions.size(); ++v) {
      surface_.positions[v] =
          rounded(source_.positions[v], regions_[source_.region_of_vertex[v]].dropped_bits);
    }
  }

  /// As far as a collapse may not turn it, see legality.h. One without area to begin with is not judged.
  bool is_turned(const Triangle& t) const {
    const auto normal_in = [&](std::span<const Vec3> p) {
      return cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    };
    const Vec3 before = normal_in(finest_), after = normal_in(surface_.positions);
    const double before_length = length(before);
    return before_length > 0 && dot(before, after) <= 0.2 * before_length * length(after);
  }

  const LevelSource& source_;
  std::span<const Vec3> finest_;
  std::vector<RegionLevel>& regions_;
  LevelSurface surface_;
};

}  // namespace

LevelledMesh make_model_levels(const LevelSource& source, std::span<const LevelTarget> targets,
                               const ParallelFor& parallel, const SimplifyProgress& progress) {
  std::vector<Vec3> positions;
  positions.reserve(source.positions.size());
  for (const GridPoint& p : source.positions) positions.push_back(to_vec(p));
  const Simplification simplification = simplify({.mesh = source.mesh,
                                                  .positions = positions,
                                                  .region_of_vertex = source.region_of_vertex,
                                                  .pinned = source.pinned},
                                                 targets, {}, progress);
  LevelledMesh levels =
      split_by_region(source.mesh, source.region_of_vertex, source.region_count, simplification);

  std::vector<Triangle> finest;
  for (TriangleId t = 0; t < source.mesh.triangle_count(); ++t) finest.push_back(source.mesh.triangle(t));
  if (finest.empty()) return levels;
  const TriangleTree finest_tree(finest, positions);
  const auto finest_by_region = triangles_by_region(source);
  for (std::size_t k = 1; k < levels.regions.size(); ++k) {
    Level level(source, positions, levels, k);
    level.settle_precisions();
    level.bound(finest_tree, finest_by_region, parallel);
  }
  return levels;
}

}  // namespace selvage
