// SPDX-License-Identifier: MIT
#include "common/samples/bracket.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace selvage {
namespace {

constexpr double kLength = 110, kHeight = 76, kWidth = 64, kThickness = 10, kCorner = 12;
constexpr double kRibLow = 28, kRibHigh = 36, kRibReach = 40, kRibRise = 40;
constexpr double kBossX = 76, kBossZ = 32, kBossRadius = 15, kBossTop = 30, kBossChamfer = 2, kBore = 8;
constexpr double kBaseHole = 4.5, kUprightHole = 5.5;

struct Detail {
  int around;  // points on a circle, a multiple of 4
  int rings;   // rows of quads on a wall
};

/// A circle gets up to 384 points; beyond that walls are cut into more rings. 40 and 16 count the loops that
/// have `around` points in the bracket below.
Detail detail_for(std::uint32_t triangles) {
  const int around = std::clamp(static_cast<int>(triangles / 40), 12, 384) / 4 * 4;
  const int rings = 1 + std::max(0, (static_cast<int>(triangles) - 40 * around) / (16 * around));
  return {around, rings};
}

struct RimPoint {
  double along, across;  // along the plate away from the bend, and across its width
};

/// The free end of a plate: from one long side round both corners to the other.
std::vector<RimPoint> rounded_end(double reach, int around) {
  std::vector<RimPoint> rim;
  const int quarter = around / 4;
  for (int side = 0; side < 2; ++side) {
    for (int i = 0; i <= quarter; ++i) {
      const double angle = std::numbers::pi / 2 * (side == 0 ? i - quarter : i) / quarter;
      const double centre = side == 0 ? kCorner : kWidth - kCorner;
      rim.push_back({reach - kCorner + kCorner * std::cos(angle), centre + kCorner * std::sin(angle)});
    }
  }
  return rim;
}

/// On the base plate at height y, and on the upright plate at depth x.
Vec3 on_base(const RimPoint& p, double y) { return {p.along, y, p.across}; }
Vec3 on_upright(const RimPoint& p, double x) { return {x, p.along, p.across}; }

class Bracket {
 public:
  explicit Bracket(const Detail& detail)
      : detail_(detail),
        base_end_(rounded_end(kLength, detail.around)),
        upright_end_(rounded_end(kHeight, detail.around)) {}

  TriangleSoup build() {
    add_base_faces();
    add_upright_faces();
    add_sides();
    add_rims();
    add_rib();
    add_boss();
    for (const BoltHole& hole : bracket_bolt_holes())
      builder_.wall(circle(hole.frame, hole.radius, 0, detail_.around),
                    circle(hole.frame, hole.radius, -hole.depth, detail_.around), detail_.rings);
    return builder_.take();
  }

 private:
  Frame boss() const { return {{kBossX, 0, kBossZ}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}; }

  /// The ends of the bolt holes that lie in one plate (w along `axis`), on its outer or inner face.
  std::vector<Loop> hole_loops(int axis, bool on_far_face) const {
    std::vector<Loop> loops;
    for (const BoltHole& hole : bracket_bolt_holes())
      if (hole.frame.w[axis] == 1)
        loops.push_back(circle(hole.frame, hole.radius, on_far_face ? -hole.depth : 0, detail_.around));
    return loops;
  }

  void add_base_faces() {
    Loop bottom = {{0, 0, 0}}, top = {{kThickness, kThickness, 0}};
    for (const RimPoint& p : base_end_)
      bottom.push_back(on_base(p, 0)), top.push_back(on_base(p, kThickness));
    bottom.push_back({0, 0, kWidth});
    top.push_back({kThickness, kThickness, kWidth});
    for (const auto& [along, across] : rib_foot(kRibReach)) top.push_back({along, kThickness, across});

    std::vector<Loop> below = hole_loops(1, true), above = hole_loops(1, false);
    below.push_back(circle(boss(), kBore, 0, detail_.around));
    above.push_back(circle(boss(), kBossRadius, kThickness, detail_.around));
    builder_.face({0, -1, 0}, bottom, below);
    builder_.face({0, 1, 0}, top, above);
  }

