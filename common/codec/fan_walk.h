// SPDX-License-Identifier: MIT
//
// The order in which vertices are coded. A vertex that two known triangles predict comes before one that a
// single triangle predicts, and that before a new start. The order follows from connectivity alone; so
// vertices are visited some way ahead of their positions.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "common/codec/fan_table.h"
#include "common/codec/lanes.h"
#include "common/codec/scratch.h"
#include "common/mesh/boundary_loops.h"

namespace selvage {

/// A vertex whose turn has come, and what around it comes before. Numbers are those of the new order.
struct Fan {
  static constexpr unsigned kMost = 62;  ///< neighbours, and parallelograms

  VertexId old_number;
  unsigned triangles;
  bool is_border;
  unsigned neighbours, parallelograms;  ///< known ones
  std::array<VertexId, kMost> neighbour;
  /// Of a triangle around the vertex its two other vertices, and the one across from them.
  struct Parallelogram {
    VertexId begin, end, across;
  };
  std::array<Parallelogram, kMost> parallelogram;
};

class FanWalk {
 public:
  /// What a walk needs room for, kept between walks.
  struct Memory {
    Scratch<std::uint32_t> states;
    Scratch<FanCorner> well, once;
  };

  /// Ends after `most_vertices` at the latest. Borrows `table` and `memory`.
  FanWalk(const FanTable& table, std::uint32_t most_vertices, Memory& memory);
  FanWalk(const FanWalk&) = delete;

  // A visit is three steps, so that a decoder may put each where it would wait for something else.

  /// Goes to the next vertex and turns around it; false after the last.
  bool turn();
  /// Puts neighbours into the queues.
  void offer();
  /// Numbers the vertex, and says what is known around it.
  void gather(Fan& fan);

  /// Vertices visited so far.
  std::uint32_t count() const { return count_; }
  /// True if no corner of the table is left.
  bool is_complete() const { return corners_left_ == 0; }

  // Once the walk is complete, with vertices numbered by visit:

  std::vector<Triangle> triangles() const;
  /// Takes the room of a queue.
  BoundaryLoops boundary_loops();

 private:
  /// The triangles around a vertex counter-clockwise: each one's corner at the neighbour that it begins with,
  /// and that neighbour's state; in an open fan the last neighbour as well. The first one's place is kFirst,
  /// every next one's a lower one. Sets of them are bits by place; so the neighbour that a triangle ends with
  /// is the next lower bit. Below the last neighbour of a closed fan lies the first one's state again. Fans
  /// beyond kMost triangles are cut short.
  struct Ring {
    static constexpr unsigned kMost = Fan::kMost, kFirst = 63;
    unsigned triangles = 0;
    unsigned neighbours = 0;
    bool is_border = false;
    std::uint64_t known = 0;  ///< of the neighbours
    /// Triangles of whose other two vertices both are known, one is, none is.
    std::uint64_t both_known = 0, one_known = 0, none_known = 0;
    std::array<FanCorner, kFirst + 1> rims;
    std::array<std::uint32_t, kFirst + 1> states;

    static std::uint64_t first_ones(unsigned count) { return ~std::uint64_t{0} << (kFirst + 1 - count); }
    /// Fills the sets, triangles as bits of the neighbours they begin with.
    void set_unknown(std::uint64_t unknown, std::uint64_t all_neighbours, std::uint64_t all_triangles) {
      const std::uint64_t ending_unknown = unknown << 1 | unknown >> kFirst << (kFirst + 1 - neighbours);
      known = all_neighbours & ~unknown;
      both_known = all_triangles & ~(unknown | ending_unknown);
      one_known = all_triangles & (unknown ^ ending_unknown);
      none_known = all_triangles & unknown & ending_unknown;
    }
    static unsigned lowest(std::uint64_t set) { return static_cast<unsigned>(std::countr_zero(set)); }
    std::uint32_t begin(unsigned place) const { return states[place]; }
    std::uint32_t end(unsigned place) const { return states[place - 1]; }
  };

  /// A vertex's state is its new number or, above it, how many triangles predict it (kOffered, up to two)
  /// and, if its fan is known to be closed and has up to kSteps triangles, how many they are.
  static constexpr std::uint32_t kUnvisited = 1u << 31, kOffered = 1u << 29, kTriangles = kOffered - 1;
  static constexpr unsigned kSteps = 8;

  bool find_next();
  void turn_inside(unsigned triangles);
  void turn_slowly();
  void look_ahead() const;

