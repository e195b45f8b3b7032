// SPDX-License-Identifier: MIT
#include "server/simplify/surface_cover.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace selvage {
namespace {

constexpr std::uint32_t kLeafSize = 4;
/// Raising the bound a little more than a piece asks for saves raising it again for its neighbour.
constexpr double kStep = 1.02;
/// Pieces of this share of the bound are not cut any more.
constexpr double kSmall = 0.08;

}  // namespace

double TriangleTree::Box::squared_distance(const Vec3& p) const {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = std::max({low[axis] - p[axis], p[axis] - high[axis], 0.0});
    sum += d * d;
  }
  return sum;
}

TriangleTree::TriangleTree(std::span<const Triangle> triangles, std::span<const Vec3> positions)
    : triangles_(triangles), positions_(positions) {
  const auto count = static_cast<std::uint32_t>(triangles.size());
  leaves_ = std::bit_ceil(std::max(1u, (count + kLeafSize - 1) / kLeafSize));
  constexpr double kFar = std::numeric_limits<double>::infinity();
  boxes_.assign(2 * leaves_, {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}});
  for (std::uint32_t i = 0; i < count; ++i) {
    Box& box = boxes_[leaves_ + i / kLeafSize];
    for (const VertexId v : triangles[i]) {
      for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], positions[v][axis]);
        box.high[axis] = std::max(box.high[axis], positions[v][axis]);
      }
    }
  }
  for (std::uint32_t node = leaves_; node-- > 1;) {
    const Box &one = boxes_[2 * node], &other = boxes_[2 * node + 1];
    for (int axis = 0; axis < 3; ++axis) {
      boxes_[node].low[axis] = std::min(one.low[axis], other.low[axis]);
      boxes_[node].high[axis] = std::max(one.high[axis], other.high[axis]);
    }
  }
}

PreparedTriangle TriangleTree::prepared(std::uint32_t i) const {
  const auto [a, b, c] = triangles_[i];
  return {positions_[a], positions_[b], positions_[c]};
}

TriangleTree::Near TriangleTree::nearest(const Vec3& p, std::uint32_t hint,
                                         std::vector<std::uint32_t>& stack) const {
  Near near{hint, prepared(hint).squared_distance(p)};
  stack.assign(1, 1);
  while (!stack.empty()) {
    const std::uint32_t node = stack.back();
    stack.pop_back();
    if (boxes_[node].squared_distance(p) >= near.squared_distance) continue;
    if (node < leaves_) {
      const bool left_first = boxes_[2 * node].squared_distance(p) < boxes_[2 * node + 1].squared_distance(p);
      stack.push_back(2 * node + left_first);
      stack.push_back(2 * node + !left_first);
      continue;
    }
    const std::uint32_t begin = (node - leaves_) * kLeafSize;
    const std::uint32_t end = std::min(begin + kLeafSize, static_cast<std::uint32_t>(triangles_.size()));
    for (std::uint32_t i = begin; i < end; ++i) {
      const double squared = prepared(i).squared_distance(p);
      if (squared < near.squared_distance) near = {i, squared};
    }
  }
  return near;
}

Vec3 CoverBound::Piece::middle() const {
  Vec3 sum{};
  for (std::uint32_t i = 0; i < count; ++i) sum = sum + corners[i];
  return sum * (1.0 / count);
}

/// At least half its diameter.
double CoverBound::Piece::extent() const {
  double squared = 0;
  for (std::uint32_t i = 1; i < count; ++i) {
    const Vec3 d = corners[i] - corners[0];
    squared = std::max(squared, dot(d, d));
  }
  return std::sqrt(squared);
}

double CoverBound::reach(const PreparedTriangle& triangle, const Piece& piece) const {
  double squared = 0;
  for (std::uint32_t i = 0; i < piece.count; ++i)
    squared = std::max(squared, triangle.squared_distance(piece.corners[i]));
  return std::sqrt(squared);
}

/// What is on either side of the plane normal * p = offset; points on it are on both.
void CoverBound::cut(const Piece& piece, const Vec3& normal, double offset, Piece& above, Piece& below) {
  above.count = below.count = 0;
  for (std::uint32_t i = 0; i < piece.count; ++i) {
    const Vec3 &p = piece.corners[i], &q = piece.corners[i + 1 == piece.count ? 0 : i + 1];
    const double height = dot(normal, p) - offset, next = dot(normal, q) - offset;
    if (height >= 0) above.push(p);
    if (height <= 0) below.push(p);
    if ((height > 0 && next < 0) || (height < 0 && next > 0)) {
      const Vec3 between = p + (q - p) * (height / (height - next));
      above.push(between);
      below.push(between);
    }
  }
}

/// Across its longest line from a corner.
void CoverBound::halve(const Piece& piece) {
  std::uint32_t far = 1;
  double longest = 0;
  for (std::uint32_t i = 1; i < piece.count; ++i) {
    const Vec3 d = piece.corners[i] - piece.corners[0];
    if (dot(d, d) > longest) longest = dot(d, d), far = i;
  }
  const Vec3 along = piece.corners[far] - piece.corners[0];
  Piece above, below;
  cut(piece, along, dot(along, piece.corners[0] + along * 0.5), above, below);
  pieces_.push_back(above);
  pieces_.push_back(below);
}

/// Covers what of the piece is over the triangle, and puts what is not on the pile. False if nothing is, or
/// what is is not near enough: then nothing has been done.
bool CoverBound::clip_to(const PreparedTriangle& triangle, Piece piece) {
  if (triangle.normal_normal == 0 || piece.count + 3 > Piece::kMost) return false;
  const Vec3 corners[] = {triangle.a, triangle.a + triangle.ab, triangle.a + triangle.ac};
  const Vec3 middle = piece.middle();
  const std::size_t before = pieces_.size();
  for (int side = 0; side < 3; ++side) {
    const Vec3 inwards = cross(triangle.normal, corners[(side + 1) % 3] - corners[side]);
    Piece inside, outside;
    // Only what holds the middle is worth clipping off: slivers would come for ever.
    if (dot(inwards, middle - corners[side]) <= 0) piece.count = 0;
    cut(piece, inwards, dot(inwards, corners[side]), inside, outside);
    if (outside.count > 2) pieces_.push_back(outside);
    piece = inside;
    if (piece.count < 3) break;
  }
  if (piece.count >= 3 && reach(triangle, piece) <= bound_) return true;
  pieces_.resize(before);
  return false;
}

void CoverBound::cover(const Piece& piece) {
  if (reach(surface_.prepared(last_), piece) <= bound_) return;
  const TriangleTree::Near near = surface_.nearest(piece.middle(), last_, stack_);
  last_ = near.triangle;
  const double distance = std::sqrt(near.squared_distance);
  if (distance > bound_) bound_ = kStep * distance;
  const PreparedTriangle triangle = surface_.prepared(near.triangle);
  const double piece_reach = reach(triangle, piece);
  if (piece_reach <= bound_ || clip_to(triangle, piece)) return;
  if (piece.extent() <= kSmall * bound_) {
    bound_ = piece_reach;
  } else {
    halve(piece);
  }
}

void CoverBound::add(const Vec3& a, const Vec3& b, const Vec3& c) {
  Piece whole;
  for (const Vec3& corner : {a, b, c}) whole.push(corner);
  pieces_.push_back(whole);
  while (!pieces_.empty()) {
    const Piece piece = pieces_.back();
    pieces_.pop_back();
    cover(piece);
  }
}

}  // namespace selvage
