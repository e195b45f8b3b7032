// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace selvage::bench {

/// Counts what operator new gives out in this program: the bytes in use now, and the most that were at a time
/// since the last call of forget_heap_peak().
std::size_t heap_in_use();
std::size_t heap_peak();
void forget_heap_peak();

}  // namespace selvage::bench
