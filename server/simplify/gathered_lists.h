// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "common/base/ids.h"

namespace selvage {

/// A list a vertex, that of a vertex which is collapsed going to the vertex that it is collapsed to, in no
/// time. Lists of all vertices share two arrays.
template <class Item>
class GatheredLists {
 public:
  /// No vertices, no memory.
  GatheredLists() = default;
  explicit GatheredLists(std::uint32_t vertex_count)
      : first_of_vertex_(vertex_count, kNone), last_of_vertex_(vertex_count, kNone) {}

  bool is_empty() const { return first_of_vertex_.empty(); }

  void add(VertexId v, Item item) {
    const auto entry = static_cast<std::uint32_t>(items_.size());
    items_.push_back(std::move(item));
    next_.push_back(first_of_vertex_[v]);
    if (first_of_vertex_[v] == kNone) last_of_vertex_[v] = entry;
    first_of_vertex_[v] = entry;
  }

  /// v takes over u's list, which comes behind its own.
  void collapse(VertexId u, VertexId v) {
    if (first_of_vertex_[u] == kNone) return;
    if (first_of_vertex_[v] == kNone) {
      first_of_vertex_[v] = first_of_vertex_[u];
    } else {
      next_[last_of_vertex_[v]] = first_of_vertex_[u];
    }
    last_of_vertex_[v] = last_of_vertex_[u];
    first_of_vertex_[u] = last_of_vertex_[u] = kNone;
  }

  /// Calls visit(item) along v's list while it returns true; gives whether it always did.
  template <class Visit>
  bool all_of(VertexId v, Visit visit) const {
    for (std::uint32_t at = first_of_vertex_[v]; at != kNone; at = next_[at]) {
      if (!visit(items_[at])) return false;
    }
    return true;
  }

 private:
  std::vector<std::uint32_t> first_of_vertex_, last_of_vertex_, next_;
  std::vector<Item> items_;
};

}  // namespace selvage
