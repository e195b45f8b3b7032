// SPDX-License-Identifier: MIT
#include "common/net/tcp_stream.h"

#include <charconv>
#include <netinet/tcp.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>

#include "common/net/await.h"

namespace selvage {
namespace {

using asio::ip::tcp;
using boost::system::error_code;

/// Bytes handed to the kernel but not yet sent: enough to keep a fast link busy between two writes.
constexpr int kNotSentLowWater = 128 << 10;

class TcpStream final : public ByteStream {
 public:
  explicit TcpStream(tcp::socket socket) : socket_(std::move(socket)) {
    tune_for_sessions(socket_);
    peer_ = peer_of(socket_);
  }

  asio::awaitable<Result<std::size_t>> read_some(std::span<std::byte> into) override {
    const asio::mutable_buffer room(into.data(), into.size());
    auto [error, count] = co_await socket_.async_read_some(room, kAwait);
    if (error == asio::error::eof) co_return std::size_t{0};
    if (error) co_return connection_failure(error);
    co_return count;
  }

  asio::awaitable<Result<void>> write(const Pieces& pieces) override {
    buffers_.clear();
    for (const auto& piece : pieces) buffers_.emplace_back(piece.data(), piece.size());
    auto [error, count] = co_await asio::async_write(socket_, buffers_, kAwait);
    if (error) co_return connection_failure(error);
    co_return Result<void>();
  }

  void close() override {
    error_code ignored;
    socket_.shutdown(tcp::socket::shutdown_both, ignored);
    socket_.close(ignored);
  }

  asio::any_io_executor executor() override { return socket_.get_executor(); }
  std::string peer() const override { return peer_; }

 private:
  tcp::socket socket_;
  std::vector<asio::const_buffer> buffers_;
  std::string peer_;
};

using Endpoints = tcp::resolver::results_type;

asio::awaitable<Result<Endpoints>> resolve(std::string host, std::uint16_t port) {
  tcp::resolver resolver(co_await asio::this_coro::executor);
  auto [error, endpoints] = co_await resolver.async_resolve(host, std::to_string(port), kAwait);
  if (error) co_return fail(ErrorCode::NotFound, "no such host: " + host + " (" + error.message() + ")");
  co_return endpoints;
}

/// By pointer: what `||` chooses from must be default-constructible, which a socket is not.
asio::awaitable<Result<std::unique_ptr<tcp::socket>>> resolve_and_connect(std::string host,
                                                                          std::uint16_t port) {
  Result<Endpoints> endpoints = co_await resolve(host, port);
  if (!endpoints) co_return forward_error(endpoints);
  auto socket = std::make_unique<tcp::socket>(co_await asio::this_coro::executor);
  auto [error, endpoint] = co_await asio::async_connect(*socket, *endpoints, kAwait);
  if (error) {
    co_return fail(ErrorCode::Unavailable,
                   "cannot connect to " + HostPort{host, port}.to_string() + ": " + error.message());
  }
  co_return socket;
}

asio::awaitable<void> pause(std::chrono::steady_clock::duration duration) {
  asio::steady_timer timer(co_await asio::this_coro::executor, duration);
  co_await timer.async_wait(kAwait);
}

}  // namespace

void tune_for_sessions(tcp::socket& socket) {
  error_code ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  using NotSentLowWater = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_NOTSENT_LOWAT>;
  socket.set_option(NotSentLowWater(kNotSentLowWater), ignored);
}

std::string peer_of(const tcp::socket& socket) {
  error_code ignored;
  const tcp::endpoint remote = socket.remote_endpoint(ignored);
  return HostPort{remote.address().to_string(), remote.port()}.to_string();
}

tl::unexpected<Error> connection_failure(const error_code& error) {
  if (error == asio::error::operation_aborted) return fail(ErrorCode::Cancelled, "the connection was closed");
  return fail(ErrorCode::Io, "the connection broke: " + error.message());
}

std::unique_ptr<ByteStream> make_tcp_stream(tcp::socket socket) {
  return std::make_unique<TcpStream>(std::move(socket));
}

asio::awaitable<Result<tcp::socket>> connect_socket(std::string host, std::uint16_t port,
                                                    std::chrono::steady_clock::duration timeout) {
  using namespace asio::experimental::awaitable_operators;
  auto connecting = resolve_and_connect(host, port);
  auto timer = pause(timeout);
  auto first = co_await (std::move(connecting) || std::move(timer));
  if (first.index() == 1) {
    co_return fail(ErrorCode::Timeout, "no answer from " + HostPort{host, port}.to_string());
  }
  Result<std::unique_ptr<tcp::socket>> socket = std::move(std::get<0>(first));
  if (!socket) co_return forward_error(socket);
  co_return std::move(**socket);
}

asio::awaitable<Result<std::unique_ptr<ByteStream>>> connect_tcp(
    std::string host, std::uint16_t port, std::chrono::steady_clock::duration timeout) {
  Result<tcp::socket> socket = co_await connect_socket(std::move(host), port, timeout);
  if (!socket) co_return forward_error(socket);
  co_return make_tcp_stream(std::move(*socket));
}

std::string HostPort::to_string() const {
  const bool v6 = host.find(':') != std::string::npos;
  return (v6 ? '[' + host + ']' : host) + ':' + std::to_string(port);
}

Result<HostPort> parse_host_port(std::string_view text, std::string_view default_host) {
  const std::size_t colon = text.rfind(':');
  HostPort out;
  std::string_view host = text.substr(0, std::min(colon, text.size()));
  const std::string_view port = colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), out.port);
  const bool bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
  if (bracketed) host = host.substr(1, host.size() - 2);
  const bool stray_colon = !bracketed && host.find(':') != std::string_view::npos;
  if (error != std::errc() || port.empty() || end != port.data() + port.size() || stray_colon) {
    return fail(ErrorCode::InvalidArgument, "'" + std::string(text) + "' is not HOST:PORT");
  }
  out.host = host.empty() ? default_host : host;
  return out;
}

}  // namespace selvage
