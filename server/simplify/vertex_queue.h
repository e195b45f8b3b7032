// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "common/base/ids.h"

namespace selvage {

/// Vertices by key, lowest first, ties by number: an indexed heap with four children a node, one entry a
/// vertex, so that a key changes in place. The order of removals does not depend on that of insertions. Keys
/// lie in the heap, where comparisons find them: kept by vertex, simplifying igea took a tenth longer.
class VertexQueue {
 public:
  explicit VertexQueue(std::uint32_t vertex_count) : place_(vertex_count, kNone) {}

  bool is_empty() const { return heap_.empty(); }
  bool contains(VertexId v) const { return place_[v] != kNone; }
  VertexId top() const { return heap_.front().vertex; }
  /// Needs contains(v).
  double key(VertexId v) const { return heap_[place_[v]].key; }

  /// Inserts `v`, or changes its key.
  void set(VertexId v, double key) {
    if (!contains(v)) {
      place_[v] = static_cast<std::uint32_t>(heap_.size());
      heap_.emplace_back();
    }
    settle(place_[v], {key, v});
  }

  /// Needs contains(v).
  void remove(VertexId v) {
    const std::uint32_t hole = place_[v];
    place_[v] = kNone;
    const Entry last = heap_.back();
    heap_.pop_back();
    if (last.vertex != v) settle(hole, last);
  }

 private:
  struct Entry {
    double key = 0;
    VertexId vertex = kNone;
    friend bool operator<(const Entry& a, const Entry& b) {
      return a.key != b.key ? a.key < b.key : a.vertex < b.vertex;
    }
  };

  void put(std::uint32_t place, const Entry& entry) { heap_[place] = entry, place_[entry.vertex] = place; }

  /// Puts the entry where it belongs, on the way from the hole at `place` to the root or down.
  void settle(std::uint32_t place, const Entry& entry) {
    for (; place > 0 && entry < heap_[(place - 1) / 4]; place = (place - 1) / 4)
      put(place, heap_[(place - 1) / 4]);
    const auto size = static_cast<std::uint32_t>(heap_.size());
    for (std::uint32_t child = 4 * place + 1; child < size; child = 4 * place + 1) {
      std::uint32_t least = child;
      for (std::uint32_t other = child + 1; other < std::min(child + 4, size); ++other) {
        if (heap_[other] < heap_[least]) least = other;
      }
      if (!(heap_[least] < entry)) break;
      put(place, heap_[least]);
      place = least;
    }
    put(place, entry);
  }

  std::vector<Entry> heap_;
  std::vector<std::uint32_t> place_;  // by vertex: index in heap_
};

}  // namespace selvage
