// SPDX-License-Identifier: MIT
#include "common/codec/value_lists.h"

#include <algorithm>
#include <bit>

namespace selvage {
namespace {

/// Any odd number without a pattern: 2^64 divided by the golden ratio.
constexpr std::uint64_t kMix = 0x9E3779B97F4A7C15;

/// Known surroundings of one axis, in their own order of keys and models.
enum class Shape : unsigned { Parallelogram, SeveralNeighbours, OneNeighbour };

struct Around {
  Shape shape;
  unsigned pattern;       ///< which of the places are equal
  std::uint32_t a, b, o;  ///< 0 where there is none
};

unsigned pattern_of(std::uint32_t a, std::uint32_t b, std::uint32_t o) {
  if (a == b) return a == o ? 0 : 1;
  return a == o ? 2 : b == o ? 3 : 4;
}

std::uint64_t key_of(const Around& around, unsigned axis) {
  const std::uint64_t places = (around.a * kMix + around.b) * kMix + around.o;
  return (places * kMix + 4 * axis + static_cast<unsigned>(around.shape)) * kMix;
}

int memory_bits(std::uint32_t vertices) {
  constexpr int kMost = 18;
  return std::min(static_cast<int>(std::bit_width(vertices)) + 1, kMost);
}

}  // namespace

unsigned SignContext::model(const AxisSigns& signs, unsigned axis) const {
  constexpr unsigned kSecond = region_model::kListSigns + 4, kThird = kSecond + 16;
  if (axis == 0) return region_model::kListSigns + first_axis_;
  if (axis == 1) return kSecond + signs[0] * 4u + first_axis_;
  return kThird + (signs[0] != 0) * 2u + (signs[1] != 0);
}

void SignContext::add(const AxisSigns& signs) { first_axis_ = signs[0] != 0 ? 1 : signs[1] != 0 ? 2 : 3; }

ValueLists make_lists(std::span<const double> magnitudes, std::span<const AxisSigns> signs) {
  ValueLists lists;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::size_t count = 0;
    for (const AxisSigns& s : signs) count += static_cast<std::size_t>(std::popcount(s[axis]));
    std::vector<double>& list = lists[axis];
    list.reserve(count);
    for (std::size_t i = magnitudes.size(); i-- > 0;) {
      if ((signs[i][axis] & 2) != 0) list.push_back(-magnitudes[i]);
    }
    for (std::size_t i = 0; i < magnitudes.size(); ++i) {
      if ((signs[i][axis] & 1) != 0) list.push_back(magnitudes[i]);
    }
  }
  return lists;
}

void PlaceWalk::Guess::add(std::uint32_t place) {
  if (count == kNoCandidate) return;
  const auto end = candidates.begin() + count;
  if (std::find(candidates.begin(), end, place) == end) candidates[count++] = place;
}

PlaceWalk::PlaceWalk(const ValueLists& lists, std::uint32_t vertices)
    : lists_(lists),
      places_(vertices),
      memory_shift_(64 - memory_bits(vertices)),
      memory_(std::size_t{1} << memory_bits(vertices)) {}

/// The lower one of two that are as near.
std::uint32_t PlaceWalk::nearest(unsigned axis, double value) const {
  const std::vector<double>& list = lists_[axis];
  const auto above = std::lower_bound(list.begin(), list.end(), value);
  const auto place = static_cast<std::uint32_t>(above - list.begin());
  if (place == 0) return 0;
  if (above == list.end() || value - above[-1] <= *above - value) return place - 1;
  return place;
}

PlaceWalk::Guess PlaceWalk::guess(const Fan& fan, unsigned axis) const {
  const auto place_of = [&](VertexId v) { return places_[v][axis]; };
  Guess guess;
  Around around{Shape::OneNeighbour, 5, place_of(fan.neighbour[0]), 0, 0};
  guess.expected = around.a;
  if (fan.parallelograms > 0) {
    const Fan::Parallelogram& first = fan.parallelogram[0];
    around = {Shape::Parallelogram, 0, place_of(first.begin), place_of(first.end), place_of(first.across)};
    around.pattern = pattern_of(around.a, around.b, around.o);
    double sum = 0;
    for (unsigned i = 0; i < fan.parallelograms; ++i) {
      const Fan::Parallelogram& at = fan.parallelogram[i];
      const auto value_of = [&](VertexId v) { return lists_[axis][place_of(v)]; };
      sum += value_of(at.begin) + value_of(at.end) - value_of(at.across);
    }
    guess.expected = nearest(axis, sum / fan.parallelograms);
  } else if (fan.neighbours > 1) {
    around.shape = Shape::SeveralNeighbours;
    around.b = place_of(fan.neighbour[1]);
    around.pattern = around.a == around.b ? 7 : 6;
  }

  guess.key = key_of(around, axis);
  const Memory& memory = memory_of(guess.key);
  // A stream may bring two axes' keys together, so a place is looked at before it is believed.
  const bool is_remembered =
      memory.check == static_cast<std::uint32_t>(guess.key) && memory.place < lists_[axis].size();
  if (is_remembered) guess.add(memory.place);
  guess.add(guess.expected);
  if (around.shape == Shape::Parallelogram) {
    for (std::uint32_t place : {around.a, around.b, around.o}) guess.add(place);
  }
  for (unsigned i = 0; i < fan.neighbours; ++i) guess.add(place_of(fan.neighbour[i]));
  guess.model = region_model::kListPick + around.pattern * 2 + is_remembered;
  guess.step_model = region_model::kListStep + (around.shape == Shape::Parallelogram);
  return guess;
}

void PlaceWalk::place(const Guess& guess, unsigned axis, std::uint32_t place) {
  places_[count_][axis] = place;
  memory_of(guess.key) = {static_cast<std::uint32_t>(guess.key), place};
}

}  // namespace selvage
