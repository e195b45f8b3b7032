// SPDX-License-Identifier: MIT
#include "common/codec/predictor.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>

namespace selvage {
namespace {

std::uint32_t size_of(const GridPoint& p) {
  return static_cast<std::uint32_t>(std::abs(p.x)) + static_cast<std::uint32_t>(std::abs(p.y)) +
         static_cast<std::uint32_t>(std::abs(p.z));
}

/// Rounds to nearest, halves away from zero.
std::int32_t divide(std::int32_t sum, std::int32_t count) {
  return (sum >= 0 ? sum + count / 2 : sum - count / 2) / count;
}

GridPoint divide(const GridPoint& sum, std::int32_t count) {
  return {divide(sum.x, count), divide(sum.y, count), divide(sum.z, count)};
}

/// `expected` is four times the sum of the three axes' magnitudes.
ResidualContext context_of(std::uint64_t expected, unsigned parallelograms) {
  const auto clamped = static_cast<std::uint32_t>(std::min<std::uint64_t>(expected, 1u << 30));
  const int octave = std::bit_width(clamped | 1u) - 1;
  const unsigned half = octave > 0 ? clamped >> (octave - 1) & 1u : 0;
  const unsigned magnitude =
      std::min(2 * static_cast<unsigned>(octave) + half, ResidualContext::kMagnitudes - 1);
  // An axis holds a third of the sum, so 12 units are one grid step; keep the likely values below 4 of 16
  // symbols.
  return {magnitude * 3 + std::min(parallelograms, 2u), std::max(0, octave - 5)};
}

}  // namespace

Predictor::Predictor(const CornerTable& table, int bits) : table_(table), bits_(bits) {
  positions_.reserve(table.vertex_count());
  residual_size_.reserve(table.vertex_count());
}

Prediction Predictor::predict() const {
  constexpr int kMost = 16;  // sums of 16 parallelograms of 24-bit coordinates stay within 32 bits
  const auto v = static_cast<VertexId>(positions_.size());
  GridPoint parallelogram_sum, neighbour_sum;
  std::array<GridPoint, kMost> parallelograms;
  std::uint64_t residuals = 0;
  std::int32_t count = 0, residual_count = 0, neighbours = 0;

  const CornerId first = table_.corner_of_vertex[v];
  for (CornerId c = first; c != kNone && count < kMost && neighbours < kMost;) {
    const VertexId after = table_.vertex(next(c)), before = table_.vertex(prev(c));
    if (after < v) {
      neighbour_sum = neighbour_sum + positions_[after];
      residuals += residual_size_[after];
      ++neighbours;
      ++residual_count;
    }
    const CornerId across = table_.opposite[c];
    if (after < v && before < v && across != kNone && table_.vertex(across) < v) {
      const VertexId opposite = table_.vertex(across);
      const GridPoint corner = positions_[after] + positions_[before] - positions_[opposite];
      parallelograms[count++] = corner;
      parallelogram_sum = parallelogram_sum + corner;
      residuals += residual_size_[opposite];
      ++residual_count;
    }
    if (before < v && table_.opposite[next(c)] == kNone) {  // the last neighbour of an open fan
      neighbour_sum = neighbour_sum + positions_[before];
      residuals += residual_size_[before];
      ++neighbours;
      ++residual_count;
    }
    c = table_.swing_ccw(c);
    if (c == first) break;
  }

  if (neighbours == 0) {
    const std::int32_t middle = std::int32_t{1} << (bits_ - 1);
    return {v == 0 ? GridPoint{middle, middle, middle} : positions_[v - 1],
            context_of(std::uint64_t{1} << bits_, 0)};
  }
  if (count == 0) {
    const GridPoint mean = divide(neighbour_sum, neighbours);
    std::uint64_t spread = 0;
    if (neighbours > 1) spread = size_of(positions_[v - 1] - mean);
    return {mean, context_of(4 * (residuals / residual_count + spread), 0)};
  }
  const GridPoint mean = divide(parallelogram_sum, count);
  std::uint64_t spread = 0;
  for (int i = 0; i < count; ++i) spread += size_of(parallelograms[i] - mean);
  const std::uint64_t expected = 4 * residuals / static_cast<std::uint64_t>(residual_count);
  if (count == 1) return {mean, context_of(expected, 1)};
  return {mean, context_of((expected * 2 + 4 * spread / static_cast<std::uint64_t>(count)) / 3, 2)};
}

void Predictor::append(const GridPoint& position, const GridPoint& residual) {
  positions_.push_back(position);
  residual_size_.push_back(size_of(residual));
}

}  // namespace selvage
