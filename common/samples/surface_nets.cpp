// SPDX-License-Identifier: MIT
#include "common/samples/surface_nets.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "common/base/ids.h"
#include "common/samples/relax.h"

namespace selvage {
namespace {

/// Values of a solid at grid nodes, a plane of constant z at a time. Blocks that the surface is far from get
/// one value for all their nodes, of the right sign: nine nodes in ten are never evaluated.
class Sampler {
 public:
  Sampler(Solid solid, const SolidBounds& bounds, double cell)
      : solid_(solid), low_(bounds.low - Vec3{1, 1, 1} * (2 * cell)), cell_(cell) {
    const Vec3 size = bounds.high - low_ + Vec3{1, 1, 1} * (2 * cell);  // the outermost cells stay empty
    nx_ = static_cast<int>(std::ceil(size.x / cell)) + 1;
    ny_ = static_cast<int>(std::ceil(size.y / cell)) + 1;
    nz_ = static_cast<int>(std::ceil(size.z / cell)) + 1;
    block_columns_ = nx_ / kBlock + 1, block_rows_ = ny_ / kBlock + 1;
  }

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int nz() const { return nz_; }
  Vec3 node(double x, double y, double z) const { return low_ + Vec3{x, y, z} * cell_; }

  /// Fills `values` with the nx * ny values of plane z. Planes are asked for in order.
  void sample_plane(int z, std::vector<float>& values) {
    if (z % kBlock == 0) sample_blocks(z / kBlock);
    values.resize(static_cast<std::size_t>(nx_) * ny_);
    for (int y = 0; y < ny_; ++y) {
      for (int x = 0; x < nx_; ++x) {
        const float at_middle = block_values_[(y / kBlock) * block_columns_ + x / kBlock];
        const bool is_far = std::abs(at_middle) > kFar * kBlock * cell_;
        values[static_cast<std::size_t>(y) * nx_ + x] =
            is_far ? at_middle : static_cast<float>(solid_(node(x, y, z)));
      }
    }
  }

 private:
  static constexpr int kBlock = 6;
  static constexpr double kFar =
      1.5;  // half a block's diagonal is 0.87 of its side; solids are not exact distances

  void sample_blocks(int layer) {
    block_values_.resize(static_cast<std::size_t>(block_columns_) * block_rows_);
    const double half = kBlock / 2.0;
    for (int y = 0; y < block_rows_; ++y)
      for (int x = 0; x < block_columns_; ++x)
        block_values_[y * block_columns_ + x] =
            static_cast<float>(solid_(node(x * kBlock + half, y * kBlock + half, layer * kBlock + half)));
  }

  Solid solid_;
  Vec3 low_;
  double cell_;
  int nx_, ny_, nz_, block_columns_, block_rows_;
  std::vector<float> block_values_;
};

/// Which corner of a cell to count as inside so that the cell's net is one sheet, by the cell's pattern of
/// inside corners. One vertex cannot serve two sheets: they would touch there, in an edge or in a point. Two
/// sheets need a face with inside corners on one diagonal only, or two corners alone on a diagonal of the
/// cell. Corner numbers have bits x, y, z; only the four of the upper plane are given, the lower plane being
/// settled.
class SheetRepair {
 public:
  static constexpr int kNothing = -1;

  SheetRepair() {
    for (int pattern = 0; pattern < 256; ++pattern) corner_to_fill_[pattern] = find(pattern);
  }
  int corner_to_fill(int pattern) const { return corner_to_fill_[pattern]; }

 private:
  static bool is_inside(int pattern, int corner) { return (pattern >> corner & 1) != 0; }

  static int find(int pattern) {
    for (int axis = 0; axis < 3; ++axis) {
      const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
      for (int base : {0, 1 << axis}) {
        const bool a = is_inside(pattern, base), b = is_inside(pattern, base + u),
                   c = is_inside(pattern, base + u + v), d = is_inside(pattern, base + v);
        if (a != c || b != d || a == b) continue;
        for (int corner : {base, base + u, base + u + v, base + v})
          if (corner >= 4 && !is_inside(pattern, corner)) return corner;
      }
    }
    for (int corner = 0; corner < 4; ++corner) {
      const int pair = 1 << corner | 1 << (7 - corner);
      if (pattern == pair) return 4 + corner;  // above the lower one; another pass leads on to the upper
      if (pattern == 255 - pair) return 7 - corner;
    }
    return kNothing;
  }

  std::array<int, 256> corner_to_fill_{};
};

/// The net of one layer of cells after the other.
class Netter {
 public:
  explicit Netter(Sampler& sampler) : sampler_(sampler), nx_(sampler.nx()), ny_(sampler.ny()) {}

  TriangleSoup run() {
    const std::size_t plane = static_cast<std::size_t>(nx_) * ny_;
    vertex_below_.assign(plane, kNone);
    vertex_here_.assign(plane, kNone);
    sampler_.sample_plane(0, values_here_);
    for (int z = 0; z + 1 < sampler_.nz(); ++z) {
      sampler_.sample_plane(z + 1, values_above_);
      while (fill_where_sheets_touch()) {
      }
      place_vertices(z);
      add_quads(z);
      std::swap(values_here_, values_above_);
      std::swap(vertex_below_, vertex_here_);
    }
    return std::move(soup_);
  }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * nx_ + x; }

