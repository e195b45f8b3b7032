// SPDX-License-Identifier: MIT
#include "common/codec/geometry_walk.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace selvage {
namespace {

constexpr unsigned kMostParallelograms = 8, kMostNeighbours = 16;
// Called once a vertex, from one place: saving registers would be a tenth of the work.
#define SELVAGE_ONE_CALLER [[gnu::always_inline]] inline

constexpr VertexId kUnvisited = 1u << 31;

constexpr std::array<float, kMostNeighbours + 1> kReciprocal = [] {
  std::array<float, kMostNeighbours + 1> reciprocal{};
  for (unsigned n = 1; n <= kMostNeighbours; ++n) reciprocal[n] = 1.0F / static_cast<float>(n);
  return reciprocal;
}();

unsigned shape_class_of(unsigned parallelograms, unsigned valence, bool is_border) {
  const unsigned count = std::min(parallelograms, 4u) - 1;
  const unsigned ring = std::clamp(valence, 3u, 10u) - 3;
  return (count * 8 + ring) * 2 + is_border;
}

/// Finds the axis that a normal is closest to, and how the plane rises along it.
void set_tangent_plane(FloatLanes normal, Surroundings& around) {
  const float x = normal[0], y = normal[1], z = normal[2];
  const float ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
  const bool is_x = ax >= ay && ax >= az, is_y = !is_x && ay >= az;
  const float along = is_x ? x : is_y ? y : z;
  const float first = is_x ? y : is_y ? z : x, second = is_x ? z : is_y ? x : y;
  const float scale = along == 0 ? 0 : -1.0F / along;
  around.normal_axis = is_x ? 0 : is_y ? 1 : 2;
  around.slopes[0] = first * scale;
  around.slopes[1] = second * scale;
}

}  // namespace

/// The triangles around a vertex counter-clockwise: each one's corner at the vertex, and the neighbour that
/// it begins with; in an open fan the last neighbour as well. Sets of them are bits, the last one lowest, so
/// that the neighbour that a triangle ends with is the next lower bit. Fans beyond kMost triangles are cut
/// short.
struct GeometryWalk::Fan {
  static constexpr unsigned kMost = 62;
  unsigned triangles = 0;
  unsigned neighbours = 0;
  bool is_border = false;
  std::uint64_t unknown = 0;  ///< of the neighbours
  std::array<CornerId, kMost + 1> corners;
  std::array<VertexId, kMost + 1> ring;

  std::uint64_t all_neighbours() const { return (std::uint64_t{1} << neighbours) - 1; }
  /// Triangles as bits of the neighbours they begin with.
  std::uint64_t all_triangles() const { return all_neighbours() & ~(neighbours - triangles); }
  /// Of a set of neighbours: the triangles that end with one.
  std::uint64_t ending_with(std::uint64_t set) const { return set << 1 | set >> (neighbours - 1); }
  unsigned place(std::uint64_t set) const {
    return neighbours - 1 - static_cast<unsigned>(std::countr_zero(set));
  }
  VertexId begin(unsigned place) const { return ring[place]; }
  VertexId end(unsigned place) const { return ring[place + 1 == neighbours ? 0 : place + 1]; }
};

GeometryWalk::GeometryWalk(CornerTable table, std::uint32_t most_vertices, std::int32_t extent)
    : table_(std::move(table)),
      most_vertices_(most_vertices),
      corners_left_(table_.corner_count()),
      states_(table_.vertex_count(), kUnseen),
      well_(new CornerId[table_.vertex_count() + 1]),
      once_(new CornerId[table_.vertex_count() + 1]),
      corner_of_visited_(most_vertices),
      known_(new Known[most_vertices]) {
  for (VertexId& v : table_.vertex_of_corner) v |= kUnvisited;
  // Until residuals are known: about an edge's length, taking the region for a square.
  const int half_octaves = std::bit_width(table_.triangle_count());
  recent_tangential_ = recent_normal_ =
      32 * log_size(static_cast<std::uint64_t>(extent) * 4 >> half_octaves / 2);
}

