// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>

#include "common/net/tcp_stream.h"

namespace selvage::testing {

/// The whole answer, header and body, to one request on a connection of its own.
inline std::string http_exchange(const HostPort& address, const std::string& request) {
  asio::io_context io;
  asio::ip::tcp::socket socket(io);
  socket.connect({asio::ip::make_address(address.host), address.port});
  asio::write(socket, asio::buffer(request));
  std::string answer;
  boost::system::error_code end;
  asio::read(socket, asio::dynamic_buffer(answer), end);
  return answer;
}

inline std::string http_get(const HostPort& address, const std::string& target) {
  return http_exchange(address, "GET " + target + " HTTP/1.1\r\nHost: test\r\nConnection: close\r\n\r\n");
}

}  // namespace selvage::testing
