// SPDX-License-Identifier: MIT
#include "server/segment/group_by_place.h"

#include <algorithm>
#include <compare>
#include <limits>

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

struct Dust {
  std::uint32_t part;
  std::uint64_t place;  ///< Morton code
  std::uint32_t component;
  friend auto operator<=>(const Dust&, const Dust&) = default;
};

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
                                          std::uint32_t min_vertices,
                                          std::span<const std::uint32_t> part_of_component) {
  std::vector<Vec3> centre(components.count());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const std::uint32_t component = components.of_vertex[v];
    centre[component] += positions[v] * (1.0 / components.vertex_count[component]);
  }
  const Box box = box_of(positions);
  std::vector<Dust> dust;
  for (std::uint32_t i = 0; i < components.count(); ++i) {
    const std::uint32_t part = part_of_component.empty() ? 0 : part_of_component[i];
    if (components.vertex_count[i] >= min_vertices || part == kNone) continue;
    dust.push_back({part, morton_code(centre[i], box), i});
  }
  std::sort(dust.begin(), dust.end());

  std::vector<std::uint32_t> group_of_component(components.count(), kNone);
  std::uint32_t group = 0, vertices = 0;
  for (std::size_t i = 0; i < dust.size(); ++i) {
    const bool is_new_part = i > 0 && dust[i].part != dust[i - 1].part;
    if (vertices >= min_vertices || (is_new_part && vertices > 0)) ++group, vertices = 0;
    group_of_component[dust[i].component] = group;
    vertices += components.vertex_count[dust[i].component];
  }
  return group_of_component;
}

}  // namespace selvage
