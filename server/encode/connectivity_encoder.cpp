// SPDX-License-Identifier: MIT
#include "server/encode/connectivity_encoder.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <unordered_map>

#include "common/codec/clers.h"
#include "common/codec/region_format.h"
#include "common/mesh/boundary_loops.h"

namespace selvage {
namespace {

/// The component of every triangle, numbered by first triangle.
std::vector<std::uint32_t> find_components(const CornerTable& table) {
  std::vector<std::uint32_t> component_of_triangle(table.triangle_count(), kNone);
  std::vector<TriangleId> stack;
  std::uint32_t components = 0;
  for (TriangleId seed = 0; seed < table.triangle_count(); ++seed) {
    if (component_of_triangle[seed] != kNone) continue;
    component_of_triangle[seed] = components;
    stack.push_back(seed);
    while (!stack.empty()) {
      const TriangleId t = stack.back();
      stack.pop_back();
      for (CornerId c = 3 * t; c < 3 * t + 3; ++c) {
        const CornerId across = table.opposite[c];
        if (across == kNone || component_of_triangle[triangle_of(across)] != kNone) continue;
        component_of_triangle[triangle_of(across)] = components;
        stack.push_back(triangle_of(across));
      }
    }
    ++components;
  }
  return component_of_triangle;
}

/// The table with every loop but each component's longest closed by a fan around a virtual vertex.
struct ClosedTable {
  CornerTable table;
  std::uint32_t real_vertices = 0;  ///< virtual ones follow
};

void close_loop(CornerTable& table, std::span<const VertexId> loop) {
  const VertexId hub = table.vertex_count();
  const CornerId first = table.corner_count();
  const auto size = static_cast<std::uint32_t>(loop.size());
  for (std::uint32_t i = 0; i < size; ++i) {
    // The region lies left of v -> w, so the virtual triangle (hub, w, v) runs the edge the other way.
    const VertexId v = loop[i], w = loop[(i + 1) % size];
    const CornerId inner = prev(table.corner_of_vertex[v]);
    table.vertex_of_corner.insert(table.vertex_of_corner.end(), {hub, w, v});
    table.opposite.insert(table.opposite.end(),
                          {inner, first + 3 * ((i + size - 1) % size) + 2, first + 3 * ((i + 1) % size) + 1});
    table.opposite[inner] = first + 3 * i;
  }
  table.corner_of_vertex.push_back(first);
}

ClosedTable close_inner_loops(const CornerTable& table,
                              const std::vector<std::uint32_t>& component_of_triangle) {
  ClosedTable closed{table, table.vertex_count()};
  const BoundaryLoops loops = find_boundary_loops(table);
  struct Loop {
    std::uint32_t begin, length, component;
  };
  std::vector<Loop> all;
  std::unordered_map<std::uint32_t, std::size_t> longest_of_component;
  for (std::uint32_t begin = 0; std::uint32_t length : loops.lengths) {
    const std::uint32_t component =
        component_of_triangle[triangle_of(table.corner_of_vertex[loops.vertices[begin]])];
    const auto [longest, is_first] = longest_of_component.try_emplace(component, all.size());
    if (!is_first && length > all[longest->second].length) longest->second = all.size();
    all.push_back({begin, length, component});
    begin += length;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (longest_of_component[all[i].component] == i) continue;
    close_loop(closed.table, std::span(loops.vertices).subspan(all[i].begin, all[i].length));
  }
  return closed;
}

/// Conquers one component after another; symbols, tips and splits in the order of the conquest.
class Conquest {
 public:
  explicit Conquest(const CornerTable& table)
      : table_(table),
        order_of_triangle_(table.triangle_count(), kNone),
        is_visited_(table.vertex_count(), false) {
    mark_border_vertices();
    for (TriangleId t = 0; t < table.triangle_count(); ++t) {
      if (order_of_triangle_[t] == kNone) conquer_component(t);
    }
  }

