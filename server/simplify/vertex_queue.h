// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/base/ids.h"

namespace selvage {

/// Elements from `first` on by key, lowest first, ties by number: an indexed heap with four children a node,
/// one entry an element, so that a key changes in place. The order of removals does not depend on that of
/// insertions. Keys lie in the heap, where comparisons find them: kept by element, simplifying igea took a
/// tenth longer.
template <class Key>
class KeyedHeap {
 public:
  KeyedHeap(std::uint32_t first, std::uint32_t count) : first_(first), place_(count, kNone) {}

  bool is_empty() const { return heap_.empty(); }
  bool contains(std::uint32_t element) const { return place_[element - first_] != kNone; }
  std::uint32_t top() const { return heap_.front().element; }
  const Key& top_key() const { return heap_.front().key; }
  /// Needs contains(element).
  const Key& key(std::uint32_t element) const { return heap_[place_[element - first_]].key; }

  /// Inserts the element, or changes its key.
  void set(std::uint32_t element, const Key& key) {
    std::uint32_t& place = place_[element - first_];
    if (place == kNone) {
      place = static_cast<std::uint32_t>(heap_.size());
      heap_.emplace_back();
    }
    settle(place, {key, element});
  }

  /// Needs contains(element).
  void remove(std::uint32_t element) {
    const std::uint32_t hole = std::exchange(place_[element - first_], kNone);
    const Entry last = heap_.back();
    heap_.pop_back();
    if (last.element != element) settle(hole, last);
  }

 private:
  struct Entry {
    Key key{};
    std::uint32_t element = kNone;
    friend bool operator<(const Entry& a, const Entry& b) {
      return a.key != b.key ? a.key < b.key : a.element < b.element;
    }
  };

  void put(std::uint32_t place, const Entry& entry) {
    heap_[place] = entry;
    place_[entry.element - first_] = place;
  }

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

  std::uint32_t first_;
  std::vector<Entry> heap_;
  std::vector<std::uint32_t> place_;  // by element: index in heap_
};

/// Vertices by key, in blocks of neighbouring numbers. Who can do with nearly the lowest key stays in a block
/// for a while, where memory is near: on a mesh in spatial order of two million triangles that makes
/// simplification twice as fast.
class VertexQueue {
 public:
  explicit VertexQueue(std::uint32_t vertex_count) : lowest_(0, blocks_of(vertex_count)) {
    for (std::uint32_t first = 0; first < vertex_count; first += kBlock)
      blocks_.emplace_back(first, std::min(kBlock, vertex_count - first));
  }

  /// From now on top() may have a key up to so many times the lowest; 1: it is the lowest, ties by number.
  void set_patience(double patience) {
    patience_ = patience;
    current_ = kNone;
  }

  bool is_empty() const { return lowest_.is_empty(); }
  bool contains(VertexId v) const { return blocks_[v / kBlock].contains(v); }
  /// Needs contains(v).
  double key(VertexId v) const { return blocks_[v / kBlock].key(v); }

  VertexId top() {
    const bool may_stay = patience_ > 1 && current_ != kNone && !blocks_[current_].is_empty() &&
                          blocks_[current_].top_key() <= limit_;
    if (!may_stay) {
      current_ = lowest_.top();
      limit_ = patience_ * blocks_[current_].top_key();
    }
    return blocks_[current_].top();
  }

  /// Inserts `v`, or changes its key.
  void set(VertexId v, double key) {
    blocks_[v / kBlock].set(v, key);
    update(v / kBlock);
  }

  /// Needs contains(v).
  void remove(VertexId v) {
    blocks_[v / kBlock].remove(v);
    update(v / kBlock);
  }

 private:
  static constexpr std::uint32_t kBlock = 4096;
  static std::uint32_t blocks_of(std::uint32_t count) { return (count + kBlock - 1) / kBlock; }

  using Lowest = std::pair<double, VertexId>;

  void update(std::uint32_t block) {
    const KeyedHeap<double>& heap = blocks_[block];
    if (!heap.is_empty()) {
      const Lowest lowest{heap.top_key(), heap.top()};
      if (!lowest_.contains(block) || lowest_.key(block) != lowest) lowest_.set(block, lowest);
    } else if (lowest_.contains(block)) {
      lowest_.remove(block);
    }
  }

  std::vector<KeyedHeap<double>> blocks_;
  KeyedHeap<Lowest> lowest_;  // of every block that is not empty
  double patience_ = 1;
  std::uint32_t current_ = kNone;
  double limit_ = 0;
};

}  // namespace selvage
