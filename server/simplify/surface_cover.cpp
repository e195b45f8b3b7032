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
constexpr double kMargin = 1e-4;
constexpr std::uint32_t kManyCorners = 8;

}  // namespace

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

TriangleTree::Near TriangleTree::nearest(const Vec3& p, double nearer_than, std::vector<Open>& stack) const {
  Near near{kNone, nearer_than};
  const auto open = [&](std::uint32_t node, double squared) {
    if (squared < near.squared_distance) stack.push_back({node, squared});
  };
  stack.clear();
  open(1, boxes_[1].squared_distance(p));
  while (!stack.empty()) {
    const auto [node, box_distance] = stack.back();
    stack.pop_back();
    if (box_distance >= near.squared_distance) continue;
    if (node < leaves_) {
      const double left = boxes_[2 * node].squared_distance(p);
      const double right = boxes_[2 * node + 1].squared_distance(p);
      if (left < right) {
        open(2 * node + 1, right);
        open(2 * node, left);
      } else {
        open(2 * node, left);
        open(2 * node + 1, right);
      }
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

/// Across its longest line from a corner; along one if it has many corners, which adds none.
void CoverBound::halve(const Piece& piece) {
  if (piece.count > kManyCorners) {
    Piece one, other;
    for (std::uint32_t i = 0; i <= piece.count / 2; ++i) one.push(piece.corners[i]);
    for (std::uint32_t i = piece.count / 2; i < piece.count; ++i) other.push(piece.corners[i]);
    other.push(piece.corners[0]);
    pieces_.push_back(one);
    pieces_.push_back(other);
    return;
  }
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
  std::array<Vec3, 3> inwards;
  for (std::size_t side = 0; side < 3; ++side) {
    inwards[side] = cross(triangle.normal, corners[(side + 1) % 3] - corners[side]);
    // Only what holds the middle is worth clipping off: slivers along the plane would come for ever.
    if (dot(inwards[side], middle - corners[side]) <= kMargin * length(inwards[side])) return false;
  }
  const std::size_t before = pieces_.size();
  for (std::size_t side = 0; side < 3; ++side) {
    Piece inside, outside;
    cut(piece, inwards[side], dot(inwards[side], corners[side]), inside, outside);
    if (outside.count > 2) pieces_.push_back(outside);
    piece = inside;
  }
  if (reach(triangle, piece) <= bound_) return true;
  pieces_.resize(before);
  return false;
}

void CoverBound::cover(const Piece& piece) {
  const PreparedTriangle last = surface_.prepared(last_);
  if (reach(last, piece) <= bound_ || clip_to(last, piece)) return;
  const Vec3 middle = piece.middle();
  // Most often something lies within the bound, and looking no farther is quick.
  TriangleTree::Near near = surface_.nearest(middle, bound_ * bound_, stack_);
  if (near.triangle == kNone) {
    near = surface_.nearest(middle, std::numeric_limits<double>::infinity(), stack_);
    bound_ = std::max(bound_, kStep * std::sqrt(near.squared_distance));
  }
  last_ = near.triangle;
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
