// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "common/base/parallel.h"

namespace selvage {

/// Calls body(begin, end) on consecutive slices of [0, count), possibly at the same time. For per-vertex work
/// whose scratch memory is worth sharing between neighbours: there are at most 32 slices. The slices depend
/// on `count` alone, never on the number of threads.
template <class Body>
void for_each_chunk(const ParallelFor& parallel, std::size_t count, const Body& body) {
  constexpr std::size_t kMaxChunks = 32, kMinChunk = 256;
  const std::size_t chunks = std::clamp<std::size_t>(count / kMinChunk, 1, kMaxChunks);
  parallel(chunks, [&](std::size_t i) { body(count * i / chunks, count * (i + 1) / chunks); });
}

}  // namespace selvage
