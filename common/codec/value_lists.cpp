// SPDX-License-Identifier: MIT
#include "common/codec/value_lists.h"

#include <algorithm>
#include <bit>

namespace selvage {
namespace {

/// Any odd number without a pattern: 2^64 divided by the golden ratio.
constexpr std::uint64_t kMix = 0x9E3779B97F4A7C15;

/// Which of the places are equal.
unsigned pattern_of(const PlaceWalk::Around& around) {
  const auto [a, b, o] = std::array{around.a, around.b, around.o};
  if (around.shape == PlaceWalk::Shape::OneNeighbour) return 5;
  if (around.shape == PlaceWalk::Shape::SeveralNeighbours) return a == b ? 7 : 6;
  if (a == b) return a == o ? 0 : 1;
  return a == o ? 2 : b == o ? 3 : 4;
}

std::uint64_t key_of(const PlaceWalk::Around& around) {
  const std::uint64_t places = (around.a * kMix + around.b) * kMix + around.o;
  return (places * kMix + 4 * around.axis + static_cast<unsigned>(around.shape)) * kMix;
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
    for (const AxisSigns& s : signs) count += (s[axis] & 1u) + (s[axis] >> 1);
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

PlaceWalk::PlaceWalk(const ValueLists& lists, std::uint32_t vertices)
    : lists_(lists),
      places_(vertices),
      memory_shift_(64 - memory_bits(vertices)),
      memory_(std::size_t{1} << memory_bits(vertices)) {}

/// The lower one of two that are as near.
std::uint32_t PlaceWalk::nearest(unsigned axis, double value) const {
  const std::vector<double>& list = lists_[axis];
  // How many are lower; without jumps, which could not be guessed.
  std::size_t lower = 0;
  for (std::size_t left = list.size(); left > 0;) {
    const std::size_t half = (left + 1) / 2;
    lower += list[lower + half - 1] < value ? half : 0;
    left -= half;
  }
  const auto place = static_cast<std::uint32_t>(lower);
  if (place == 0) return 0;
  if (place == list.size() || value - list[place - 1] <= list[place] - value) return place - 1;
  return place;
}

PlaceWalk::Around PlaceWalk::look_around(const Fan& fan, unsigned axis) const {
  Around around{.axis = axis, .shape = Shape::OneNeighbour, .a = place_of(fan.neighbour[0], axis)};
  if (fan.parallelograms > 0) {
    const Fan::Parallelogram& first = fan.parallelogram[0];
    around.shape = Shape::Parallelogram;
    around.a = place_of(first.begin, axis);
    around.b = place_of(first.end, axis);
    around.o = place_of(first.across, axis);
  } else if (fan.neighbours > 1) {
    around.shape = Shape::SeveralNeighbours;
    around.b = place_of(fan.neighbour[1], axis);
  }
  around.key = key_of(around);
  const Memory& memory = memory_of(around.key);
  // A stream may bring two axes' keys together, so a place is looked at before it is believed.
  const bool is_remembered =
      memory.check == static_cast<std::uint32_t>(around.key) && memory.place < lists_[axis].size();
  around.remembered = is_remembered ? memory.place : kNone;
  around.model = region_model::kListPick + pattern_of(around) * 2 + is_remembered;
  around.step_model = region_model::kListStep + (around.shape == Shape::Parallelogram);
  return around;
}

std::uint32_t PlaceWalk::expected(const Fan& fan, const Around& around) const {
  if (around.shape != Shape::Parallelogram) return around.a;
  const std::vector<double>& list = lists_[around.axis];
  const auto value_of = [&](VertexId v) { return list[place_of(v, around.axis)]; };
  double sum = 0;
  for (unsigned i = 0; i < fan.parallelograms; ++i) {
    const Fan::Parallelogram& at = fan.parallelogram[i];
    sum += value_of(at.begin) + value_of(at.end) - value_of(at.across);
  }
  return nearest(around.axis, sum / fan.parallelograms);
}

PlaceWalk::Candidates PlaceWalk::candidates(const Fan& fan, const Around& around, unsigned most) const {
  Candidates found;
  const auto add = [&](std::uint32_t place) {
    const auto end = found.places.begin() + found.count;
    if (std::find(found.places.begin(), end, place) == end) found.places[found.count++] = place;
    return found.count == most;
  };
  if (around.remembered != kNone && add(around.remembered)) return found;
  if (add(expected(fan, around))) return found;
  if (around.shape == Shape::Parallelogram) {
    for (const std::uint32_t place : {around.a, around.b, around.o}) {
      if (add(place)) return found;
    }
  }
  for (unsigned i = 0; i < fan.neighbours; ++i) {
    if (add(place_of(fan.neighbour[i], around.axis))) return found;
  }
  return found;
}

void PlaceWalk::place(const Around& around, std::uint32_t place) {
  places_[count_][around.axis] = place;
  memory_of(around.key) = {static_cast<std::uint32_t>(around.key), place};
}

}  // namespace selvage
