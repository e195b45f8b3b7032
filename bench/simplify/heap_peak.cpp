// SPDX-License-Identifier: MIT
#include "bench/simplify/heap_peak.h"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace {

std::size_t g_in_use = 0, g_peak = 0;  // the benchmarks that count are single-threaded

}  // namespace

void* operator new(std::size_t size) {
  void* block = std::malloc(size);
  if (block == nullptr) throw std::bad_alloc();
  g_in_use += malloc_usable_size(block);
  g_peak = std::max(g_peak, g_in_use);
  return block;
}
void* operator new[](std::size_t size) { return operator new(size); }
void operator delete(void* block) noexcept {
  g_in_use -= malloc_usable_size(block);  // 0 for nullptr
  std::free(block);
}
void operator delete[](void* block) noexcept { operator delete(block); }
void operator delete(void* block, std::size_t) noexcept { operator delete(block); }
void operator delete[](void* block, std::size_t) noexcept { operator delete(block); }

namespace selvage::bench {

std::size_t heap_in_use() { return g_in_use; }
std::size_t heap_peak() { return g_peak; }
void forget_heap_peak() { g_peak = g_in_use; }

}  // namespace selvage::bench
