// SPDX-License-Identifier: MIT
#include "server/session/listener.h"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>

#include "common/base/log.h"
#include "common/net/await.h"
#include "common/net/tcp_kernel.h"

namespace selvage {
namespace {

using asio::ip::tcp;
using boost::system::error_code;

/// After an accept that failed for want of descriptors or memory: others must end first.
constexpr std::chrono::milliseconds kAcceptPause{50};

/// What connections are counted by. An IPv6 client often has a whole /64 to itself.
std::string counted_address(const tcp::socket& socket) {
  error_code ignored;
  const auto address = socket.remote_endpoint(ignored).address();
  if (!address.is_v6() || address.to_v6().is_v4_mapped()) return address.to_string();
  const auto bytes = address.to_v6().to_bytes();
  return std::string(bytes.begin(), bytes.begin() + 8);
}

/// Tells a client that there is no room. A few bytes always fit a fresh socket; whether they arrive is its
/// luck. (Over TLS it sees the connection end.)
void turn_away(tcp::socket socket, const char* why, bool is_plain) {
  if (!is_plain) return;
  const Error error{ErrorCode::Unavailable, why};
  const auto frame = to_frame(ErrorMessage{error, true}, 0);
  error_code ignored;
  socket.non_blocking(true, ignored);
  socket.write_some(asio::buffer(frame), ignored);
  socket.shutdown(tcp::socket::shutdown_send, ignored);
}

LogFields fields_of(const Session& session) {
  return {{"connection", std::to_string(session.number())}, {"peer", session.peer()}};
}

void log_end(const Session& session) {
  LogFields fields = fields_of(session);
  if (!session.reason()) return log(LogLevel::Debug, "left", fields);
  fields.emplace_back("reason", session.reason()->to_string());
  log(LogLevel::Info, "dropped", fields);
}

void log_exception(const Session& session, std::exception_ptr thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const std::exception& exception) {
    LogFields fields = fields_of(session);
    fields.emplace_back("reason", exception.what());
    log(LogLevel::Error, "dropped", fields);
  }
}

}  // namespace

Listener::Listener(asio::io_context& io, const SessionServices& services, const ServerLimits& limits,
                   std::shared_ptr<TlsContext> tls)
    : io_(io),
      services_(services),
      limits_(limits),
      strand_(asio::make_strand(io)),
      acceptor_(strand_),
      tls_(std::move(tls)),
      grace_(strand_) {}

Result<std::unique_ptr<Listener>> Listener::bind(asio::io_context& io, const HostPort& address,
                                                 const SessionServices& services, const ServerLimits& limits,
                                                 std::shared_ptr<TlsContext> tls) {
  std::unique_ptr<Listener> listener(new Listener(io, services, limits, std::move(tls)));
  if (auto listening = listen_on(listener->acceptor_, address); !listening) return forward_error(listening);
  return listener;
}

Result<void> Listener::use_congestion_control(const std::string& name) {
  return selvage::use_congestion_control(acceptor_.native_handle(), name);
}

HostPort Listener::address() const { return address_of(acceptor_); }

bool Listener::is_on_loopback() const {
  error_code ignored;
  return acceptor_.local_endpoint(ignored).address().is_loopback();
}

void Listener::set_tls(std::shared_ptr<TlsContext> tls) {
  asio::post(strand_, [this, fresh = std::move(tls)]() mutable { tls_ = std::move(fresh); });
}

asio::awaitable<void> Listener::run() {
  co_await accept_loop();
  co_await drain();
}

asio::awaitable<void> Listener::accept_loop() {
  while (!shutting_down_) {
    auto [error, socket] = co_await acceptor_.async_accept(asio::make_strand(io_), kAwait);
    if (shutting_down_) break;
    if (!error) {
      admit(std::move(socket));
      continue;
    }
    log(LogLevel::Warning, "a connection was not accepted: " + error.message());
    asio::steady_timer pause(strand_, kAcceptPause);
    co_await pause.async_wait(kAwait);
  }
}

void Listener::admit(Socket socket) {
  const std::string address = counted_address(socket);
  const bool is_full = clients_.size() >= limits_.connections;
  const auto known = connections_of_.find(address);
  if (is_full || (known != connections_of_.end() && known->second >= limits_.connections_per_address)) {
    ++services_.counters.connections_refused;
    return turn_away(std::move(socket),
                     is_full ? "the server is at its limit of connections"
                             : "the server is at its limit of connections from one address",
                     tls_ == nullptr);
  }
  const asio::any_io_executor executor = socket.get_executor();
  auto stream = tls_ ? make_tls_stream(std::move(socket), tls_) : make_tcp_stream(std::move(socket));
  auto session = std::make_shared<Session>(std::move(stream), services_, limits_.session);
  ++connections_of_[address];
  clients_.push_back({executor, std::move(session), address});
  const auto client = std::prev(clients_.end());
  auto on_end = [this, client](std::exception_ptr thrown) {
    if (thrown) {
      log_exception(*client->session, thrown);
    } else {
      log_end(*client->session);
    }
    asio::post(strand_, [this, client] { ended(client); });
  };
  asio::co_spawn(executor, client->session->run(), std::move(on_end));
}

void Listener::ended(std::list<Client>::iterator client) {
  const auto counted = connections_of_.find(client->address);
  if (--counted->second == 0) connections_of_.erase(counted);
  clients_.erase(client);
  changed_.notify();
}

/// Each on its own strand, which it may reach after its session has ended.
void Listener::tell_all(void (Session::*what)()) {
  for (const Client& client : clients_) {
    asio::post(client.executor, [session = client.session, what] { ((*session).*what)(); });
  }
}

asio::awaitable<void> Listener::drain() {
  using namespace asio::experimental::awaitable_operators;
  tell_all(&Session::shut_down);
  grace_.expires_after(limits_.shutdown_grace);
  auto gone = all_gone();
  auto grace_over = grace_.expired();
  co_await (std::move(gone) || std::move(grace_over));
  if (!clients_.empty())
    log(LogLevel::Warning, "cutting off " + std::to_string(clients_.size()) + " connections");
  tell_all(&Session::abort);
  co_await all_gone();
}

asio::awaitable<void> Listener::all_gone() {
  while (!clients_.empty()) co_await changed_.wait();
}

void Listener::shut_down() {
  asio::post(strand_, [this] {
    if (shutting_down_) grace_.expires_after({});
    shutting_down_ = true;
    error_code ignored;
    acceptor_.close(ignored);
  });
}

}  // namespace selvage