  void add_upright_faces() {
    Loop back = {{0, 0, 0}}, front = {{kThickness, kThickness, 0}};
    for (const RimPoint& p : upright_end_)
      back.push_back(on_upright(p, 0)), front.push_back(on_upright(p, kThickness));
    back.push_back({0, 0, kWidth});
    front.push_back({kThickness, kThickness, kWidth});
    for (const auto& [along, across] : rib_foot(kRibRise)) front.push_back({kThickness, along, across});
    builder_.face({-1, 0, 0}, back, hole_loops(0, true));
    builder_.face({1, 0, 0}, front, hole_loops(0, false));
  }

  /// Where the rib stands on a plate: a notch in the face, walked from the far side to the near one.
  static std::vector<RimPoint> rib_foot(double reach) {
    const double end = kThickness + reach;
    return {{kThickness, kRibHigh}, {end, kRibHigh}, {end, kRibLow}, {kThickness, kRibLow}};
  }

  void add_sides() {
    for (double z : {0.0, kWidth}) {
      const Loop side = {{0, 0, z},
                         {kLength - kCorner, 0, z},
                         {kLength - kCorner, kThickness, z},
                         {kThickness, kThickness, z},
                         {kThickness, kHeight - kCorner, z},
                         {0, kHeight - kCorner, z}};
      builder_.face({0, 0, z == 0 ? -1.0 : 1.0}, side);
    }
  }

  void add_rims() {
    for (std::size_t i = 0; i + 1 < base_end_.size(); ++i) {
      const RimPoint &a = base_end_[i], &b = base_end_[i + 1];
      builder_.quad(on_base(a, 0), on_base(a, kThickness), on_base(b, kThickness), on_base(b, 0));
      const RimPoint &c = upright_end_[i], &d = upright_end_[i + 1];
      builder_.quad(on_upright(c, kThickness), on_upright(c, 0), on_upright(d, 0), on_upright(d, kThickness));
    }
  }

  void add_rib() {
    const auto foot = [](double z) { return Vec3{kThickness + kRibReach, kThickness, z}; };
    const auto head = [](double z) { return Vec3{kThickness, kThickness + kRibRise, z}; };
    const auto root = [](double z) { return Vec3{kThickness, kThickness, z}; };
    builder_.triangle(root(kRibLow), head(kRibLow), foot(kRibLow));
    builder_.triangle(root(kRibHigh), foot(kRibHigh), head(kRibHigh));
    builder_.quad(foot(kRibLow), head(kRibLow), head(kRibHigh), foot(kRibHigh));
  }

  void add_boss() {
    const int n = detail_.around;
    const Loop shoulder = circle(boss(), kBossRadius, kBossTop - kBossChamfer, n);
    const Loop top = circle(boss(), kBossRadius - kBossChamfer, kBossTop, n),
               mouth = circle(boss(), kBore, kBossTop, n);
    builder_.wall(circle(boss(), kBossRadius, kThickness, n), shoulder, detail_.rings);
    builder_.wall(shoulder, top);
    builder_.face({0, 1, 0}, top, std::vector<Loop>{mouth});
    builder_.wall(mouth, circle(boss(), kBore, 0, n), detail_.rings);
  }

  const Detail detail_;
  const std::vector<RimPoint> base_end_, upright_end_;
  CadBuilder builder_;
};

}  // namespace

std::vector<BoltHole> bracket_bolt_holes() {
  std::vector<BoltHole> holes;
  for (double x : {32.0, 98.0})
    for (double z : {12.0, kWidth - 12.0})
      holes.push_back({{{x, kThickness, z}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, kBaseHole, kThickness});
  for (double z : {14.0, kWidth - 14.0})
    holes.push_back({{{kThickness, 56, z}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}}, kUprightHole, kThickness});
  return holes;
}

TriangleSoup make_bracket(std::uint32_t about_triangles) {
  return Bracket(detail_for(about_triangles)).build();
}

}  // namespace selvage
