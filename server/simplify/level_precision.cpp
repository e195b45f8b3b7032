// SPDX-License-Identifier: MIT
#include "server/simplify/level_precision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace selvage {
namespace {

/// Half a cell's diagonal, which rounding moves a vertex by at most, per grid step of the cell's side.
constexpr double kHalfDiagonal = 0.8660254037844386;
/// As far as a collapse may not turn a triangle, see legality.h.
constexpr double kLeastCosine = 0.2;

int bits_worth(double deviation) {
  int dropped = 0;
  while (kHalfDiagonal * std::ldexp(1.0, dropped + 1) <= deviation && dropped < 23) ++dropped;
  return dropped;
}

class Precisions {
 public:
  Precisions(const LevelSource& source, std::span<const Strip> strips, LevelledMesh& levels)
      : source_(source), strips_(strips), levels_(levels) {
    for (auto& regions : levels.regions) {
      is_too_coarse_.emplace_back(regions.size(), false);
      for (RegionLevel& region : regions) region.dropped_bits = bits_worth(region.deviation);
    }
  }

  /// Levels only ever get finer, so this ends.
  void settle() {
    do {
      for (std::uint32_t level = 1; level < levels_.regions.size(); ++level) {
        for (RegionId region = 1; region < levels_.regions[level].size(); ++region)
          judge_inside(region, level);
      }
      for (const Strip& strip : strips_) judge(strip);
      judge_junctions();
    } while (refine());
  }

 private:
  std::uint32_t level_count() const { return static_cast<std::uint32_t>(levels_.regions.size()); }

  void judge_inside(RegionId region, std::uint32_t level) {
    if (levels_.regions[level][region].dropped_bits == 0) return;
    for (const TriangleId t : levels_.regions[level][region].triangles) {
      if (is_turned(t, [=](RegionId) { return level; })) {
        is_too_coarse_[level][region] = true;
        return;
      }
    }
  }

  void judge(const Strip& strip) {
    for (std::uint32_t one = 0; one < level_count(); ++one) {
      for (std::uint32_t other = 0; other < level_count(); ++other) {
        const auto level_of = [&](RegionId region) { return region == strip.low ? one : other; };
        const int dropped = std::max(levels_.regions[one][strip.low].dropped_bits,
                                     levels_.regions[other][strip.high].dropped_bits);
        if (dropped == 0) continue;
        const double least_area = one == other ? 0 : std::ldexp(1.0, 2 * dropped);
        for (const TriangleId t : strip.triangles) {
          if (!is_turned(t, level_of, least_area)) continue;
          is_too_coarse_[one][strip.low] = is_too_coarse_[other][strip.high] = true;
          break;
        }
      }
    }
  }

  /// Triangles between three regions never collapse, but rounding moves their corners as any others.
  void judge_junctions() {
    for (TriangleId t = 0; t < source_.mesh.triangle_count(); ++t) {
      const auto [a, b, c] = source_.mesh.triangle(t);
      const RegionId of[] = {source_.region_of_vertex[a], source_.region_of_vertex[b],
                             source_.region_of_vertex[c]};
      if (of[0] == of[1] || of[1] == of[2] || of[2] == of[0]) continue;
      for (std::uint32_t level = 1; level < level_count(); ++level) {
        if (!is_turned(t, [=](RegionId) { return level; })) continue;
        for (const RegionId region : of) is_too_coarse_[level][region] = true;
      }
    }
  }

  /// One without area to begin with is not judged, nor one that ends with `least_area` or less.
  template <class LevelOf>
  bool is_turned(TriangleId t, LevelOf level_of, double least_area = 0) const {
    std::array<Vec3, 3> before, after;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId finest = source_.mesh.triangle(t)[k];
      const RegionId region = source_.region_of_vertex[finest];
      const std::uint32_t level = level_of(region);
      const GridPoint& p = source_.positions[levels_.representative_of_vertex[level][finest]];
      before[k] = without_low_bits(p, 0);
      after[k] = without_low_bits(p, levels_.regions[level][region].dropped_bits);
    }
    const Vec3 n = cross(before[1] - before[0], before[2] - before[0]);
    const Vec3 m = cross(after[1] - after[0], after[2] - after[0]);
    const double cosine = dot(n, m), nn = dot(n, n), mm = dot(m, m);
    if (nn == 0 || (least_area > 0 && mm <= 4 * least_area * least_area)) return false;
    return cosine <= 0 || cosine * cosine <= kLeastCosine * kLeastCosine * nn * mm;
  }

  /// False if nothing was too coarse, or cannot be helped.
  bool refine() {
    bool has_changed = false;
    for (std::uint32_t level = 1; level < level_count(); ++level) {
      for (RegionId region = 1; region < levels_.regions[level].size(); ++region) {
        int& dropped = levels_.regions[level][region].dropped_bits;
        if (!is_too_coarse_[level][region] || dropped == 0) continue;
        --dropped;
        has_changed = true;
      }
      is_too_coarse_[level].assign(is_too_coarse_[level].size(), false);
    }
    return has_changed;
  }

  const LevelSource& source_;
  std::span<const Strip> strips_;
  LevelledMesh& levels_;
  std::vector<std::vector<bool>> is_too_coarse_;  // by level, by region
};

}  // namespace

Vec3 without_low_bits(const GridPoint& p, int dropped) {
  const auto middle = static_cast<std::int32_t>((1u << dropped) >> 1);
  const auto round = [&](std::int32_t x) { return double((x >> dropped << dropped) + middle); };
  return {round(p.x), round(p.y), round(p.z)};
}

void set_precisions(const LevelSource& source, std::span<const Strip> strips, LevelledMesh& levels) {
  Precisions(source, strips, levels).settle();
}

}  // namespace selvage
