// SPDX-License-Identifier: MIT
#include "server/segment/dissolve.h"

#include "server/segment/one_ring.h"
#include "server/segment/pieces.h"

namespace selvage {
namespace {

/// The label that each piece goes on with, kNone if it dissolves.
std::vector<std::uint32_t> choose_labels(const Pieces& pieces, std::uint32_t& label_count,
                                         std::uint32_t min_piece_triangles) {
  std::vector<std::uint32_t> largest_of_label(label_count, kNone);
  for (std::uint32_t p = 0; p < pieces.count(); ++p) {
    std::uint32_t& largest = largest_of_label[pieces.label[p]];
    if (largest == kNone || pieces.triangle_count[p] > pieces.triangle_count[largest]) largest = p;
  }
  std::vector<std::uint32_t> label_of_piece(pieces.count(), kNone);
  for (std::uint32_t p = 0; p < pieces.count(); ++p) {
    if (largest_of_label[pieces.label[p]] == p) {
      label_of_piece[p] = pieces.label[p];
    } else if (pieces.triangle_count[p] >= min_piece_triangles) {
      label_of_piece[p] = label_count++;
    }
  }
  return label_of_piece;
}

/// The label of v's only fan of kept triangles, kNone if there is none or more than one fan.
std::uint32_t label_of_only_fan(const CornerTable& mesh, const Pieces& pieces,
                                const std::vector<std::uint32_t>& label_of_piece, VertexId v) {
  const auto kept_label = [&](CornerId c) {
    const std::uint32_t piece = pieces.of_triangle[triangle_of(c)];
    return piece == kNone ? kNone : label_of_piece[piece];
  };
  std::uint32_t label = kNone, fan_starts = 0;
  for_each_corner_at(mesh, v, [&](CornerId c) {
    if (kept_label(c) == kNone) return;
    label = kept_label(c);
    const CornerId before = mesh.swing_cw(c);
    fan_starts += before == kNone || kept_label(before) == kNone;
  });
  return fan_starts <= 1 ? label : kNone;  // no start at all: the whole closed fan is kept
}

/// Flags for the vertices of triangles that no piece keeps: elsewhere one piece surrounds a vertex.
std::vector<std::uint8_t> find_rim(const CornerTable& mesh, const Pieces& pieces,
                                   const std::vector<std::uint32_t>& label_of_piece) {
  std::vector<std::uint8_t> is_rim(mesh.vertex_count(), 0);
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    const std::uint32_t piece = pieces.of_triangle[t];
    if (piece != kNone && label_of_piece[piece] != kNone) continue;
    for (VertexId v : mesh.triangle(t)) is_rim[v] = 1;
  }
  return is_rim;
}

/// Counts votes for labels and forgets them in time proportional to the votes.
class Ballot {
 public:
  explicit Ballot(std::uint32_t label_count) : votes_(label_count, 0) {}
  void add(std::uint32_t label) {
    if (votes_[label]++ == 0) voted_.push_back(label);
  }
  /// The label with most votes, the lowest of equal ones, kNone without votes. Empties the ballot.
  std::uint32_t close() {
    std::uint32_t best = kNone, most = 0;
    for (std::uint32_t label : voted_) {
      if (votes_[label] > most || (votes_[label] == most && label < best)) best = label, most = votes_[label];
      votes_[label] = 0;
    }
    voted_.clear();
    return best;
  }

 private:
  std::vector<std::uint32_t> votes_;
  std::vector<std::uint32_t> voted_;
};

}  // namespace

bool dissolve_crumbs(const CornerTable& mesh, const Pieces& pieces, std::uint32_t min_piece_triangles,
                     std::vector<std::uint32_t>& label_of_vertex, std::uint32_t& label_count) {
  const std::vector<std::uint32_t> label_of_piece = choose_labels(pieces, label_count, min_piece_triangles);
  const std::vector<std::uint8_t> is_rim = find_rim(mesh, pieces, label_of_piece);
  bool has_changed = false;
  std::vector<VertexId> crumbs;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    const CornerId corner = mesh.corner_of_vertex[v];
    if (corner == kNone) continue;
    const std::uint32_t label = is_rim[v] ? label_of_only_fan(mesh, pieces, label_of_piece, v)
                                          : label_of_piece[pieces.of_triangle[triangle_of(corner)]];
    if (label == kNone) {
      crumbs.push_back(v);
    } else if (label != label_of_vertex[v]) {
      label_of_vertex[v] = label;
      has_changed = true;
    }
  }
  Ballot ballot(label_count);
  for (VertexId v : crumbs) {  // in place: what one crumb took counts for the next
    for_each_corner_at(mesh, v, [&](CornerId c) {
      const std::uint32_t label = label_of_vertex[mesh.vertex(next(c))];
      if (label != label_of_vertex[v] && label == label_of_vertex[mesh.vertex(prev(c))]) ballot.add(label);
    });
    const std::uint32_t label = ballot.close();
    if (label == kNone) continue;
    label_of_vertex[v] = label;
    has_changed = true;
  }
  return has_changed;
}

}  // namespace selvage
