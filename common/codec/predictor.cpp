// SPDX-License-Identifier: MIT
#include "common/codec/predictor.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace selvage {
namespace {

constexpr unsigned kMostParallelograms = 8, kMostNeighbours = 16;

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

Predictor::Predictor(const CornerTable& table, const CodecTables& tables, const Blends& blends,
                     std::int32_t extent)
    : table_(table), tables_(tables), tangent_blend_(blends.tangent) {
  known_.reserve(table.vertex_count());
  // Until residuals are known: about an edge's length, taking the region for a square.
  const int half_octaves = std::bit_width(table.triangle_count());
  recent_tangential_ = recent_normal_ =
      32 * log_size(static_cast<std::uint64_t>(extent) * 4 >> half_octaves / 2);
  for (unsigned i = 0; i < kShapeClasses; ++i) {
    const ShapeWeights& weights = tables.shape[i];
    shape_[i] = {blended(weights.beyond, blends.shape), blended(weights.ring, blends.shape),
                 blended(weights.trend, blends.trend)};
  }
}

Surroundings Predictor::look_around() const {
  const auto v = static_cast<VertexId>(known_.size());
  Surroundings around;
  std::array<GridPoint, kMostParallelograms> parallelograms;
  GridPoint sum, edges, ring, trend;  // relative to base
  std::int64_t nx = 0, ny = 0, nz = 0;
  std::uint64_t tangential = 0, normal = 0;
  unsigned valence = 0;
  bool is_border = false, has_base = false;

  const auto meet = [&](const Known& neighbour) {
    if (!has_base) around.base = neighbour.position, has_base = true;
    ring = ring + (neighbour.position - around.base);
    trend = trend + neighbour.error;
    tangential += neighbour.tangential;
    normal += neighbour.normal;
    ++around.neighbours;
  };

  const CornerId first = table_.corner_of_vertex[v];
  for (CornerId c = first; c != kNone && valence < kMostNeighbours;) {
    const CornerId cn = next(c), cp = prev(c);
    const VertexId after = table_.vertex_of_corner[cn], before = table_.vertex_of_corner[cp];
    ++valence;
    if (after < v) {
      meet(known_[after]);
      const CornerId across = table_.opposite[c];
      if (before < v && across != kNone && around.parallelograms < kMostParallelograms) {
        const VertexId o = table_.vertex_of_corner[across];
        if (o < v) {
          const GridPoint a = known_[after].position - around.base, b = known_[before].position - around.base,
                          d = known_[o].position - around.base;
          const GridPoint corner = a + b - d;
          parallelograms[around.parallelograms++] = corner;
          sum = sum + corner;
          edges = edges + a + b;
          const std::int64_t ex = b.x - a.x, ey = b.y - a.y, ez = b.z - a.z;
          const std::int64_t fx = d.x - a.x, fy = d.y - a.y, fz = d.z - a.z;
          nx += ey * fz - ez * fy;
          ny += ez * fx - ex * fz;
          nz += ex * fy - ey * fx;
        }
      }
    }
    const CornerId across_next = table_.opposite[cn];
    if (across_next == kNone) {  // the last neighbour of an open fan
      is_border = true;
      if (before < v && around.neighbours < kMostNeighbours) meet(known_[before]);
      break;
    }
    c = next(across_next);
    if (c == first) break;
  }

  const unsigned count = around.parallelograms;
  around.size_class = std::min(count, 3u);
  if (around.neighbours == 0) {
    if (v > 0) around.base = known_[v - 1].position;
    return around;
  }
  std::uint64_t spread = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int32_t mean_ring = mean16(ring[axis], around.neighbours);
    if (count == 0) {
      around.edge[axis] = mean_ring;
      continue;
    }
    const std::int32_t mean = mean16(sum[axis], count);
    around.edge[axis] = mean16(edges[axis], count) / 2;
    around.beyond[axis] = mean - around.edge[axis];
    around.ring[axis] = mean_ring - around.edge[axis];
    around.trend[axis] = mean16(trend[axis], around.neighbours);
    for (unsigned i = 0; i < count; ++i)
      spread += static_cast<std::uint64_t>(std::abs(16 * parallelograms[i][axis] - mean));
  }
  around.sizes[0] = log_size(mean4(tangential, around.neighbours));
  around.sizes[1] = log_size(mean4(normal, around.neighbours));
  if (count == 0) return around;
  around.shape_class = shape_class_of(count, valence, is_border);
  around.sizes[2] = log_size(mean4(spread, count) / 16);
  around.sizes[3] = log_size(size_of(around.beyond[0], around.beyond[1], around.beyond[2]) / 4);
  set_normal(around, nx, ny, nz);
  return around;
}

