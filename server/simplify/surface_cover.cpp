// SPDX-License-Identifier: MIT
#include "server/simplify/surface_cover.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace selvage {
namespace {

/// Raising the bound a little more than a piece asks for saves raising it again for its neighbour.
constexpr double kStep = 1.02;
/// Pieces of this share of the bound are not cut any more.
constexpr double kSmall = 0.08;
constexpr double kMargin = 1e-4;
constexpr std::uint32_t kManyCorners = 8;
constexpr int kMostSteps = 24;

constexpr std::uint32_t kNoSide = 3;

/// The corner whose edge the point is farthest beyond, kNoSide if it is over the triangle.
std::uint32_t side_past(const PreparedTriangle& t, const Vec3& p) {
  const Vec3 ap = p - t.a;
  const double along_ab = dot(t.ab, ap), along_ac = dot(t.ac, ap);
  const double b = t.ac_ac * along_ab - t.ab_ac * along_ac;  // barycentric, times normal_normal
  const double c = t.ab_ab * along_ac - t.ab_ac * along_ab;
  const double a = t.normal_normal - b - c;
  if (a >= 0 && b >= 0 && c >= 0) return kNoSide;
  return a <= b && a <= c ? 0 : b <= c ? 1 : 2;
}

bool is_within(const PreparedTriangle& triangle, const ConvexPiece& piece, double bound) {
  for (std::uint32_t i = 0; i < piece.count; ++i) {
    if (triangle.squared_distance(piece.corners[i]) > bound * bound) return false;
  }
  return true;
}

double reach(const PreparedTriangle& triangle, const ConvexPiece& piece) {
  double squared = 0;
  for (std::uint32_t i = 0; i < piece.count; ++i)
    squared = std::max(squared, triangle.squared_distance(piece.corners[i]));
  return std::sqrt(squared);
}

using Heights = std::array<double, ConvexPiece::kMost>;

/// Of the corners over the plane normal * p = offset; gives the least.
double heights_over(const ConvexPiece& piece, const Vec3& normal, double offset, Heights& heights) {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < piece.count; ++i) {
    heights[i] = dot(normal, piece.corners[i]) - offset;
    least = std::min(least, heights[i]);
  }
  return least;
}

/// What is on either side of the plane; points on it are on both.
void cut(const ConvexPiece& piece, const Heights& heights, ConvexPiece& above, ConvexPiece& below) {
  above.count = below.count = 0;
  for (std::uint32_t i = 0; i < piece.count; ++i) {
    const std::uint32_t j = i + 1 == piece.count ? 0 : i + 1;
    const Vec3 &p = piece.corners[i], &q = piece.corners[j];
    if (heights[i] >= 0) above.push(p);
    if (heights[i] <= 0) below.push(p);
    if ((heights[i] > 0 && heights[j] < 0) || (heights[i] < 0 && heights[j] > 0)) {
      const Vec3 between = p + (q - p) * (heights[i] / (heights[i] - heights[j]));
      above.push(between);
      below.push(between);
    }
  }
}

}  // namespace

Vec3 ConvexPiece::middle() const {
  Vec3 sum{};
  for (std::uint32_t i = 0; i < count; ++i) sum = sum + corners[i];
  return sum * (1.0 / count);
}

double ConvexPiece::extent() const {
  double squared = 0;
  for (std::uint32_t i = 1; i < count; ++i) {
    const Vec3 d = corners[i] - corners[0];
    squared = std::max(squared, dot(d, d));
  }
  return std::sqrt(squared);
}

bool CoverBound::is_open_to(std::uint32_t target, std::uint32_t triangle) const {
  const auto& [surface, only] = targets_[target];
  return only == kNone || surface->region_of(triangle) == only;
}

/// To the triangle that the point is over, as far as that gets nearer.
PreparedTriangle CoverBound::walk(Place& place, const Vec3& to) const {
  const NearSurface& surface = *targets_[place.target].surface;
  std::uint32_t before = kNone;
  for (int step = 0;; ++step) {
    const PreparedTriangle triangle = surface.prepared(place.triangle);
    const std::uint32_t side = side_past(triangle, to);
    if (side == kNoSide || step == kMostSteps) return triangle;
    const std::uint32_t beyond = surface.across(place.triangle, side);
    if (beyond == kNone || beyond == before || !is_open_to(place.target, beyond)) return triangle;
    before = std::exchange(place.triangle, beyond);
  }
}

void CoverBound::note(const ConvexPiece& piece, const Place& place) {
  last_ = place;
  if (strays_ != nullptr && targets_[0].surface->region_of(place.triangle) != home_)
    strays_->push_back({piece, place.triangle});
}

/// True if the piece, or what of it is over the triangle, is near enough; the rest is on the pile then.
bool CoverBound::lands(const ConvexPiece& piece, const PreparedTriangle& triangle, const Place& place) {
  if (!is_within(triangle, piece, bound_)) return clip_to(triangle, place, piece);
  note(piece, place);
  return true;
}

