// SPDX-License-Identifier: MIT
//
// Joins: the boundary triangles between regions, which carry connectivity only (dissertation Ch. 5.2). The
// bundle of region r holds every boundary triangle whose highest region is r. A bundle decodes from the loop
// lengths of the regions it touches, which the directory states: never from positions, levels or other parts.
//
// The walk is the dissertation's LERS traversal turned around: all vertices are known, so instead of naming
// the tip of each triangle it is enough to say along which of the gate's two loops the strip advances.
//
//       region of x             A boundary triangle lies outside both loops, and a loop runs with its region
//       on the
//    <--- before(x) <-- x ---   left. Behind the gate x -> y the next triangle is (y, x, z), where z is
//                       |         before(x)  symbol AdvanceX
//                  gate |         after(y)   symbol AdvanceY
//                       v         any other  symbol Other, and z in full (junctions, irregular spots)
//    ---> after(y) <--- y ---     none       symbol None: the strip ends here or goes on in another bundle
//       region of y
//
// Strips between two regions never branch; a junction triangle has two gates on, so gates wait on a stack.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "common/base/ids.h"
#include "common/coding/adaptive_model.h"

namespace selvage {

/// Names a boundary vertex without coordinates.
struct BoundaryRef {
  RegionId region = 0;
  std::uint32_t index = 0;  ///< boundary index: loops in canonical order, one after another
  friend auto operator<=>(const BoundaryRef&, const BoundaryRef&) = default;
};

struct BoundaryTriangle {
  std::array<BoundaryRef, 3> corners;  ///< counter-clockwise in the oriented mesh
  bool is_turned = false;              ///< the file had it the other way round
  friend bool operator==(const BoundaryTriangle&, const BoundaryTriangle&) = default;
};

/// The regions of one bundle and their loops. Vertices are numbered through: `base` of the region's slot +
/// index.
class BundleTopology {
 public:
  struct Region {
    RegionId id;
    std::span<const std::uint32_t> loop_lengths;  ///< borrowed
  };
  /// `regions` ascending; the bundle's own region is the last.
  explicit BundleTopology(std::vector<Region> regions);

  std::uint32_t slot_count() const { return static_cast<std::uint32_t>(regions_.size()); }
  std::uint32_t own_slot() const { return slot_count() - 1; }
  std::uint32_t vertex_count(std::uint32_t slot) const { return base_[slot + 1] - base_[slot]; }
  std::uint32_t vertex(std::uint32_t slot, std::uint32_t index) const { return base_[slot] + index; }
  std::uint32_t slot_of(std::uint32_t vertex) const;
  std::uint32_t slot_of_region(RegionId id) const;  ///< kNone if the bundle does not touch it
  BoundaryRef ref(std::uint32_t vertex) const;

  /// Neighbours on the vertex's own loop, in the loop's direction and against it.
  std::uint32_t after(std::uint32_t vertex) const;
  std::uint32_t before(std::uint32_t vertex) const;

 private:
  struct Loop {
    std::uint32_t begin, length;
  };
  Loop loop_of(std::uint32_t vertex) const;

  std::vector<Region> regions_;
  std::vector<std::uint32_t> base_;        ///< by slot, and the total
  std::vector<std::uint32_t> loop_begin_;  ///< all loops of all slots, ascending, and the total
};

enum class JoinSymbol : std::uint8_t { AdvanceX, AdvanceY, None, Other };
inline constexpr int kJoinSymbols = 4;

/// An edge of a triangle already coded, whose other side is not yet known.
struct JoinGate {
  std::uint32_t x = 0, y = 0;
  std::uint8_t history = 0;  ///< the last two symbols on the way here
};

/// The gates still to be asked about. Encoder and decoder feed it the same triangles, so it decides alike on
/// both.
class JoinGates {
 public:
  explicit JoinGates(const BundleTopology& topology) : topology_(topology) {}

  /// The edges of a new triangle: one that meets a waiting gate closes it, others wait. Edges within one
  /// region are not gates: a region triangle lies behind them, or nothing that a strip would reach.
  void add_triangle(const std::array<std::uint32_t, 3>& corners, std::uint8_t history);
  /// The triangle entered through `from`: like add_triangle, but its edge on that gate is settled.
  void add_behind(const JoinGate& from, std::uint32_t z, JoinSymbol symbol);

  /// The next gate to ask about, false if none waits.
  bool pop(JoinGate& gate);

 private:
  void add_edge(std::uint32_t tail, std::uint32_t head, std::uint8_t history);

  const BundleTopology& topology_;
  std::vector<JoinGate> stack_;
  std::unordered_map<std::uint64_t, std::uint32_t> open_;  ///< directed edge -> how many gates wait on it
};

/// Models of a bundle's stream.
struct JoinModels {
  std::array<AdaptiveModel<kJoinSymbols>, 32> symbol;
  AdaptiveModel<kJoinSymbols> start;
  AdaptiveModel<33> slot;
  AdaptiveModel<2> has_turned, turned[2];

  /// By the way the strip ran so far, and whether the bundle's own region is at the gate.
  AdaptiveModel<kJoinSymbols>& at(const BundleTopology& topology, const JoinGate& gate);
};

/// Bits that an index below `count` takes uncoded.
int index_bits(std::uint32_t count);

}  // namespace selvage