GridPoint Predictor::predict(const Surroundings& around) const {
  GridPoint position = around.base;
  const ShapeWeights none;
  const ShapeWeights& weights = around.parallelograms > 0 ? shape_[around.shape_class] : none;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t scaled = std::int64_t{1024} * (around.edge[axis] + around.beyond[axis]) +
                                std::int64_t{weights.beyond} * around.beyond[axis] +
                                std::int64_t{weights.ring} * around.ring[axis] +
                                std::int64_t{weights.trend} * around.trend[axis];
    position[axis] += static_cast<std::int32_t>((scaled + (1 << 13)) >> 14);
  }
  return position;
}

std::int32_t Predictor::tangent_residual(const Surroundings& around, std::int32_t u, std::int32_t w) const {
  const unsigned d = around.normal_axis;
  const std::int64_t n = around.normal[d];
  if (n == 0 || tangent_blend_ == 0) return 0;
  const std::int64_t slope =
      std::int64_t{around.normal[(d + 1) % 3]} * u + std::int64_t{around.normal[(d + 2) % 3]} * w;
  return static_cast<std::int32_t>(-slope * static_cast<std::int64_t>(tangent_blend_) / (4 * n));
}

std::array<std::int32_t, kSizeFeatures> Predictor::size_features(const Surroundings& around, std::uint32_t u,
                                                                 std::uint32_t w,
                                                                 std::uint32_t tangent) const {
  return {around.sizes[0],
          around.sizes[1],
          around.sizes[2],
          around.sizes[3],
          recent_tangential_ / 32,
          recent_normal_ / 32,
          log_size(4 * std::uint64_t{u}),
          log_size(4 * std::uint64_t{w}),
          log_size(4 * std::uint64_t{tangent}),
          64};
}

SizeClass Predictor::size_class(const Surroundings& around, unsigned axis,
                                const std::array<std::int32_t, kSizeFeatures>& features) const {
  const SizeWeights& weights = tables_.size[around.size_class][axis];
  std::int32_t sum = 0;
  for (unsigned i = 0; i < kSizeFeatures; ++i) sum += weights[i] * features[i];
  // `expected` is a log_size of four times the residual: 8 units an octave.
  const std::int32_t expected = std::clamp(sum >> 8, 0, 8 * 24 - 1);
  return {static_cast<unsigned>(expected) / 4, std::max(0, expected / 8 - 4)};
}

void Predictor::append(const Surroundings& around, const GridPoint& position, std::uint32_t tangential,
                       std::uint32_t normal) {
  Known known{position, {}, tangential, normal};
  if (around.parallelograms > 0) {
    for (int axis = 0; axis < 3; ++axis)
      known.error[axis] =
          position[axis] - around.base[axis] - ((around.edge[axis] + around.beyond[axis] + 8) >> 4);
  }
  recent_tangential_ += 2 * log_size(4 * std::uint64_t{tangential}) - recent_tangential_ / 16;
  recent_normal_ += 2 * log_size(4 * std::uint64_t{normal}) - recent_normal_ / 16;
  known_.push_back(known);
}

std::vector<GridPoint> Predictor::positions() const {
  std::vector<GridPoint> positions;
  positions.reserve(known_.size());
  for (const Known& known : known_) positions.push_back(known.position);
  return positions;
}

}  // namespace selvage
