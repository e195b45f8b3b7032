// SPDX-License-Identifier: MIT
//
// How pure code runs in parallel without knowing threads: a stage takes a ParallelFor and calls it.
// The result of a stage never depends on which one it is given.
#pragma once

#include <cstddef>
#include <functional>

namespace selvage {

/// Calls body(i) once for every i in [0, count), in any order and possibly at the same time; returns when
/// all are done. The first exception thrown by a body is rethrown.
using ParallelFor = std::function<void(std::size_t count, const std::function<void(std::size_t)>& body)>;

/// One after the other, on the calling thread.
ParallelFor serial_for();

/// On up to `threads` threads (0: as many as the machine has).
ParallelFor threaded_for(unsigned threads);

}  // namespace selvage
