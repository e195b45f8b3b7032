// SPDX-License-Identifier: MIT
#include "common/codec/geometry_walk.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace selvage {
namespace {

constexpr unsigned kMostParallelograms = 8, kMostNeighbours = 16;
constexpr VertexId kUnvisited = 1u << 31;

/// 2^16 / n, rounded.
constexpr std::array<std::int64_t, kMostNeighbours + 1> kReciprocal = [] {
  std::array<std::int64_t, kMostNeighbours + 1> reciprocal{};
  for (int n = 1; n <= static_cast<int>(kMostNeighbours); ++n) reciprocal[n] = (65536 + n / 2) / n;
  return reciprocal;
}();

/// sum / n in 16ths.
std::int32_t mean16(std::int64_t sum, unsigned n) {
  return static_cast<std::int32_t>((sum * kReciprocal[n]) >> 12);
}

/// Four times sum / n.
std::uint64_t mean4(std::uint64_t sum, unsigned n) {
  return (sum * static_cast<std::uint64_t>(kReciprocal[n])) >> 14;
}

std::uint64_t size_of(std::int32_t x, std::int32_t y, std::int32_t z) {
  return static_cast<std::uint64_t>(std::abs(x)) + static_cast<std::uint64_t>(std::abs(y)) +
         static_cast<std::uint64_t>(std::abs(z));
}

unsigned shape_class_of(unsigned parallelograms, unsigned valence, bool is_border) {
  const unsigned count = std::min(parallelograms, 4u) - 1;
  const unsigned ring = std::clamp(valence, 3u, 10u) - 3;
  return (count * 8 + ring) * 2 + is_border;
}

/// Scales a vector so that its largest component has 15 bits, and finds that component.
void set_normal(Surroundings& around, std::int64_t x, std::int64_t y, std::int64_t z) {
  const std::int64_t ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
  const std::int64_t most = std::max({ax, ay, az});
  if (most == 0) return;
  around.normal_axis = most == ax ? 0 : most == ay ? 1 : 2;
  const int shift = std::max(0, static_cast<int>(std::bit_width(static_cast<std::uint64_t>(most))) - 15);
  around.normal = {static_cast<std::int32_t>(x >> shift), static_cast<std::int32_t>(y >> shift),
                   static_cast<std::int32_t>(z >> shift)};
}

std::int16_t blended(std::int16_t weight, unsigned quarters) {
  return static_cast<std::int16_t>(weight * static_cast<int>(quarters) / 4);
}

}  // namespace

GeometryWalk::GeometryWalk(CornerTable table, const CodecTables& tables, const Blends& blends,
                           std::int32_t extent)
    : table_(std::move(table)),
      tables_(tables),
      tangent_blend_(blends.tangent),
      states_(table_.vertex_count(), kUnseen),
      well_(table_.vertex_count() + 1),
      once_(table_.vertex_count() + 1),
      corner_of_visited_(table_.vertex_count()),
      known_(table_.vertex_count() + 1) {
  for (VertexId& v : table_.vertex_of_corner) v |= kUnvisited;
  // Until residuals are known: about an edge's length, taking the region for a square.
  const int half_octaves = std::bit_width(table_.triangle_count());
  recent_tangential_ = recent_normal_ =
      32 * log_size(static_cast<std::uint64_t>(extent) * 4 >> half_octaves / 2);
  for (unsigned i = 0; i < kShapeClasses; ++i) {
    const ShapeWeights& weights = tables.shape[i];
    shape_[i] = {blended(weights.beyond, blends.shape), blended(weights.ring, blends.shape),
                 blended(weights.trend, blends.trend)};
  }
}

bool GeometryWalk::next_vertex(Surroundings& around) {
  if (!find_next()) return false;
  around = Surroundings{};
  look_around(around);
  return true;
}

bool GeometryWalk::find_next() {
  while (next_well_ < well_end_) {
    current_ = well_[next_well_++];
    if (states_[current_] != kVisited) return true;
  }
  while (next_once_ < once_end_) {
    current_ = once_[next_once_++];
    if (states_[current_] != kVisited) return true;
  }
  for (; next_seed_ < table_.corner_count(); ++next_seed_) {
    current_ = table_.vertex_of_corner[next_seed_];
    if (current_ < kUnvisited) continue;
    current_ ^= kUnvisited;
    return true;
  }
  return false;
}

