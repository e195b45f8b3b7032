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
// A walk starts at the lowest edge of the own region's loops whose triangle is in this bundle and not yet
// known.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "common/base/ids.h"
#include "common/codec/codec_tables.h"

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
  std::uint32_t total_vertices() const { return base_.back(); }
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
inline constexpr unsigned kJoinSymbols = 4;

/// How a strip ran up to a gate: the lengths of its last advances along one side, the latest first, as far as
/// they matter. Empty after a start and after a tip in full.
struct JoinRuns {
  JoinSymbol side = JoinSymbol::None;  ///< along which the strip advanced last; None if empty
  std::array<std::uint8_t, 3> lengths{};

  JoinRuns then(JoinSymbol symbol) const;
};
inline constexpr std::array<std::uint8_t, 3> kLongestRuns = {4, 3, 2};  ///< longer ones count as these

/// An edge of a triangle already coded, whose other side is not yet known.
struct JoinGate {
  std::uint32_t x = 0, y = 0;
  JoinRuns runs;
};

/// What encoder and decoder know of a bundle while it grows: the gates still to be asked about, the loop
/// edges that have their triangle, and where each region was touched last. Both feed it the same triangles,
/// so it decides alike.
class JoinProgress {
 public:
  explicit JoinProgress(const BundleTopology& topology);

  /// The corners of a triangle that a start names: edges between regions become gates.
  void add_start(const std::array<std::uint32_t, 3>& corners);
  /// The triangle (from.y, from.x, z) entered through `from`, whose edge on that gate is settled.
  void add_behind(const JoinGate& from, std::uint32_t z, JoinSymbol symbol);

  /// The next gate to ask about, false if none waits.
  bool pop(JoinGate& gate);

  /// The model of the symbol behind a gate: by the way the strip ran so far, whether the two loop edges that
  /// it could advance along are still free, and which end of the gate is in the bundle's own region.
  unsigned model_of(const JoinGate& gate) const;

  /// True if the loop edge from `vertex` to the one after it has its boundary triangle.
  bool is_covered(std::uint32_t vertex) const { return is_covered_[vertex]; }

  /// The vertex of a slot that came up last, kNone before the first.
  std::uint32_t last_touched(std::uint32_t slot) const { return last_touched_[slot]; }

 private:
  void add_triangle(const std::array<std::uint32_t, 3>& corners);
  void add_gate(std::uint32_t tail, std::uint32_t head, const JoinRuns& runs);

  const BundleTopology& topology_;
  std::vector<JoinGate> stack_;
  std::unordered_map<std::uint64_t, std::uint32_t> open_;  ///< directed edge -> how many gates wait on it
  std::vector<bool> is_covered_;                           ///< by vertex: its loop edge on
  std::vector<std::uint32_t> last_touched_;                ///< by slot
};

/// How a start names its triangle.
enum class JoinStart : std::uint8_t {
  OwnEdge,  ///< by the own region's loop edge, counted from the start before, and the tip in another region
  Corners,  ///< by its three corners
};

/// How far apart two vertices of one region are in the numbering of its `count` boundary vertices, around the
/// end if that is shorter; even numbers go up. circular_step is its inverse.
std::uint32_t circular_gap(std::uint32_t from, std::uint32_t to, std::uint32_t count);
std::uint32_t circular_step(std::uint32_t from, std::uint32_t gap, std::uint32_t base, std::uint32_t count);

}  // namespace selvage
