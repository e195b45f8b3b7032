// SPDX-License-Identifier: MIT
#include "common/net/tcp_stream.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <sys/socket.h>
#include <sys/uio.h>
#include <utility>

#include <boost/asio/connect.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/net/await.h"
#include "common/net/send_pace.h"

namespace selvage {
namespace {

using asio::ip::tcp;
using boost::system::error_code;

/// What is left of the pieces of one write, sent with a system call at a time.
class Unsent {
 public:
  explicit Unsent(const Pieces& pieces) : pieces_(pieces) { skip_empty(); }

  bool empty() const { return next_ == pieces_.size(); }

  /// As ::send does.
  ssize_t send(int socket) {
    std::array<iovec, 128> parts;
    std::size_t count = 0, at = next_;
    for (; at < pieces_.size() && count < parts.size(); ++at) {
      const std::size_t done = at == next_ ? done_ : 0;
      parts[count++] = {const_cast<std::byte*>(pieces_[at].data()) + done, pieces_[at].size() - done};
    }
    msghdr message{};
    message.msg_iov = parts.data();
    message.msg_iovlen = count;
    const bool more = at < pieces_.size();
    const ssize_t sent = ::sendmsg(socket, &message, MSG_NOSIGNAL | (more ? MSG_MORE : 0));
    if (sent > 0) advance(static_cast<std::size_t>(sent));
    return sent;
  }

  /// Reads a byte of every page of it.
  void look_through() const {
    for (std::size_t at = next_; at < pieces_.size(); ++at) {
      const volatile std::byte* bytes = pieces_[at].data();
      for (std::size_t i = 0; i < pieces_[at].size(); i += 1024) (void)bytes[i];
      if (!pieces_[at].empty()) (void)bytes[pieces_[at].size() - 1];
    }
  }

 private:
  void advance(std::size_t bytes) {
    while (bytes > 0) {
      const std::size_t step = std::min(bytes, pieces_[next_].size() - done_);
      bytes -= step;
      done_ += step;
      if (done_ < pieces_[next_].size()) return;
      ++next_;
      done_ = 0;
      skip_empty();
    }
  }
  void skip_empty() {
    while (next_ < pieces_.size() && pieces_[next_].empty()) ++next_;
  }

  const Pieces& pieces_;
  std::size_t next_ = 0, done_ = 0;  ///< piece, and bytes of it
};

class TcpStream final : public ByteStream {
 public:
  explicit TcpStream(tcp::socket socket) : socket_(std::move(socket)), pace_(socket_) {
    error_code ignored;
    socket_.set_option(tcp::no_delay(true), ignored);
    socket_.native_non_blocking(true, ignored);
  }

  asio::awaitable<std::tuple<error_code>> wait_to_read() override {
    return socket_.async_wait(tcp::socket::wait_read, kAwait);
  }

  asio::awaitable<Result<std::size_t>> read_some(std::span<std::byte> into) override {
    const asio::mutable_buffer room(into.data(), into.size());
    auto [error, count] = co_await socket_.async_read_some(room, kAwait);
    if (error == asio::error::eof) co_return std::size_t{0};
    if (error) co_return connection_failure(error);
    co_return count;
  }

  asio::awaitable<Result<void>> write(const Pieces& pieces) override {
    bool waited = false, was_looked_through = false;
    Unsent unsent(pieces);
    while (!unsent.empty()) {
      if (!socket_.is_open()) co_return connection_failure(asio::error::operation_aborted);
      if (unsent.send(socket_.native_handle()) >= 0 || errno == EINTR) continue;
      // The kernel finds no bytes where a mapped file was cut short; we do, or learn of it: mapped_file.h.
      if (errno == EFAULT && !std::exchange(was_looked_through, true)) {
        unsent.look_through();
        continue;
      }
      if (errno != EAGAIN && errno != EWOULDBLOCK) {
        co_return connection_failure(error_code(errno, boost::system::system_category()));
      }
      auto [error] = co_await socket_.async_wait(tcp::socket::wait_write, kAwait);
      if (error) co_return connection_failure(error);
      waited = true;
    }
    // Others have their turn, even when the kernel takes whatever we have.
    if (!waited) co_await asio::post(socket_.get_executor(), asio::use_awaitable);
    co_return Result<void>();
  }

  asio::awaitable<Result<void>> wait_to_write() override { return pace_.wait(); }
  std::size_t write_size() const override { return pace_.write_size(); }

  void close() override {
    error_code ignored;
    socket_.shutdown(tcp::socket::shutdown_both, ignored);
    socket_.close(ignored);
  }

  asio::any_io_executor executor() override { return socket_.get_executor(); }
  std::string peer() const override { return peer_of(socket_); }

 private:
  tcp::socket socket_;
  SendPace pace_;
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

std::string peer_of(const tcp::socket& socket) {
  error_code ignored;
  const tcp::endpoint remote = socket.remote_endpoint(ignored);
  return HostPort{remote.address().to_string(), remote.port()}.to_string();
}

Result<void> listen_on(tcp::acceptor& acceptor, const HostPort& address) {
  error_code error;
  tcp::resolver resolver(acceptor.get_executor());
  const auto found =
      resolver.resolve(address.host, std::to_string(address.port), tcp::resolver::passive, error);
  if (error) return fail(ErrorCode::InvalidArgument, "no such host: " + address.host);
  const tcp::endpoint endpoint = found.begin()->endpoint();
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(tcp::acceptor::max_listen_connections, error);
  if (error) {
    return fail(ErrorCode::Unavailable, "cannot listen on " + address.to_string() + ": " + error.message());
  }
  return {};
}

HostPort address_of(const tcp::acceptor& acceptor) {
  error_code ignored;
  const tcp::endpoint local = acceptor.local_endpoint(ignored);
  return {local.address().to_string(), local.port()};
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
