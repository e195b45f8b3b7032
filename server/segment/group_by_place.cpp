// SPDX-License-Identifier: MIT
#include "server/segment/group_by_place.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "common/base/ids.h"

namespace selvage {
namespace {

/// Spreads the low 21 bits to every third bit.
std::uint64_t spread_bits(std::uint64_t x) {
  x &= 0x1FFFFF;
  x = (x | x << 32) & 0x1F00000000FFFF;
  x = (x | x << 16) & 0x1F0000FF0000FF;
  x = (x | x << 8) & 0x100F00F00F00F00F;
  x = (x | x << 4) & 0x10C30C30C30C30C3;
  x = (x | x << 2) & 0x1249249249249249;
  return x;
}

struct Box {
  Vec3 low{1, 1, 1}, high{};
  double side = 0;
};

Box box_of(std::span<const Vec3> points) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const Vec3& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], p[axis]);
      box.high[axis] = std::max(box.high[axis], p[axis]);
    }
  }
  for (int axis = 0; axis < 3; ++axis) box.side = std::max(box.side, box.high[axis] - box.low[axis]);
  return box;
}

std::uint64_t morton_code(const Vec3& p, const Box& box) {
  constexpr double kCells = (1 << 21) - 1;
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = box.side > 0 ? (p[axis] - box.low[axis]) / box.side * kCells : 0;
    code |= spread_bits(static_cast<std::uint64_t>(std::clamp(cell, 0.0, kCells))) << axis;
  }
  return code;
}

}  // namespace

std::vector<std::uint32_t> group_by_place(const Components& components, std::span<const Vec3> positions,
                                          std::uint32_t min_vertices) {
  std::vector<Vec3> centre(components.count());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const std::uint32_t component = components.of_vertex[v];
    centre[component] += positions[v] * (1.0 / components.vertex_count[component]);
  }
  const Box box = box_of(positions);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> dust;  // Morton code, component
  for (std::uint32_t i = 0; i < components.count(); ++i) {
    if (components.vertex_count[i] < min_vertices) dust.emplace_back(morton_code(centre[i], box), i);
  }
  std::sort(dust.begin(), dust.end());

  std::vector<std::uint32_t> group_of_component(components.count(), kNone);
  std::uint32_t group = 0, vertices = 0;
  for (const auto& [code, component] : dust) {
    group_of_component[component] = group;
    vertices += components.vertex_count[component];
    if (vertices >= min_vertices) ++group, vertices = 0;
  }
  return group_of_component;
}

}  // namespace selvage
