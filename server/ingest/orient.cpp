// SPDX-License-Identifier: MIT
#include "server/ingest/orient.h"

#include "common/mesh/corner_table.h"
#include "server/ingest/adjacency.h"

namespace selvage {
namespace {

/// Grows one edge-connected piece at a time. A patch, the triangles that are connected and oriented alike in
/// the file, is taken whole before the next one is entered across an edge where the file flips. Conflicts
/// can therefore only remain at such edges, which plain breadth-first search does not give: its fronts meet
/// anywhere, so on a non-orientable mesh it cuts along new lines and turns half of the triangles.
class PieceGrower {
 public:
  PieceGrower(std::span<const Triangle> triangles, std::span<const CornerId> across)
      : triangles_(triangles), across_(across), is_reached_(triangles.size()), is_turned_(triangles.size()) {}

  void orient_piece_of(TriangleId seed) {
    if (is_reached_[seed]) return;
    piece_.clear();
    flips_.clear();
    next_in_piece_ = 0;
    reach(seed, false);
    grow_patch();
    for (std::size_t i = 0; i < flips_.size(); ++i) {
      const CornerId inside = flips_[i], beyond = across_[inside];
      if (is_reached_[triangle_of(beyond)]) continue;
      reach(triangle_of(beyond), !is_turned_[triangle_of(inside)]);
      grow_patch();
    }
    prefer_fewer_turned();
  }

  std::vector<bool> take_is_turned() { return std::move(is_turned_); }

 private:
  void reach(TriangleId triangle, bool is_turned) {
    is_reached_[triangle] = true;
    is_turned_[triangle] = is_turned;
    piece_.push_back(triangle);
  }

  void grow_patch() {
    for (; next_in_piece_ < piece_.size(); ++next_in_piece_) {
      const TriangleId triangle = piece_[next_in_piece_];
      for (CornerId c = 3 * triangle; c < 3 * triangle + 3; ++c) {
        const CornerId beyond = across_[c];
        if (beyond == kNone || is_reached_[triangle_of(beyond)]) continue;
        if (runs_oppositely(triangles_, c, beyond)) {
          reach(triangle_of(beyond), is_turned_[triangle]);
        } else {
          flips_.push_back(c);
        }
      }
    }
  }

  void prefer_fewer_turned() {
    std::size_t turned = 0;
    for (TriangleId t : piece_) turned += is_turned_[t];
    if (2 * turned <= piece_.size()) return;
    for (TriangleId t : piece_) is_turned_[t] = !is_turned_[t];
  }

  std::span<const Triangle> triangles_;
  std::span<const CornerId> across_;
  std::vector<bool> is_reached_, is_turned_;
  std::vector<TriangleId> piece_;  // also the queue: those from next_in_piece_ on wait for their neighbours
  std::size_t next_in_piece_ = 0;
  std::vector<CornerId> flips_;  // sides of the piece across which the file turns around
};

/// True of most files, and much cheaper to see than to establish.
bool is_oriented(std::span<const Triangle> triangles, std::span<const CornerId> across) {
  for (CornerId c = 0; c < across.size(); ++c) {
    const CornerId beyond = across[c];
    if (beyond != kNone && c < beyond && !runs_oppositely(triangles, c, beyond)) return false;
  }
  return true;
}

std::uint32_t cut_conflicts(std::span<const Triangle> triangles, const std::vector<bool>& is_turned,
                            std::span<CornerId> across) {
  std::uint32_t cut_edges = 0;
  for (CornerId c = 0; c < across.size(); ++c) {
    const CornerId beyond = across[c];
    if (beyond == kNone || beyond < c) continue;
    const bool is_turned_alike = is_turned[triangle_of(c)] == is_turned[triangle_of(beyond)];
    if (runs_oppositely(triangles, c, beyond) == is_turned_alike) continue;
    across[c] = across[beyond] = kNone;
    ++cut_edges;
  }
  return cut_edges;
}

}  // namespace

Orientation orient(std::span<const Triangle> triangles, std::span<CornerId> across) {
  Orientation orientation;
  if (is_oriented(triangles, across)) {
    orientation.is_turned.resize(triangles.size());
    return orientation;
  }
  PieceGrower grower(triangles, across);
  for (TriangleId t = 0; t < triangles.size(); ++t) grower.orient_piece_of(t);
  orientation.is_turned = grower.take_is_turned();
  for (bool is_turned : orientation.is_turned) orientation.turned_triangles += is_turned;
  orientation.cut_edges = cut_conflicts(triangles, orientation.is_turned, across);
  return orientation;
}

}  // namespace selvage
