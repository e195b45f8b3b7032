// SPDX-License-Identifier: MIT
//
// A connection as sessions see it: bytes in order, both ways. TCP is one (tcp_stream.h), TLS another (tls.h);
// tests have one in memory, which fails where they want it to. WebSocket is to come.
//
// Single-strand: everything is called, and completes, on executor(). One read and one write may be under way
// at the same time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>

#include "common/base/result.h"

namespace selvage {

namespace asio = boost::asio;

/// Bytes to write. They are in memory in any case; if a file holds them too, a stream may take them from
/// there.
struct Piece : std::span<const std::byte> {
  using std::span<const std::byte>::span;
  Piece() = default;
  Piece(std::span<const std::byte> bytes) : std::span<const std::byte>(bytes) {}
  int file = -1;  ///< open descriptor, or -1
  std::uint64_t file_offset = 0;
};

/// Pieces that are written one after the other, as if they were one.
using Pieces = std::vector<Piece>;

class ByteStream {
 public:
  virtual ~ByteStream() = default;

  /// What must be agreed with the peer before bytes flow; called once, first. TCP has nothing to agree.
  virtual asio::awaitable<Result<void>> handshake() { co_return Result<void>(); }

  /// Reads at least one byte into `into`, which is not empty; 0 when the peer has ended the stream.
  virtual asio::awaitable<Result<std::size_t>> read_some(std::span<std::byte> into) = 0;

  /// Writes all of it. The pieces and what they point at stay until it is done.
  virtual asio::awaitable<Result<void>> write(const Pieces& pieces) = 0;

  /// How much one write should carry. What a write has begun cannot be taken back, so on a far connection, or
  /// one that may be, it is little: a cancel or an urgent answer then waits behind little. On a near one it
  /// is more, since every write costs a turn of the event loop.
  virtual std::size_t write_size() const { return kFarWrite; }
  static constexpr std::size_t kFarWrite = 32u << 10;
  static constexpr std::size_t kNearWrite = 256u << 10;

  /// Ends both directions; what is under way fails with Cancelled. May be called again.
  virtual void close() = 0;

  virtual asio::any_io_executor executor() = 0;

  /// The other side, for logs: "127.0.0.1:4711".
  virtual std::string peer() const = 0;
};

}  // namespace selvage
