// SPDX-License-Identifier: MIT
#include "server/simplify/near_surface.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace selvage {
namespace {

constexpr std::uint32_t kLeafSize = 4;

}  // namespace

NearSurface::NearSurface(std::span<const Triangle> triangles, std::span<const Vec3> positions,
                         std::span<const CornerId> opposite, std::span<const RegionId> region_of_vertex)
    : triangles_(triangles), positions_(positions), opposite_(opposite), region_of_vertex_(region_of_vertex) {
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

NearSurface::Near NearSurface::nearest(const Vec3& p, double nearer_than, std::vector<Open>& stack,
                                       RegionId only) const {
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
      if (only != kNone && region_of(i) != only) continue;
      const double squared = prepared(i).squared_distance(p);
      if (squared < near.squared_distance) near = {i, squared};
    }
  }
  return near;
}

}  // namespace selvage
