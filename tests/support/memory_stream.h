// SPDX-License-Identifier: MIT
//
// A connection in memory whose nth operation fails, so that a test can put a failure everywhere.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "common/net/byte_stream.h"

namespace selvage::testing {

/// Counts the reads and writes of the ends that share it, and breaks the connection at one of them.
struct FaultPlan {
  static constexpr std::size_t kNever = ~std::size_t{0};
  std::size_t fails_at = kNever;  ///< 0: the first operation
  std::size_t operations = 0;     ///< so far

  bool happened() const { return operations > fails_at; }
};

struct MemoryStreamOptions {
  std::size_t capacity = 64 << 10;           ///< bytes under way in each direction; a write waits beyond
  std::size_t read_limit = ~std::size_t{0};  ///< most that one read gives
  std::shared_ptr<FaultPlan> first_fault = std::make_shared<FaultPlan>();
  std::shared_ptr<FaultPlan> second_fault = std::make_shared<FaultPlan>();
};

using StreamPair = std::pair<std::unique_ptr<ByteStream>, std::unique_ptr<ByteStream>>;

/// The two ends of one connection. An end that fails or is closed (or destroyed) looks to the other like a
/// peer that has gone: what was written can be read, then the stream ends, and writes fail.
StreamPair make_memory_streams(asio::any_io_executor executor, MemoryStreamOptions options = {});

}  // namespace selvage::testing