  const FanTable& table_;
  Memory& memory_;
  std::uint32_t most_vertices_, count_ = 0;
  std::size_t corners_left_;
  std::uint32_t* states_;  ///< by old number
  /// Queues of corners, by how many triangles had offered them before; what has been offered twice goes
  /// nowhere.
  enum { kOnceQueue, kWellQueue, kNowhere };
  FanCorner nowhere_;
  std::array<FanCorner*, 3> queue_end_;
  std::array<FanCorner*, 2> queue_next_;
  FanCorner next_seed_ = 0, current_ = kNone;
  Ring ring_;
  struct BorderVertex {
    VertexId number, next;  ///< `next` along the border, by old number
  };
  std::vector<BorderVertex> border_;  ///< ascending
};

// Called once a vertex, from one place that matters: saving registers would be a tenth of the work.
#define SELVAGE_ONE_CALLER [[gnu::always_inline]] inline

SELVAGE_ONE_CALLER bool FanWalk::find_next() {
  const auto is_unvisited = [&](FanCorner c) { return states_[table_.vertex(c)] >= kUnvisited; };
  const auto take_from = [&](unsigned queue) {
    while (queue_next_[queue] != queue_end_[queue]) {
      current_ = *queue_next_[queue]++;
      if (is_unvisited(current_)) return true;
    }
    return false;
  };
  if (take_from(kWellQueue) || take_from(kOnceQueue)) return true;
  const FanCorner end = 8 * table_.triangle_count();
  while (next_seed_ < end) {
    current_ = next_seed_;
    if (is_unvisited(current_)) return true;
    next_seed_ += next_seed_ % 8 == 2 ? 6 : 1;
  }
  return false;
}

SELVAGE_ONE_CALLER bool FanWalk::turn() {
  if (count_ == most_vertices_ || !find_next()) return false;
  const unsigned triangles = states_[table_.vertex(current_)] & kTriangles;
  if (triangles > 0) [[likely]] {
    turn_inside(triangles);
  } else {
    turn_slowly();
  }
  look_ahead();
  return true;
}

/// Without a branch on the number of triangles: a turn too far goes over the first ones again.
SELVAGE_ONE_CALLER void FanWalk::turn_inside(unsigned triangles) {
  static_assert(kSteps == 8);
  constexpr unsigned kLowest = Ring::kFirst + 1 - kSteps;
  FanCorner rim = next_on(current_);
  std::array<std::int32_t, kSteps> states;
  for (unsigned step = kSteps; step-- > 0;) {
    ring_.rims[kLowest + step] = rim;
    states[step] = static_cast<std::int32_t>(states_[table_.vertex(rim)]);
    rim = table_.turn(rim);
  }
  const IntLanes low{states[0], states[1], states[2], states[3]},
      high{states[4], states[5], states[6], states[7]};
  std::memcpy(&ring_.states[kLowest], &low, sizeof low);
  std::memcpy(&ring_.states[kLowest + 4], &high, sizeof high);
  const std::uint64_t all = Ring::first_ones(triangles), is_unknown = sign_bits(high) << 4 | sign_bits(low);
  ring_.states[Ring::kFirst - triangles] = static_cast<std::uint32_t>(states[kSteps - 1]);
  ring_.is_border = false;
  ring_.neighbours = ring_.triangles = triangles;
  ring_.set_unknown(is_unknown << kLowest & all, all, all);
  corners_left_ -= triangles;
}

/// Fetches the triangles across from two unknown neighbours: nothing has touched them before.
SELVAGE_ONE_CALLER void FanWalk::look_ahead() const {
  for (std::uint64_t left = ring_.none_known; left != 0; left &= left - 1) {
    const FanCorner turned = table_.turn_of_prev(ring_.rims[Ring::lowest(left)]);
    if (turned != kNone) table_.prefetch(turned);
  }
}

/// Triangles that now have two known vertices will predict their third.
SELVAGE_ONE_CALLER void FanWalk::offer() {
  for (std::uint64_t left = ring_.one_known; left != 0; left &= left - 1) {
    const unsigned place = Ring::lowest(left);
    // The neighbour that the triangle begins with, or the next one. Place 3 of a triangle will do.
    const FanCorner corner = ring_.rims[place] + (ring_.begin(place) < kUnvisited);
    std::uint32_t& state = states_[table_.vertex(corner)];
    const unsigned queue = (state - kUnvisited) / kOffered, counts = queue < kNowhere;
    *queue_end_[queue] = corner;
    queue_end_[queue] += counts;
    state += counts * kOffered;
  }
}

SELVAGE_ONE_CALLER void FanWalk::gather(Fan& fan) {
  unsigned m = 0;
  for (std::uint64_t left = ring_.known; left != 0; left &= left - 1)
    fan.neighbour[m++] = ring_.begin(Ring::lowest(left));
  Fan::Parallelogram* next = fan.parallelogram.data();
  for (std::uint64_t left = ring_.both_known; left != 0; left &= left - 1) {
    const unsigned place = Ring::lowest(left);
    const FanCorner turned = table_.turn_of_prev(ring_.rims[place]);
    if (turned == kNone) continue;
    const std::uint32_t across = states_[table_.next_vertex(turned)];
    *next = {ring_.begin(place), ring_.end(place), across};
    next += across < kUnvisited;
  }
  fan.neighbours = m;
  fan.parallelograms = static_cast<unsigned>(next - fan.parallelogram.data());
  fan.old_number = table_.vertex(current_);
  fan.triangles = ring_.triangles;
  fan.is_border = ring_.is_border;
  states_[fan.old_number] = count_++;
}

#undef SELVAGE_ONE_CALLER

}  // namespace selvage
