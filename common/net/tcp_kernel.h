// SPDX-License-Identifier: MIT
//
// What the kernel knows of a TCP connection, and what it is told, beyond what Asio offers. (The kernel's own
// header for it and the C library's, which Asio includes, cannot meet in one source.)
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/base/result.h"

namespace selvage {

struct TcpFigures {
  std::uint32_t round_trip_us = 0;
  std::uint64_t bytes_per_second = 0;  ///< that reached the peer of late; 0 while that is unknown
};
std::optional<TcpFigures> tcp_figures(int socket);

/// The kernel takes more for sending while less than `bytes` wait in it, and says so at half of that.
void limit_unsent(int socket, std::uint32_t bytes);

/// Of this socket; set on one that listens, of those that it accepts. InvalidArgument for what this kernel
/// does not have, or does not let us use.
Result<void> use_congestion_control(int socket, const std::string& name);

}  // namespace selvage
