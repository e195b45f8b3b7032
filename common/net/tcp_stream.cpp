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
#include "common/net/page_pipe.h"
#include "common/net/send_pace.h"

namespace selvage {
namespace {

using asio::ip::tcp;
using boost::system::error_code;

/// Handing over a page costs about as much as copying a few hundred bytes of it into memory that the kernel
/// has just used, but far less than copying it into memory that is not in the processor's cache.
constexpr std::size_t kLeastHandedOver = 32u << 10;
/// Before and between what is handed over, so much at most goes the same way.
constexpr std::size_t kMostCopied = 8u << 10;

bool is_handed_over(const Piece& piece) { return piece.is_mapped && piece.bytes.size() >= kLeastHandedOver; }

/// What is left of the pieces of one write, sent with a few system calls at a time.
class Unsent {
 public:
  explicit Unsent(const Pieces& pieces) : pieces_(pieces) { advance(0); }

  bool empty() const { return next_ == pieces_.size(); }

  /// As ::send does.
  ssize_t send(int socket) {
    const ssize_t sent = send_some(socket);
    if (sent > 0) advance(static_cast<std::size_t>(sent));
    return sent;
  }

  /// Reads a byte of every page of it.
  void look_through() const {
    for (std::size_t at = next_; at < pieces_.size(); ++at) {
      const std::span<const std::byte> piece = pieces_[at].bytes;
      const volatile std::byte* bytes = piece.data();
      for (std::size_t i = 0; i < piece.size(); i += 1024) (void)bytes[i];
      if (!piece.empty()) (void)bytes[piece.size() - 1];
    }
  }

 private:
  /// Pieces from `begin` up to one that is handed over, as many as one system call takes.
  struct CopiedRun {
    std::array<iovec, 128> parts;
    std::size_t count = 0, size = 0, end = 0;
    std::span<const iovec> filled() const { return std::span(parts).first(count); }
  };

  std::span<const std::byte> rest_of(std::size_t at) const {
    return pieces_[at].bytes.subspan(at == next_ ? done_ : 0);
  }

  CopiedRun copied_from(std::size_t begin, bool copy_all) const {
    CopiedRun run;
    for (run.end = begin; run.end < pieces_.size() && run.count < run.parts.size(); ++run.end) {
      if (!copy_all && is_handed_over(pieces_[run.end])) break;
      const std::span<const std::byte> piece = rest_of(run.end);
      run.parts[run.count++] = {const_cast<std::byte*>(piece.data()), piece.size()};
      run.size += piece.size();
    }
    return run;
  }

  ssize_t send_some(int socket) const {
    CopiedRun run = copied_from(next_, false);
    const bool hands_over = run.end < pieces_.size() && run.size <= kMostCopied;
    PagePipe* pipe = hands_over ? PagePipe::of_this_thread() : nullptr;
    if (pipe) return hand_over(socket, *pipe, run);
    if (run.count == 0) run = copied_from(next_, true);
    msghdr message{};
    message.msg_iov = run.parts.data();
    message.msg_iovlen = run.count;
    return ::sendmsg(socket, &message, MSG_NOSIGNAL | (run.end < pieces_.size() ? MSG_MORE : 0));
  }

  /// As much as the pipe takes, `run` first, which it changes.
  ssize_t hand_over(int socket, PagePipe& pipe, CopiedRun& run) const {
    std::size_t at = next_;
    for (;;) {
      const ssize_t copied = run.count > 0 ? pipe.add_copies(run.filled()) : 0;
      if (copied < 0 && pipe.empty()) return copied;
      if (copied != static_cast<ssize_t>(run.size)) break;
      at = run.end;
      if (at == pieces_.size() || !is_handed_over(pieces_[at])) break;
      const std::span<const std::byte> pages = rest_of(at);
      const ssize_t added = pipe.add_pages(pages);
      if (added < 0 && pipe.empty()) return added;
      if (added != static_cast<ssize_t>(pages.size())) break;
      run = copied_from(++at, false);
      if (run.size > kMostCopied) break;
    }
    return pipe.send(socket, at < pieces_.size());
  }

  /// To the next byte that is left, if any.
  void advance(std::size_t bytes) {
    while (bytes > 0 || (!empty() && rest_of(next_).empty())) {
      const std::size_t step = std::min(bytes, rest_of(next_).size());
      bytes -= step;
      done_ += step;
      if (done_ < pieces_[next_].bytes.size()) return;
      ++next_;
      done_ = 0;
    }
  }

  const Pieces& pieces_;
  std::size_t next_ = 0, done_ = 0;  ///< piece, and bytes of it
};

std::size_t size_of(const Pieces& pieces) {
  std::size_t sum = 0;
  for (const Piece& piece : pieces) sum += piece.bytes.size();
  return sum;
}

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

  /// Who has waited finds something there; a turn of the event loop for it is left to every sixteenth read,
  /// for the sake of the others.
  asio::awaitable<Result<std::size_t>> read_some(std::span<std::byte> into) override {
    if (++reads_ % 16 != 0) {
      const ssize_t count = ::recv(socket_.native_handle(), into.data(), into.size(), MSG_DONTWAIT);
      if (count >= 0) co_return static_cast<std::size_t>(count);
    }
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
    // Others have their turn, even when the kernel takes whatever we have; after less than a whole write
    // there is no more at once.
    const bool may_go_on = size_of(pieces) >= write_size() / 2;
    if (!waited && may_go_on) co_await asio::post(socket_.get_executor(), asio::use_awaitable);
    co_return Result<void>();
  }

  bool may_write_at_once() override { return socket_.is_open() && !pace_.must_wait(); }

  std::size_t write_at_once(const Pieces& pieces) override {
    std::size_t written = 0;
    for (Unsent unsent(pieces); !unsent.empty();) {
      const ssize_t sent = unsent.send(socket_.native_handle());
      if (sent < 0) break;
      written += static_cast<std::size_t>(sent);
    }
    return written;
  }

  asio::awaitable<Result<void>> wait_to_write() override { return pace_.wait(); }
  std::size_t write_size() const override { return pace_.write_size(); }

  void end_writing() override {
    error_code ignored;
    socket_.shutdown(tcp::socket::shutdown_send, ignored);
  }

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
  unsigned reads_ = 0;
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
