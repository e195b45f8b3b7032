// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace selvage {

/// The most heap memory in use at once since this object was made, beyond what was in use then. A program
/// that links heap_peak.cpp has its operator new replaced; one thread at a time.
class HeapPeak {
 public:
  HeapPeak();
  std::size_t bytes() const;

 private:
  std::size_t before_;
};

}  // namespace selvage
