// SPDX-License-Identifier: MIT
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace selvage::shapes {
namespace {

constexpr double kTau = 2 * std::numbers::pi;

void add_quad(TriangleSoup& soup, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  soup.triangles.push_back({a, b, c});
  soup.triangles.push_back({a, c, d});
}

/// Unit voxels as an outward quad surface: any set of face-connected cells whose surface is manifold.
TriangleSoup voxels(const std::vector<std::array<int, 3>>& cells) {
  std::map<std::array<int, 3>, std::uint32_t> index_of_corner;
  TriangleSoup soup;
  const auto corner = [&](std::array<int, 3> at) {
    const auto [it, is_new] = index_of_corner.try_emplace(at, static_cast<std::uint32_t>(soup.positions.size()));
    if (is_new) soup.positions.push_back({double(at[0]), double(at[1]), double(at[2])});
    return it->second;
  };
  const auto is_filled = [&](std::array<int, 3> cell) {
    for (const auto& c : cells) if (c == cell) return true;
    return false;
  };
  for (const auto& cell : cells) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int side : {0, 1}) {
        auto beyond = cell;
        beyond[axis] += side == 1 ? 1 : -1;
        if (is_filled(beyond)) continue;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<std::uint32_t, 4> ring;
        for (int k = 0; k < 4; ++k) {
          auto at = cell;
          at[axis] += side;
          at[u] += k == 1 || k == 2;
          at[v] += k >= 2;
          ring[k] = corner(at);
        }
        if (side == 1) add_quad(soup, ring[0], ring[1], ring[2], ring[3]);
        else add_quad(soup, ring[0], ring[3], ring[2], ring[1]);
      }
    }
  }
  return soup;
}

}  // namespace

TriangleSoup triangle() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}; }

TriangleSoup tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

TriangleSoup grid(int columns, int rows) { return grid_with_holes(columns, rows, 0); }

TriangleSoup grid_with_holes(int columns, int rows, int holes) {
  TriangleSoup soup;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) soup.positions.push_back({double(x), double(y), 0.1 * std::sin(x) * std::cos(y)});
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (columns + 1) + x); };
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const bool is_hole = x == y && x % 3 == 1 && x / 3 < holes;
      if (!is_hole) add_quad(soup, at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1));
    }
  }
  return soup;
}

TriangleSoup torus(int around, int along) {
  TriangleSoup soup;
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) {
      const double a = kTau * i / along, b = kTau * j / around, r = 3 + std::cos(b);
      soup.positions.push_back({r * std::cos(a), r * std::sin(a), std::sin(b)});
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>((i % along) * around + j % around); };
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < around; ++j) add_quad(soup, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return soup;
}

TriangleSoup sphere(int subdivisions) {
  TriangleSoup soup{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle_of_edge;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, is_new] = middle_of_edge.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(soup.positions.size()));
      if (is_new) soup.positions.push_back(normalised(soup.positions[a] + soup.positions[b]));
      return it->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : soup.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    soup.triangles = std::move(finer);
  }
  return soup;
}

TriangleSoup open_cylinder(int around, int along) {
  TriangleSoup soup;
  for (int i = 0; i <= along; ++i) {
    for (int j = 0; j < around; ++j) {
      const double b = kTau * j / around;
      soup.positions.push_back({std::cos(b), std::sin(b), double(i)});
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * around + j % around); };
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < around; ++j) add_quad(soup, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
  return soup;
}

TriangleSoup mobius_strip(int along) {
  TriangleSoup soup;
  for (int i = 0; i < along; ++i) {
    for (int side : {-1, 1}) {
      const double a = kTau * i / along, r = 3 + side * std::cos(a / 2);
      soup.positions.push_back({r * std::cos(a), r * std::sin(a), side * std::sin(a / 2)});
    }
  }
  for (int i = 0; i < along; ++i) {
    const auto a = static_cast<std::uint32_t>(2 * i), b = a + 1;
    const bool wraps = i + 1 == along;  // the last piece joins the first upside down
    const std::uint32_t c = wraps ? 0 : b + 2, d = wraps ? 1 : a + 2;
    add_quad(soup, a, b, c, d);
  }
  return soup;
}

TriangleSoup chain_of_tori(int extra) {
  std::vector<std::array<int, 3>> cells;
  const int width = 2 * (extra + 1) + 1;  // a slab three cells deep, with a hole in every second cell of the middle row
  for (int x = 0; x < width; ++x)
    for (int y = 0; y < 3; ++y)
      if (!(y == 1 && x % 2 == 1)) cells.push_back({x, y, 0});
  return voxels(cells);
}

void append(TriangleSoup& to, const TriangleSoup& other) {
  const auto base = static_cast<std::uint32_t>(to.positions.size());
  to.positions.insert(to.positions.end(), other.positions.begin(), other.positions.end());
  for (const auto& [a, b, c] : other.triangles) to.triangles.push_back({base + a, base + b, base + c});
}

TriangleSoup translated(TriangleSoup soup, const Vec3& by) {
  for (Vec3& p : soup.positions) p += by;
  return soup;
}

}  // namespace selvage::shapes