  float value(int x, int y, int dz) const { return (dz == 0 ? values_here_ : values_above_)[index(x, y)]; }

  /// Makes nodes of the plane above inside until every cell below it has one sheet. Only nodes within a cell
  /// of the surface are touched, and vertices are moved onto the surface afterwards, so the shape stays.
  bool fill_where_sheets_touch() {
    static const SheetRepair repair;
    bool has_filled = false;
    for (int y = 0; y + 1 < ny_; ++y) {
      for (int x = 0; x + 1 < nx_; ++x) {
        int pattern = 0;
        for (int corner = 0; corner < 8; ++corner)
          pattern |= (value(x + (corner & 1), y + (corner >> 1 & 1), corner >> 2) < 0 ? 1 : 0) << corner;
        const int corner = repair.corner_to_fill(pattern);
        if (corner == SheetRepair::kNothing) continue;
        values_above_[index(x + (corner & 1), y + (corner >> 1 & 1))] = -1e-6f;
        has_filled = true;
      }
    }
    return has_filled;
  }

  /// One vertex to a cell with nodes on both sides: the mean of where the surface crosses the cell's edges.
  void place_vertices(int z) {
    for (int y = 0; y + 1 < ny_; ++y) {
      for (int x = 0; x + 1 < nx_; ++x) {
        Vec3 sum;
        int crossings = 0;
        for (int axis = 0; axis < 3; ++axis) {
          for (int corner = 0; corner < 4; ++corner) {
            std::array<int, 3> from{};
            from[(axis + 1) % 3] = corner & 1;
            from[(axis + 2) % 3] = corner >> 1;
            std::array<int, 3> to = from;
            to[axis] = 1;
            const float a = value(x + from[0], y + from[1], from[2]), b = value(x + to[0], y + to[1], to[2]);
            if ((a < 0) == (b < 0)) continue;
            Vec3 at{double(from[0]), double(from[1]), double(from[2])};
            at[axis] = a / (a - b);
            sum += at;
            ++crossings;
          }
        }
        VertexId& vertex = vertex_here_[index(x, y)];
        vertex = kNone;
        if (crossings == 0) continue;
        vertex = static_cast<VertexId>(soup_.positions.size());
        const Vec3 mean = sum * (1.0 / crossings);
        soup_.positions.push_back(sampler_.node(x + mean.x, y + mean.y, z + mean.z));
      }
    }
  }

  /// One quad to a grid edge that crosses the surface, between the four cells around it.
  void add_quads(int z) {
    for (int y = 1; y + 1 < ny_; ++y) {
      for (int x = 1; x + 1 < nx_; ++x) {
        const bool is_inside = value(x, y, 0) < 0;
        const auto here = [&](int dx, int dy) { return vertex_here_[index(x + dx, y + dy)]; };
        const auto below = [&](int dx, int dy) { return vertex_below_[index(x + dx, y + dy)]; };
        if (is_inside != (value(x, y, 1) < 0))
          add_quad(is_inside, here(-1, -1), here(0, -1), here(0, 0), here(-1, 0));
        if (z == 0) continue;
        if (is_inside != (value(x + 1, y, 0) < 0))
          add_quad(is_inside, below(0, -1), below(0, 0), here(0, 0), here(0, -1));
        if (is_inside != (value(x, y + 1, 0) < 0))
          add_quad(is_inside, below(-1, 0), here(-1, 0), here(0, 0), below(0, 0));
      }
    }
  }

  /// Split along the shorter diagonal. Counter-clockwise from outside if the edge leads out of the solid.
  void add_quad(bool leads_out, VertexId a, VertexId b, VertexId c, VertexId d) {
    if (!leads_out) std::swap(b, d);
    const auto& p = soup_.positions;
    if (length(p[a] - p[c]) <= length(p[b] - p[d])) {
      soup_.triangles.insert(soup_.triangles.end(), {{a, b, c}, {a, c, d}});
    } else {
      soup_.triangles.insert(soup_.triangles.end(), {{b, c, d}, {b, d, a}});
    }
  }

  Sampler& sampler_;
  const int nx_, ny_;
  std::vector<float> values_here_, values_above_;
  std::vector<VertexId> vertex_below_, vertex_here_;  // of the cell whose lowest node it is
  TriangleSoup soup_;
};

}  // namespace

TriangleSoup mesh_solid(Solid solid, const SolidBounds& bounds, double cell) {
  Sampler sampler(solid, bounds, cell);
  return Netter(sampler).run();
}

double cell_for_triangles(Solid solid, const SolidBounds& bounds, std::uint32_t triangles) {
  const Vec3 size = bounds.high - bounds.low;
  const double coarse = std::max({size.x, size.y, size.z}) / 48;
  const auto count = static_cast<double>(mesh_solid(solid, bounds, coarse).triangles.size());
  return coarse * std::sqrt(count / triangles);
}

TriangleSoup scan_solid(Solid solid, const SolidBounds& bounds, std::uint32_t about_triangles) {
  TriangleSoup soup = mesh_solid(solid, bounds, cell_for_triangles(solid, bounds, about_triangles));
  relax_on_surface(soup, solid);
  return soup;
}

}  // namespace selvage