void GeometryWalk::look_around(Surroundings& around) {
  VertexId* vertices = table_.vertex_of_corner.data();
  const CornerId* opposites = table_.opposite.data();
  const Known* known = known_.data();
  const VertexId nobody = static_cast<VertexId>(known_.size()) - 1;
  std::array<std::int32_t, kMostParallelograms + 1> corner_x, corner_y, corner_z;
  std::int32_t sum_x = 0, sum_y = 0, sum_z = 0, edge_x = 0, edge_y = 0, edge_z = 0;
  std::int32_t ring_x = 0, ring_y = 0, ring_z = 0, trend_x = 0, trend_y = 0, trend_z = 0;
  std::int64_t nx = 0, ny = 0, nz = 0;
  std::uint64_t tangential = 0, normal = 0;
  unsigned valence = 0, neighbours = 0, count = 0;
  VertexId any = nobody;
  bool is_border = false;

  // Without branches: whether a neighbour is known is as good as random.
  const auto meet = [&](VertexId id) {
    const VertexId at = id < kUnvisited ? id : nobody;
    const Known& neighbour = known[at];
    any = id < kUnvisited ? id : any;
    ring_x += neighbour.position.x, ring_y += neighbour.position.y, ring_z += neighbour.position.z;
    trend_x += neighbour.error.x, trend_y += neighbour.error.y, trend_z += neighbour.error.z;
    tangential += neighbour.tangential;
    normal += neighbour.normal;
    neighbours += id < kUnvisited;
  };
  // Local copies: a store to a byte could change any member, as far as the compiler knows.
  std::uint8_t* states = states_.data();
  VertexId *once_end = once_.data() + once_end_, *well_end = well_.data() + well_end_;
  const VertexId number = count_;
  const auto offer = [&](VertexId id, unsigned is_offered) {
    const VertexId v = id & ~kUnvisited;
    const std::uint8_t state = states[v];
    *once_end = v;
    *well_end = v;
    once_end += is_offered & (state == kUnseen);
    well_end += is_offered & (state == kOnce);
    states[v] = static_cast<std::uint8_t>(state + (is_offered & (state < kWell)));
  };

  // The fan counter-clockwise; what comes before one corner comes after the next.
  const CornerId first = table_.corner_of_vertex[current_];
  states[current_] = kVisited;
  corner_of_visited_[number] = first;
  CornerId c = first, c_next = next(first);
  VertexId after = vertices[c_next], before = vertices[prev(first)];
  while (true) {
    vertices[c] = number;
    ++valence;
    if (valence <= kMostNeighbours) meet(after);
    // One of two known: a triangle that will predict the other.
    offer(after > before ? after : before, (after ^ before) >> 31);
    const CornerId across = opposites[c];
    const VertexId o = across == kNone ? kUnvisited : vertices[across];
    const bool spans = ((after | before | o) < kUnvisited) & (count < kMostParallelograms);
    const GridPoint &p = known[spans ? after : nobody].position, &q = known[spans ? before : nobody].position,
                    &r = known[spans ? o : nobody].position;
    const std::int32_t ax = p.x + q.x, ay = p.y + q.y, az = p.z + q.z;
    const std::int32_t dx = ax - r.x, dy = ay - r.y, dz = az - r.z;
    // One number at a time: a copy of the struct reads what was just written in another width, and waits for
    // it.
    corner_x[count] = dx, corner_y[count] = dy, corner_z[count] = dz;
    count += spans;
    sum_x += dx, sum_y += dy, sum_z += dz;
    edge_x += ax, edge_y += ay, edge_z += az;
    const std::int64_t ex = q.x - p.x, ey = q.y - p.y, ez = q.z - p.z;
    const std::int64_t fx = r.x - p.x, fy = r.y - p.y, fz = r.z - p.z;
    nx += ey * fz - ez * fy;
    ny += ez * fx - ex * fz;
    nz += ex * fy - ey * fx;
    const CornerId across_next = opposites[c_next];
    if (across_next == kNone) {  // the last neighbour of an open fan
      is_border = true;
      if (valence < kMostNeighbours) meet(before);
      break;
    }
    c = next(across_next);
    if (c == first) break;
    c_next = next(c);
    after = before;
    before = vertices[across_next];
  }

  once_end_ = static_cast<std::size_t>(once_end - once_.data());
  well_end_ = static_cast<std::size_t>(well_end - well_.data());
  around.parallelograms = count;
  around.neighbours = neighbours;
  around.base = known[any].position;
  around.size_class = std::min(count, 3u);
  around.sizes = {0,
                  0,
                  0,
                  0,
                  static_cast<std::int16_t>(recent_tangential_ / 32),
                  static_cast<std::int16_t>(recent_normal_ / 32),
                  64,
                  0};
  if (neighbours == 0) return;
  around.sizes[0] = log_size(mean4(tangential, neighbours));
  around.sizes[1] = log_size(mean4(normal, neighbours));
  const auto n = static_cast<std::int32_t>(count), m = static_cast<std::int32_t>(neighbours);
  const auto summarise = [&](unsigned axis, std::int32_t base, std::int32_t sum, std::int32_t edges,
                             std::int32_t ring, std::int32_t trend) {
    const std::int32_t mean_ring = mean16(ring - m * base, neighbours);
    if (count == 0) {
      around.edge[axis] = mean_ring;
      return std::int32_t{0};
    }
    const std::int32_t mean = mean16(sum - n * base, count);
    const std::int32_t edge = mean16(edges - 2 * n * base, count) / 2;
    around.edge[axis] = edge;
    around.beyond[axis] = mean - edge;
    around.ring[axis] = mean_ring - edge;
    around.trend[axis] = mean16(trend, neighbours);
    return mean + 16 * base;
  };
  const std::int32_t mean_x = summarise(0, around.base.x, sum_x, edge_x, ring_x, trend_x);
  const std::int32_t mean_y = summarise(1, around.base.y, sum_y, edge_y, ring_y, trend_y);
  const std::int32_t mean_z = summarise(2, around.base.z, sum_z, edge_z, ring_z, trend_z);
  if (count == 0) return;
  std::uint64_t spread = 0;
  if (count > 1) {
    for (unsigned i = 0; i < count; ++i)
      spread += size_of(16 * corner_x[i] - mean_x, 16 * corner_y[i] - mean_y, 16 * corner_z[i] - mean_z);
  }
  around.shape_class = shape_class_of(count, valence, is_border);
  around.sizes[2] = log_size(mean4(spread, count) / 16);
  around.sizes[3] = log_size(size_of(around.beyond[0], around.beyond[1], around.beyond[2]) / 4);
  set_normal(around, nx, ny, nz);
}