SELVAGE_ONE_CALLER bool GeometryWalk::find_next() {
  const VertexId* vertices = table_.vertex_of_corner.data();
  while (next_well_ < well_end_) {
    current_ = well_[next_well_++];
    if (vertices[current_] >= kUnvisited) return true;
  }
  while (next_once_ < once_end_) {
    current_ = once_[next_once_++];
    if (vertices[current_] >= kUnvisited) return true;
  }
  for (; next_seed_ < table_.corner_count(); ++next_seed_) {
    current_ = next_seed_;
    if (vertices[current_] >= kUnvisited) return true;
  }
  return false;
}

SELVAGE_ONE_CALLER void GeometryWalk::turn_around(Fan& fan) {
  VertexId* vertices = table_.vertex_of_corner.data();
  const CornerId* opposites = table_.opposite.data();
  const VertexId number = count_;
  old_number_ = vertices[current_] & ~kUnvisited;
  unsigned triangles = 0, collected = 0;
  std::uint64_t unknown = 0;
  const auto turn = [&](CornerId first) {
    triangles = collected = 0;
    unknown = 0;
    for (CornerId c = first, c_next = next(first);;) {
      const VertexId neighbour = vertices[c_next];
      vertices[c] = number;
      ++triangles;
      fan.corners[collected] = c;
      fan.ring[collected] = neighbour;
      if (collected < Fan::kMost) {
        unknown = unknown * 2 + (neighbour >> 31);
        ++collected;
      }
      const CornerId across = opposites[c_next];
      if (across == kNone) return c;
      c = next(across);
      if (c == first) return kNone;
      c_next = prev(across);
    }
  };
  CornerId first = current_, last = turn(first);
  if (last != kNone) {  // an open fan: once more, from its clockwise end
    for (CornerId across = opposites[prev(first)]; across != kNone; across = opposites[prev(first)])
      first = prev(across);
    last = turn(first);
    fan.ring[collected] = vertices[prev(last)];
    unknown = unknown * 2 + (fan.ring[collected] >> 31);
    border_.push_back(number);
  }
  corner_of_visited_[number] = first;
  corners_left_ -= triangles;
  fan.is_border = last != kNone;
  fan.neighbours = collected + fan.is_border;
  // Cut short, a fan is open where it was cut.
  const bool is_open = fan.is_border || collected < triangles;
  if (fan.neighbours > Fan::kMost) fan.neighbours = Fan::kMost, unknown >>= 1;
  fan.triangles = fan.neighbours - is_open;
  fan.unknown = unknown;
}

/// Triangles that now have two known vertices will predict their third.
SELVAGE_ONE_CALLER void GeometryWalk::offer_neighbours(const Fan& fan) {
  const VertexId* vertices = table_.vertex_of_corner.data();
  const std::uint64_t offered = (fan.unknown ^ fan.ending_with(fan.unknown)) & fan.all_triangles();
  for (std::uint64_t left = offered; left != 0; left &= left - 1) {
    const unsigned place = fan.place(left);
    const bool is_begin = fan.begin(place) >= kUnvisited;
    const CornerId corner = is_begin ? next(fan.corners[place]) : prev(fan.corners[place]);
    State& state = states_[vertices[corner] & ~kUnvisited];
    // Both are written, one counts; none does if the neighbour has been offered often enough.
    once_[once_end_] = well_[well_end_] = corner;
    once_end_ += state == kUnseen;
    well_end_ += state == kOnce;
    state = static_cast<State>(state + (state != kWell));
  }
}

