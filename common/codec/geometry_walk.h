// SPDX-License-Identifier: MIT
//
// The order in which vertices are coded, and what is known around each when its turn comes. A vertex that two
// known triangles predict comes before one that a single triangle predicts, and that before a new start.
//
// One turn around a vertex does everything: numbers its corners, collects the known neighbours and
// parallelograms, and offers the neighbours that now have a triangle with two known vertices.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/codec/prediction.h"
#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"

namespace selvage {

class GeometryWalk {
 public:
  /// Vertices of `table` may have any numbers below its vertex_count(); its corner_of_vertex is not looked
  /// at, a vertex is a fan of corners. Ends after `most_vertices` at the latest. `extent` is the longest side
  /// of the region's box; coordinates are below 2^24.
  GeometryWalk(CornerTable table, std::uint32_t most_vertices, std::int32_t extent);

  /// Goes to the next vertex and looks around; false after the last. Every call must be followed by place()
  /// or place_first() before the next.
  bool next_vertex(Surroundings& around);
  /// The number that the current vertex had in the table.
  VertexId old_number() const { return old_number_; }
  /// Vertices placed so far.
  std::uint32_t count() const { return count_; }
  /// True if no corner of the table is left.
  bool is_complete() const { return corners_left_ == 0; }

  /// What the current vertex turned out to be. `tangential` and `normal` are the magnitudes of the coded
  /// residuals.
  void place(const Surroundings& around, IntLanes position, std::uint32_t tangential, std::uint32_t normal);
  /// A vertex without neighbours, which nothing predicts.
  void place_first(const GridPoint& position);

  /// Numbers of the vertices on the border, ascending.
  std::span<const VertexId> border_vertices() const { return border_; }
  std::vector<GridPoint> positions() const;
  /// The table with vertices numbered by visit. The walk is spent.
  CornerTable take_table();

 private:
  /// Sums over neighbours are sums of lanes.
  struct Known {
    IntLanes position;  ///< and the tangential residual
    FloatLanes error;   ///< against the mean parallelogram, and the normal residual
  };
  /// How many triangles predict a vertex that is not yet known; two stands for more.
  enum State : std::uint16_t { kUnseen, kOnce, kWell };
  struct Fan;

  bool find_next();
  void turn_around(Fan& fan);
  void offer_neighbours(const Fan& fan);
  void summarise(const Fan& fan, Surroundings& around) const;

  CornerTable table_;  ///< visited vertices already have their new numbers, the others kUnvisited added
  std::uint32_t most_vertices_, corners_left_;
  std::vector<State> states_;                ///< by old number
  std::unique_ptr<CornerId[]> well_, once_;  ///< queues of corners
  std::size_t next_well_ = 0, well_end_ = 0, next_once_ = 0, once_end_ = 0;
  CornerId next_seed_ = 0, current_ = kNone;
  VertexId old_number_ = kNone;
  std::vector<CornerId> corner_of_visited_;
  std::vector<VertexId> border_;
  std::unique_ptr<Known[]> known_;  ///< by new number
  VertexId count_ = 0;
  std::int32_t recent_tangential_, recent_normal_;  ///< running means of logarithms, in 32nds
};

inline void GeometryWalk::place(const Surroundings& around, IntLanes position, std::uint32_t tangential,
                                std::uint32_t normal) {
  // Beyond any grid; keeps sums of sixteen within 32 bits whatever a stream claims.
  constexpr std::uint32_t kMost = 1 << 24;
  Known& known = known_[count_++];
  FloatLanes error{};
  if (around.parallelograms > 0) error = to_float(position - around.base) - around.mean;
  error[3] = static_cast<float>(static_cast<std::int32_t>(std::min(normal, kMost)));
  position[3] = static_cast<std::int32_t>(std::min(tangential, kMost));
  known.position = position;
  known.error = error;
  recent_tangential_ += 2 * log_of_magnitude(tangential) - (recent_tangential_ >> 4);
  recent_normal_ += 2 * log_of_magnitude(normal) - (recent_normal_ >> 4);
}

}  // namespace selvage
