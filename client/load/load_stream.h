// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "client/load/load_script.h"
#include "common/net/byte_stream.h"

namespace selvage {

/// What one client's streams have read, one after the other.
struct StreamMeter {
  std::uint64_t received = 0;
  std::uint64_t break_at = ~std::uint64_t{0};  ///< the connection breaks once so much was received
  bool is_stalled = false;  ///< no further read brings anything, until the stream is closed

  bool has_broken() const { return received >= break_at; }
};

/// A stream that counts, and behaves like a slow link: it reads no faster than the shape's rate, and what it
/// writes leaves a round trip later, whole and in order. What the kernel has already taken in is past such
/// shaping: a server sees it as sent. `meter` must outlive it.
std::unique_ptr<ByteStream> make_load_stream(std::unique_ptr<ByteStream> stream, const LinkShape& link,
                                             StreamMeter& meter);

}  // namespace selvage
