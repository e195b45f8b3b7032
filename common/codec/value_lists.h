// SPDX-License-Identifier: MIT
//
// Positions of regions whose coordinates repeat, as those of machine parts do: a sorted list of the values
// that each axis takes, and for every vertex and axis a place in the list. Most places need no number: the
// value is that of a neighbour, or what came last in the same surroundings, or where a parallelogram ends.
//
// Values are coordinates on the grid or, in a bit-exact model, the floats themselves, from which the grid
// points follow. All three lists come from one list of magnitudes, each with the signs that it has on each
// axis: axes share values, and opposite halves do.
//
// Doubles, one operation at a time: both sides find the same. Mirrors: server/encode/list_encoder.cpp,
// client/decode/list_decoder.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/codec/codec_tables.h"
#include "common/codec/fan_walk.h"

namespace selvage {

/// Of one magnitude: on each axis 1 if the value is there, plus 2 if its negative is.
using AxisSigns = std::array<std::uint8_t, 3>;

/// Finds the models of signs, magnitude by magnitude.
class SignContext {
 public:
  /// The model of the signs on `axis`, given those on the axes before it.
  unsigned model(const AxisSigns& signs, unsigned axis) const;
  void add(const AxisSigns& signs);

 private:
  unsigned first_axis_ = 0;  ///< of the magnitude before, plus 1
};

/// By axis, ascending; -0 comes before 0.
using ValueLists = std::array<std::vector<double>, 3>;
/// `magnitudes` ascending; one set of signs for each.
ValueLists make_lists(std::span<const double> magnitudes, std::span<const AxisSigns> signs);

/// A place in an axis's list, vertex by vertex in the order of a FanWalk. What is coded of a place: which of
/// the candidates it is or, as kNoCandidate, the distance from `expected` as number(step_model) of fold_sign,
/// less 1.
class PlaceWalk {
 public:
  static constexpr unsigned kNoCandidate = 15;

  /// Known surroundings of one axis, in their own order of keys and models.
  enum class Shape : unsigned { Parallelogram, SeveralNeighbours, OneNeighbour };

  /// What is known before any candidate is looked for: most places are the first one.
  struct Around {
    unsigned axis;
    Shape shape;
    std::uint32_t a, b, o;  ///< of a parallelogram or of neighbours; 0 where there is none
    std::uint64_t key;
    std::uint32_t remembered;  ///< what came last in such surroundings, or kNone
    unsigned model, step_model;
  };

  /// All different.
  struct Candidates {
    unsigned count = 0;
    std::array<std::uint32_t, kNoCandidate> places;
  };

  /// Borrows `lists`, none of which is empty.
  PlaceWalk(const ValueLists& lists, std::uint32_t vertices);

  /// For a vertex with a known neighbour. The axes before must have been placed.
  Around look_around(const Fan& fan, unsigned axis) const;
  /// The first `most` candidates, or all if there are fewer.
  Candidates candidates(const Fan& fan, const Around& around, unsigned most) const;
  /// Where parallelograms end, or a neighbour's place.
  std::uint32_t expected(const Fan& fan, const Around& around) const;
  void place(const Around& around, std::uint32_t place);
  /// A vertex without known neighbours.
  void place_first(unsigned axis, std::uint32_t place) { places_[count_][axis] = place; }
  /// After all three axes.
  void finish_vertex() { ++count_; }

 private:
  /// What came last in some surroundings.
  struct Memory {
    std::uint32_t check = 0;
    std::uint32_t place = kNone;
  };

  std::uint32_t place_of(VertexId v, unsigned axis) const { return places_[v][axis]; }
  std::uint32_t nearest(unsigned axis, double value) const;
  Memory& memory_of(std::uint64_t key) { return memory_[key >> memory_shift_]; }
  const Memory& memory_of(std::uint64_t key) const { return memory_[key >> memory_shift_]; }

  const ValueLists& lists_;
  std::vector<std::array<std::uint32_t, 3>> places_;  ///< by vertex
  VertexId count_ = 0;
  int memory_shift_;
  std::vector<Memory> memory_;  ///< by the top bits of a key; newer entries overwrite older ones
};

}  // namespace selvage
