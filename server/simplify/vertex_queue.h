// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "common/base/ids.h"

namespace selvage {

/// Vertices by key, lowest first, ties by number: an indexed heap with four children a node, one entry a
/// vertex, so that a key changes in place. The order of removals does not depend on that of insertions.
class VertexQueue {
 public:
  explicit VertexQueue(std::uint32_t vertex_count) : key_(vertex_count, 0), place_(vertex_count, kNone) {}

  bool is_empty() const { return heap_.empty(); }
  bool contains(VertexId v) const { return place_[v] != kNone; }
  VertexId top() const { return heap_.front(); }
  double key(VertexId v) const { return key_[v]; }

  /// Inserts `v`, or changes its key.
  void set(VertexId v, double key) {
    key_[v] = key;
    if (!contains(v)) {
      heap_.push_back(v);
      place_[v] = static_cast<std::uint32_t>(heap_.size() - 1);
    }
    sink(raise(place_[v]));
  }

  /// Needs contains(v).
  void remove(VertexId v) {
    const std::uint32_t hole = place_[v];
    place_[v] = kNone;
    const VertexId last = heap_.back();
    heap_.pop_back();
    if (last == v) return;
    put(hole, last);
    sink(raise(hole));
  }

 private:
  bool is_before(VertexId a, VertexId b) const { return key_[a] != key_[b] ? key_[a] < key_[b] : a < b; }
  void put(std::uint32_t place, VertexId v) { heap_[place] = v, place_[v] = place; }

  std::uint32_t raise(std::uint32_t place) {
    const VertexId v = heap_[place];
    while (place > 0 && is_before(v, heap_[(place - 1) / 4])) {
      put(place, heap_[(place - 1) / 4]);
      place = (place - 1) / 4;
    }
    put(place, v);
    return place;
  }

  void sink(std::uint32_t place) {
    const VertexId v = heap_[place];
    const auto size = static_cast<std::uint32_t>(heap_.size());
    for (std::uint32_t child = 4 * place + 1; child < size; child = 4 * place + 1) {
      std::uint32_t least = child;
      for (std::uint32_t other = child + 1; other < std::min(child + 4, size); ++other) {
        if (is_before(heap_[other], heap_[least])) least = other;
      }
      if (!is_before(heap_[least], v)) break;
      put(place, heap_[least]);
      place = least;
    }
    put(place, v);
  }

  std::vector<double> key_;           // by vertex
  std::vector<std::uint32_t> place_;  // by vertex: index in heap_
  std::vector<VertexId> heap_;
};

}  // namespace selvage
