// SPDX-License-Identifier: MIT
//
// How much a connection hands to the kernel at a time. What the kernel has, a cancel or an urgent answer can
// only wait for: it should be little, as time goes. Every write costs a turn of the event loop: it should be
// much, as bytes go. So a write carries what the connection delivers in a few milliseconds, by the kernel's
// own measure, and the kernel holds about two of them.
#pragma once

#include <cstddef>

#include <boost/asio/awaitable.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "common/base/result.h"

namespace selvage {

/// For one socket, on its strand.
class SendPace {
 public:
  static constexpr std::size_t kLeastWrite = 4u << 10;
  static constexpr std::size_t kMostWrite = 1u << 20;

  /// Sets what the kernel may hold.
  explicit SendPace(boost::asio::ip::tcp::socket& socket);

  std::size_t write_size() const { return write_size_; }

  /// Returns when the kernel is about to run out of what it has; at once on fast connections. Call it before
  /// each write, and then choose what to write.
  boost::asio::awaitable<Result<void>> wait();
  /// Whether that takes a while. Stands for a call of wait() where it does not.
  bool must_wait();

 private:
  void measure();
  void set_write_size(std::size_t bytes);

  boost::asio::ip::tcp::socket& socket_;
  std::size_t write_size_ = 0;
  unsigned writes_until_measure_ = 0;
};

}  // namespace selvage
