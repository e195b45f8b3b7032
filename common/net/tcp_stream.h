// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include <boost/asio/ip/tcp.hpp>

#include "common/net/byte_stream.h"

namespace selvage {

/// Takes over a connected socket, whose executor must be a strand (or the only thread of its io_context).
/// Sets TCP_NODELAY, since a session gathers what it sends, and a SendPace, so that what waits to be sent
/// waits in the session, where it can still be cancelled.
std::unique_ptr<ByteStream> make_tcp_stream(asio::ip::tcp::socket socket);

/// For streams on top of one: names the peer; says how a connection failed.
std::string peer_of(const asio::ip::tcp::socket& socket);
tl::unexpected<Error> connection_failure(const boost::system::error_code& error);

/// Resolves and connects, trying each address. NotFound: no such host; Unavailable: nobody listens there;
/// Timeout.
asio::awaitable<Result<asio::ip::tcp::socket>> connect_socket(std::string host, std::uint16_t port,
                                                              std::chrono::steady_clock::duration timeout);
asio::awaitable<Result<std::unique_ptr<ByteStream>>> connect_tcp(std::string host, std::uint16_t port,
                                                                 std::chrono::steady_clock::duration timeout);

/// "host:port" or "[v6]:port"; the host may be left out (":8080"), then `default_host` is meant.
struct HostPort {
  std::string host;
  std::uint16_t port = 0;

  std::string to_string() const;
};
Result<HostPort> parse_host_port(std::string_view text, std::string_view default_host = "127.0.0.1");

/// Opens, binds and listens; port 0 picks a free one. InvalidArgument: no such host; Unavailable says why
/// not.
Result<void> listen_on(asio::ip::tcp::acceptor& acceptor, const HostPort& address);
HostPort address_of(const asio::ip::tcp::acceptor& acceptor);  ///< with the port that was picked

}  // namespace selvage