/// False if nothing is over the triangle, or what is is not near enough: then nothing has been done.
bool CoverBound::clip_to(const PreparedTriangle& triangle, const Place& place, ConvexPiece piece) {
  if (triangle.normal_normal == 0 || piece.count + 3 > ConvexPiece::kMost) return false;
  const Vec3 corners[] = {triangle.a, triangle.a + triangle.ab, triangle.a + triangle.ac};
  const Vec3 middle = piece.middle();
  std::array<Vec3, 3> inwards;
  std::array<double, 3> margins;
  for (std::size_t side = 0; side < 3; ++side) {
    inwards[side] = cross(triangle.normal, corners[(side + 1) % 3] - corners[side]);
    margins[side] = kMargin * length(inwards[side]);
    // Only what holds the middle is worth clipping off: slivers along the plane would come for ever.
    if (dot(inwards[side], middle - corners[side]) <= margins[side]) return false;
  }
  const std::size_t before = pile_.size();
  for (std::size_t side = 0; side < 3; ++side) {
    Heights heights;
    const double offset = dot(inwards[side], corners[side]);
    if (heights_over(piece, inwards[side], offset, heights) >= -margins[side]) continue;
    Work outside{{}, place};
    ConvexPiece inside;
    cut(piece, heights, inside, outside.piece);
    const std::uint32_t beyond = targets_[place.target].surface->across(place.triangle, (side + 2) % 3);
    if (beyond != kNone && is_open_to(place.target, beyond)) outside.near.triangle = beyond;
    if (outside.piece.count > 2) pile_.push_back(outside);
    piece = inside;
  }
  if (is_within(triangle, piece, bound_)) {
    note(piece, place);
    return true;
  }
  pile_.resize(before);
  return false;
}

/// Across its longest line from a corner; along one if it has many corners, which adds none.
void CoverBound::halve(const ConvexPiece& piece, const Place& near) {
  Work one{{}, near}, other{{}, near};
  if (piece.count > kManyCorners) {
    for (std::uint32_t i = 0; i <= piece.count / 2; ++i) one.piece.push(piece.corners[i]);
    for (std::uint32_t i = piece.count / 2; i < piece.count; ++i) other.piece.push(piece.corners[i]);
    other.piece.push(piece.corners[0]);
  } else {
    std::uint32_t far = 1;
    double longest = 0;
    for (std::uint32_t i = 1; i < piece.count; ++i) {
      const Vec3 d = piece.corners[i] - piece.corners[0];
      if (dot(d, d) > longest) longest = dot(d, d), far = i;
    }
    const Vec3 along = piece.corners[far] - piece.corners[0];
    Heights heights;
    heights_over(piece, along, dot(along, piece.corners[0] + along * 0.5), heights);
    cut(piece, heights, one.piece, other.piece);
  }
  pile_.push_back(one);
  pile_.push_back(other);
}

/// The nearest triangle of all targets, and its squared distance; `place` stays if none is near enough.
double CoverBound::search(const Vec3& p, double nearer_than, Place& place) {
  double least = nearer_than;
  for (std::uint32_t target = 0; target < targets_.size(); ++target) {
    const auto& [surface, only] = targets_[target];
    const NearSurface::Near near = surface->nearest(p, least, stack_, only);
    if (near.triangle == kNone) continue;
    least = near.squared_distance;
    place = {target, near.triangle};
  }
  return least;
}

void CoverBound::cover(const Work& work) {
  const ConvexPiece& piece = work.piece;
  const Vec3 middle = piece.middle();
  Place place = work.near.triangle != kNone ? work.near : last_;
  if (place.triangle != kNone) {
    const PreparedTriangle triangle = walk(place, middle);
    if (lands(piece, triangle, place)) return;
  }
  // Most often something lies within the bound, and looking no farther is quick.
  Place nearest;
  search(middle, bound_ * bound_, nearest);
  if (nearest.triangle == kNone) {
    const double squared = search(middle, std::numeric_limits<double>::infinity(), nearest);
    bound_ = std::max(bound_, kStep * std::sqrt(squared));
  }
  const PreparedTriangle triangle = targets_[nearest.target].surface->prepared(nearest.triangle);
  if (lands(piece, triangle, nearest)) return;
  if (piece.extent() <= kSmall * bound_) {
    bound_ = reach(triangle, piece);
    note(piece, nearest);
  } else {
    halve(piece, nearest);
  }
}

void CoverBound::add(const ConvexPiece& piece) {
  pile_.push_back({piece, {}});
  while (!pile_.empty()) {
    const Work work = pile_.back();
    pile_.pop_back();
    cover(work);
  }
}

void CoverBound::add(const Vec3& a, const Vec3& b, const Vec3& c) {
  ConvexPiece whole;
  for (const Vec3& corner : {a, b, c}) whole.push(corner);
  add(whole);
}

}  // namespace selvage