  std::vector<Clers> symbols;
  std::vector<CornerId> tips;  ///< the tip corner of each symbol's triangle
  std::vector<CornerId>
      closing_tips;  ///< by component: the start triangle's corner that faces the gate, or kNone
  std::vector<HandleSplit> splits;  ///< in conquest order: `split` comes before `source` here

 private:
  static constexpr std::uint32_t kStartTriangle = kNone - 1;

  void mark_border_vertices() {
    for (CornerId c = 0; c < table_.corner_count(); ++c) {
      if (table_.opposite[c] != kNone) continue;
      is_visited_[table_.vertex(next(c))] = true;
      is_visited_[table_.vertex(prev(c))] = true;
    }
  }

  /// The tip of the first triangle of a component: behind its border if it has one, else next to a triangle
  /// that counts as conquered.
  CornerId enter(TriangleId any) {
    component_.assign(1, any);
    in_component_.resize(table_.triangle_count(), false);
    in_component_[any] = true;
    for (std::size_t i = 0; i < component_.size(); ++i) {
      for (CornerId c = 3 * component_[i]; c < 3 * component_[i] + 3; ++c) {
        const CornerId across = table_.opposite[c];
        if (across == kNone) {
          closing_tips.push_back(kNone);
          return c;
        }
        if (in_component_[triangle_of(across)]) continue;
        in_component_[triangle_of(across)] = true;
        component_.push_back(triangle_of(across));
      }
    }
    order_of_triangle_[any] = kStartTriangle;
    for (VertexId v : table_.triangle(any)) is_visited_[v] = true;
    closing_tips.push_back(3 * any);
    return table_.opposite[3 * any];
  }

  bool is_conquered(CornerId c) const { return c == kNone || order_of_triangle_[triangle_of(c)] != kNone; }

  void conquer_component(TriangleId any) {
    std::vector<CornerId> open_left;
    CornerId tip = enter(any);
    while (true) {
      order_of_triangle_[triangle_of(tip)] = static_cast<std::uint32_t>(symbols.size());
      const CornerId right = table_.opposite[next(tip)], left = table_.opposite[prev(tip)];
      const VertexId v = table_.vertex(tip);
      tips.push_back(tip);
      if (!is_visited_[v]) {
        is_visited_[v] = true;
        symbols.push_back(Clers::C);
        tip = right;
        continue;
      }
      const bool right_done = is_conquered(right), left_done = is_conquered(left);
      if (right_done) note_handle(right, false);
      if (left_done) note_handle(left, true);
      symbols.push_back(right_done ? (left_done ? Clers::E : Clers::R) : (left_done ? Clers::L : Clers::S));
      if (symbols.back() == Clers::S) {
        open_left.push_back(left);
        pending_split_.emplace(prev(tip), order_of_triangle_[triangle_of(tip)]);
      }
      if (symbols.back() == Clers::E) {
        while (!open_left.empty() && is_conquered(open_left.back())) open_left.pop_back();
        if (open_left.empty()) return;
        tip = open_left.back();
        open_left.pop_back();
        pending_split_.erase(table_.opposite[tip]);
      } else {
        tip = right_done ? left : right;
      }
    }
  }

  /// If the conquered neighbour is an S whose left branch still waits, that branch has just been met from its
  /// other end: a handle. `across` is the neighbour's corner facing the shared edge.
  void note_handle(CornerId across, bool is_left) {
    if (across == kNone) return;
    const auto pending = pending_split_.find(across);
    if (pending == pending_split_.end()) return;
    splits.push_back({pending->second, static_cast<std::uint32_t>(symbols.size()), is_left});
    pending_split_.erase(pending);
  }