GridPoint GeometryWalk::predict(const Surroundings& around) const {
  const ShapeWeights none;
  const ShapeWeights& weights = around.parallelograms > 0 ? shape_[around.shape_class] : none;
  const auto along = [&](unsigned axis) {
    const std::int64_t scaled = std::int64_t{1024} * (around.edge[axis] + around.beyond[axis]) +
                                std::int64_t{weights.beyond} * around.beyond[axis] +
                                std::int64_t{weights.ring} * around.ring[axis] +
                                std::int64_t{weights.trend} * around.trend[axis];
    return static_cast<std::int32_t>((scaled + (1 << 13)) >> 14);
  };
  return {around.base.x + along(0), around.base.y + along(1), around.base.z + along(2)};
}

std::int32_t GeometryWalk::tangent_residual(const Surroundings& around, std::int32_t u,
                                            std::int32_t w) const {
  const unsigned d = around.normal_axis;
  const std::int64_t n = around.normal[d];
  if (n == 0 || tangent_blend_ == 0) return 0;
  const std::int64_t slope =
      std::int64_t{around.normal[(d + 1) % 3]} * u + std::int64_t{around.normal[(d + 2) % 3]} * w;
  return static_cast<std::int32_t>(-slope * static_cast<std::int64_t>(tangent_blend_) / (4 * n));
}

std::array<std::int16_t, kSizeFeatures> GeometryWalk::size_features(const Surroundings& around,
                                                                    std::uint32_t u, std::uint32_t w,
                                                                    std::uint32_t tangent) const {
  std::array<std::int16_t, kSizeFeatures> features;
  std::copy_n(around.sizes.begin(), kCommonSizeFeatures, features.begin());
  features[7] = log_size(4 * std::uint64_t{u});
  features[8] = log_size(4 * std::uint64_t{w});
  features[9] = log_size(4 * std::uint64_t{tangent});
  return features;
}

SizeClass GeometryWalk::size_class(const Surroundings& around, unsigned axis, std::uint32_t u,
                                   std::uint32_t w, std::uint32_t tangent) const {
  const SizeWeights& weights = tables_.size[around.size_class][axis];
  std::int32_t sum = 0;
  for (unsigned i = 0; i < kCommonSizeFeatures; ++i) sum += weights[i] * around.sizes[i];
  if (axis > 0) sum += weights[7] * log_size(4 * std::uint64_t{u});
  if (axis > 1) {
    sum += weights[8] * log_size(4 * std::uint64_t{w});
    sum += weights[9] * log_size(4 * std::uint64_t{tangent});
  }
  // `expected` is a log_size of four times the residual: 8 units an octave.
  const std::int32_t expected = std::clamp(sum >> 8, 0, 8 * 24 - 1);
  return {static_cast<unsigned>(expected) / 4, std::max(0, expected / 8 - 4)};
}

void GeometryWalk::place(const Surroundings& around, const GridPoint& position, std::uint32_t tangential,
                         std::uint32_t normal) {
  Known& known = known_[count_++];
  known.position.x = position.x, known.position.y = position.y, known.position.z = position.z;
  known.tangential = tangential, known.normal = normal;
  if (around.parallelograms > 0) {
    known.error.x = position.x - around.base.x - ((around.edge[0] + around.beyond[0] + 8) >> 4);
    known.error.y = position.y - around.base.y - ((around.edge[1] + around.beyond[1] + 8) >> 4);
    known.error.z = position.z - around.base.z - ((around.edge[2] + around.beyond[2] + 8) >> 4);
  }
  recent_tangential_ += 2 * log_size(4 * std::uint64_t{tangential}) - recent_tangential_ / 16;
  recent_normal_ += 2 * log_size(4 * std::uint64_t{normal}) - recent_normal_ / 16;
}

void GeometryWalk::place_first(const GridPoint& position) { known_[count_++] = {position, {}, 0, 0}; }

CornerTable GeometryWalk::take_table() {
  corner_of_visited_.resize(count_);
  table_.corner_of_vertex = std::move(corner_of_visited_);
  return std::move(table_);
}

std::vector<GridPoint> GeometryWalk::positions() const {
  std::vector<GridPoint> positions(count_);
  for (VertexId v = 0; v < count_; ++v) positions[v] = known_[v].position;
  return positions;
}

}  // namespace selvage
