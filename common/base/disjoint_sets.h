// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace selvage {

/// Elements 0 to size - 1 in sets that only ever merge [Tarjan 1975]. A set is named by its lowest element,
/// so names do not depend on the order of merging.
class DisjointSets {
 public:
  explicit DisjointSets(std::uint32_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }

  /// Not const: halves the path on the way.
  std::uint32_t set_of(std::uint32_t element) {
    while (parent_[element] != element) element = parent_[element] = parent_[parent_[element]];
    return element;
  }

  /// False if the two were in one set already.
  bool merge(std::uint32_t a, std::uint32_t b) {
    a = set_of(a);
    b = set_of(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace selvage
