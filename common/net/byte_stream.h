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
#include <tuple>
#include <vector>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>

#include "common/base/result.h"

namespace selvage {

namespace asio = boost::asio;

/// Bytes to write.
struct Piece {
  std::span<const std::byte> bytes;
  /// Of a mapped file: the kernel may hold on to the pages after the write instead of copying them.
  bool is_mapped = false;

  Piece(std::span<const std::byte> these, bool mapped = false) : bytes(these), is_mapped(mapped) {}
  Piece(const std::vector<std::byte>& these) : bytes(these) {}
};
/// Written one after the other, as if they were one piece.
using Pieces = std::vector<Piece>;

class ByteStream {
 public:
  virtual ~ByteStream() = default;

  /// What must be agreed with the peer before bytes flow; called once, first. TCP has nothing to agree.
  virtual asio::awaitable<Result<void>> handshake() { co_return Result<void>(); }

  /// Returns when there is something to read, or when there may be: for those who want to hold no buffer
  /// meanwhile.
  virtual asio::awaitable<std::tuple<boost::system::error_code>> wait_to_read() {
    co_return boost::system::error_code();
  }

  /// Reads at least one byte into `into`, which is not empty; 0 when the peer has ended the stream.
  virtual asio::awaitable<Result<std::size_t>> read_some(std::span<std::byte> into) = 0;

  /// Writes all of it. The pieces and what they point at stay until it is done.
  virtual asio::awaitable<Result<void>> write(const Pieces& pieces) = 0;

  /// Whether write_at_once() is worth a try: data need not wait for its time (wait_to_write).
  virtual bool may_write_at_once() { return false; }
  /// Writes as much of it as goes without waiting, from the first byte on, and says how much that was. What
  /// is wrong with the connection, the next write() says. Not while a write() is under way.
  virtual std::size_t write_at_once(const Pieces&) { return 0; }

  /// Returns when what was written before is nearly gone, so that what is written next goes soon. To be
  /// awaited before each write of data; then is the time to choose what to write.
  virtual asio::awaitable<Result<void>> wait_to_write() { co_return Result<void>(); }

  /// How much that write should carry. What a write has begun cannot be taken back: a cancel or an urgent
  /// answer waits behind it.
  virtual std::size_t write_size() const { return kUsualWrite; }
  static constexpr std::size_t kUsualWrite = 32u << 10;

  /// Says that nothing more comes, and goes on reading: what was written arrives. After close() it need not,
  /// if the peer has sent something that nobody read.
  virtual void end_writing() = 0;

  /// Ends both directions; what is under way fails with Cancelled. May be called again.
  virtual void close() = 0;

  virtual asio::any_io_executor executor() = 0;

  /// The other side, for logs: "127.0.0.1:4711".
  virtual std::string peer() const = 0;
};

}  // namespace selvage