  const CornerTable& table_;
  std::vector<std::uint32_t> order_of_triangle_;
  std::vector<bool> is_visited_;
  std::vector<bool> in_component_;
  std::vector<TriangleId> component_;
  std::unordered_map<CornerId, std::uint32_t>
      pending_split_;  ///< an S's corner facing its left edge -> its symbol
};

/// The conquest in decoding order: last symbol first.
std::vector<HandleSplit> reversed(const std::vector<HandleSplit>& splits, std::uint32_t symbols) {
  std::vector<HandleSplit> result;
  for (const HandleSplit& s : splits)
    result.push_back({symbols - 1 - s.split, symbols - 1 - s.source, s.is_left});
  std::sort(result.begin(), result.end(),
            [](const HandleSplit& a, const HandleSplit& b) { return a.split < b.split; });
  return result;
}

void encode_splits(EntropyEncoder& out, const std::vector<HandleSplit>& splits) {
  out.number(region_model::kHandleCount, static_cast<std::uint32_t>(splits.size()));
  for (std::uint32_t before = 0; const HandleSplit& s : splits) {
    out.number(region_model::kHandleGap, s.split - before);
    out.number(region_model::kHandleReach, s.split - s.source - 1);
    out.bits(s.is_left, 1);
    before = s.split;
  }
}

}  // namespace

EncodedConnectivity encode_connectivity(const CornerTable& table, EntropyEncoder& out) {
  const ClosedTable closed = close_inner_loops(table, find_components(table));
  const Conquest conquest(closed.table);
  const auto symbols = static_cast<std::uint32_t>(conquest.symbols.size());

  // In step with decode_connectivity.
  out.number(region_model::kExtraSymbols,
             fold_sign(static_cast<std::int32_t>(symbols - table.triangle_count())));
  const std::vector<HandleSplit> splits = reversed(conquest.splits, symbols);
  encode_splits(out, splits);
  EncodedConnectivity encoded;
  FanTable& grown = encoded.table;
  ClersGrower grower(splits, symbols, grown);
  std::vector<CornerId> tip_of_grown(conquest.tips.rbegin(), conquest.tips.rend());
  for (auto symbol = conquest.symbols.rbegin(); symbol != conquest.symbols.rend(); ++symbol) {
    out.symbol(region_model::kClers + grower.context(), static_cast<unsigned>(*symbol));
    [[maybe_unused]] const bool fits = grower.grow(*symbol);
    assert(fits);
  }
  // Components end up on the gate stack in decoding order, that is last first.
  const std::uint32_t components = grower.finish();
  for (std::uint32_t gate = 0; gate < components; ++gate) {
    const CornerId closing = conquest.closing_tips[conquest.closing_tips.size() - 1 - gate];
    out.symbol(region_model::kIsClosed, closing != kNone);
    if (closing == kNone) continue;
    [[maybe_unused]] const bool closes = grower.close(gate);
    assert(closes);
    tip_of_grown.push_back(closing);
  }

  std::vector<VertexId> virtual_vertices;
  for (TriangleId t = 0; t < grown.triangle_count(); ++t) {
    const CornerId source[] = {tip_of_grown[t], next(tip_of_grown[t]), prev(tip_of_grown[t])};
    for (CornerId k = 0; k < 3; ++k) {
      if (closed.table.vertex(source[k]) >= closed.real_vertices)
        virtual_vertices.push_back(grown.vertex(8 * t + k));
    }
  }
  std::sort(virtual_vertices.begin(), virtual_vertices.end());
  virtual_vertices.erase(std::unique(virtual_vertices.begin(), virtual_vertices.end()),
                         virtual_vertices.end());
  out.number(region_model::kVirtualCount, static_cast<std::uint32_t>(virtual_vertices.size()));
  for (VertexId before = 0; VertexId v : virtual_vertices) {
    out.number(region_model::kVirtualGap, v - before);
    before = v;
  }

  const auto grown_of_triangle = drop_virtual_fans(grown, virtual_vertices);
  assert(grown_of_triangle);
  encoded.source_of_corner.reserve(3 * std::size_t{grown.triangle_count()});
  for (TriangleId t = 0; t < grown.triangle_count(); ++t) {
    const CornerId tip = tip_of_grown[grown_of_triangle->empty() ? t : (*grown_of_triangle)[t]];
    encoded.source_of_corner.insert(encoded.source_of_corner.end(), {tip, next(tip), prev(tip)});
  }
  return encoded;
}

}  // namespace selvage