SELVAGE_ONE_CALLER void GeometryWalk::summarise(const Fan& fan, Surroundings& around) const {
  const Known* known = known_.get();
  const VertexId* vertices = table_.vertex_of_corner.data();
  const std::uint64_t neighbours = fan.all_neighbours() & ~fan.unknown;
  IntLanes base = known[fan.begin(fan.place(neighbours))].position;
  base[3] = 0;
  IntLanes ring{};
  FloatLanes errors{};
  unsigned m = 0;
  for (std::uint64_t left = neighbours; left != 0 && m < kMostNeighbours; left &= left - 1, ++m) {
    const Known& neighbour = known[fan.begin(fan.place(left))];
    ring += neighbour.position - base;
    errors += neighbour.error;
  }

  std::array<IntLanes, kMostParallelograms> tips;
  IntLanes sum{}, edges{};
  FloatLanes normal{};
  unsigned n = 0;
  for (std::uint64_t left = neighbours & fan.ending_with(neighbours) & fan.all_triangles();
       left != 0 && n < kMostParallelograms; left &= left - 1) {
    const unsigned place = fan.place(left);
    const CornerId across = table_.opposite[fan.corners[place]];
    // Two triangles back to back have this very vertex across.
    if (across == kNone || vertices[across] >= count_) continue;
    const IntLanes p = known[fan.begin(place)].position - base, q = known[fan.end(place)].position - base,
                   r = known[vertices[across]].position - base;
    tips[n] = p + q - r;
    sum += tips[n];
    edges += p + q;
    normal += cross(to_float(q - p), to_float(r - p));
    ++n;
  }

  const FloatLanes mean_ring = to_float(ring) * kReciprocal[m], mean_error = errors * kReciprocal[m];

  around.parallelograms = n;
  around.size_class = std::min(n, 3u);
  around.base = base;
  around.recent_tangential = recent_tangential_ / 32;
  around.recent_normal = recent_normal_ / 32;
  if (n == 0) {
    around.shape_class = 0;
    around.mean = mean_ring;
    around.beyond = around.ring = around.trend = FloatLanes{};
    around.normal_axis = 2;
    around.slopes[0] = around.slopes[1] = 0;
    around.logs = log8(FloatLanes{mean_ring[3], mean_error[3], 0, 0} * 4.0F + 1.0F);
    return;
  }

  const FloatLanes mean = to_float(sum) * kReciprocal[n], edge = to_float(edges) * (0.5F * kReciprocal[n]);
  FloatLanes spread{};
  for (unsigned i = 0; i < n; ++i) spread += absolute(to_float(tips[i]) - mean);
  around.shape_class = shape_class_of(n, fan.triangles, fan.is_border);
  around.mean = mean;
  around.beyond = mean - edge;
  around.ring = mean_ring - edge;
  around.trend = mean_error;
  const float mean_spread = sum_of_three(spread) * kReciprocal[n];
  const float reach = sum_of_three(absolute(around.beyond));
  around.logs = log8(FloatLanes{mean_ring[3], mean_error[3], mean_spread, reach} * 4.0F + 1.0F);
  set_tangent_plane(normal, around);
}

bool GeometryWalk::next_vertex(Surroundings& around) {
  if (count_ == most_vertices_ || !find_next()) return false;
  Fan fan;
  turn_around(fan);
  offer_neighbours(fan);
  around.has_neighbours = fan.unknown != fan.all_neighbours();
  if (around.has_neighbours) summarise(fan, around);
  return true;
}

void GeometryWalk::place_first(const GridPoint& position) {
  known_[count_++] = {IntLanes{position.x, position.y, position.z, 0}, FloatLanes{}};
}

CornerTable GeometryWalk::take_table() {
  corner_of_visited_.resize(count_);
  table_.corner_of_vertex = std::move(corner_of_visited_);
  return std::move(table_);
}

std::vector<GridPoint> GeometryWalk::positions() const {
  std::vector<GridPoint> positions(count_);
  for (VertexId v = 0; v < count_; ++v) {
    const IntLanes p = known_[v].position;
    positions[v] = {p[0], p[1], p[2]};
  }
  return positions;
}

}  // namespace selvage
