// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace selvage {

/// The elements of `values` that `chosen` names, in its order: a selection, or a permutation.
template <class T>
std::vector<T> gathered(const std::vector<T>& values, const std::vector<std::uint32_t>& chosen) {
  std::vector<T> to;
  to.reserve(chosen.size());
  for (std::uint32_t i : chosen) to.push_back(values[i]);
  return to;
}

}  // namespace selvage
