// SPDX-License-Identifier: MIT
#include "tests/codec/heap_peak.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace {

std::size_t in_use = 0, most = 0;

/// In front of every block, and as wide as its alignment; at first that which plain new promises.
constexpr std::size_t kHeader = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

void* take(std::size_t size, std::size_t header = kHeader) {
  const std::size_t whole = (size + 2 * header - 1) / header * header;
  auto* block = static_cast<std::byte*>(std::aligned_alloc(header, whole));
  if (block == nullptr) throw std::bad_alloc();
  *reinterpret_cast<std::size_t*>(block) = size;
  in_use += size;
  most = std::max(most, in_use);
  return block + header;
}

void give_back(void* pointer, std::size_t header = kHeader) {
  if (pointer == nullptr) return;
  auto* block = static_cast<std::byte*>(pointer) - header;
  in_use -= *reinterpret_cast<std::size_t*>(block);
  std::free(block);
}

}  // namespace

void* operator new(std::size_t size) { return take(size); }
void* operator new[](std::size_t size) { return take(size); }
void operator delete(void* pointer) noexcept { give_back(pointer); }
void operator delete[](void* pointer) noexcept { give_back(pointer); }
void operator delete(void* pointer, std::size_t) noexcept { give_back(pointer); }
void operator delete[](void* pointer, std::size_t) noexcept { give_back(pointer); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return take(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* pointer, std::align_val_t alignment) noexcept {
  give_back(pointer, static_cast<std::size_t>(alignment));
}

namespace selvage {

HeapPeak::HeapPeak() : before_(in_use) { most = in_use; }
std::size_t HeapPeak::bytes() const { return most - before_; }

}  // namespace selvage
