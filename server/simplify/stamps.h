// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace selvage {

/// A set of elements that is emptied in no time: marks carry the number of the round they were made in.
class Stamps {
 public:
  explicit Stamps(std::uint32_t size) : round_of_(size, 0) {}

  void clear() {
    if (++round_ != 0) return;
    std::fill(round_of_.begin(), round_of_.end(), 0);
    round_ = 1;
  }
  bool contains(std::uint32_t element) const { return round_of_[element] == round_; }
  /// False if it was in the set already.
  bool insert(std::uint32_t element) {
    if (contains(element)) return false;
    round_of_[element] = round_;
    return true;
  }
  void erase(std::uint32_t element) { round_of_[element] = round_ - 1; }

 private:
  std::vector<std::uint32_t> round_of_;
  std::uint32_t round_ = 0;
};

}  // namespace selvage
