// SPDX-License-Identifier: MIT
#include "server/session/listener.h"

#include <csignal>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>

#include "common/base/log.h"
#include "common/net/await.h"

namespace selvage {
namespace {

using asio::ip::tcp;
using boost::system::error_code;

/// After an accept that failed for want of descriptors or memory: others must end first.
constexpr std::chrono::milliseconds kAcceptPause{50};

/// Tells a client that there is no room. A few bytes always fit a fresh socket; whether they arrive is its
/// luck.
void turn_away(tcp::socket socket) {
  const Error error{ErrorCode::Unavailable, "the server is at its limit of connections"};
  const auto frame = to_frame(ErrorMessage{error, true}, 0);
  error_code ignored;
  socket.non_blocking(true, ignored);
  socket.write_some(asio::buffer(frame), ignored);
  socket.shutdown(tcp::socket::shutdown_send, ignored);
}

void log_end(const Session& session) {
  if (!session.reason()) return log(LogLevel::Debug, session.peer() + " left");
  log(LogLevel::Info, session.peer() + " dropped: " + session.reason()->to_string());
}

void log_exception(const std::string& peer, std::exception_ptr thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const std::exception& exception) {
    log(LogLevel::Error, peer + " dropped: " + exception.what());
  }
}

}  // namespace

Listener::Listener(asio::io_context& io, PackStore& store, asio::any_io_executor workers,
                   const ServerLimits& limits)
    : io_(io),
      store_(store),
      workers_(std::move(workers)),
      limits_(limits),
      strand_(asio::make_strand(io)),
      acceptor_(strand_),
      changed_(strand_),
      grace_(strand_) {}

Result<std::unique_ptr<Listener>> Listener::bind(asio::io_context& io, const HostPort& address,
                                                 PackStore& store, asio::any_io_executor workers,
                                                 const ServerLimits& limits) {
  std::signal(SIGPIPE, SIG_IGN);  // what is sent from files has no other way to say that the client has gone
  error_code error;
  tcp::resolver resolver(io);
  const auto found =
      resolver.resolve(address.host, std::to_string(address.port), tcp::resolver::passive, error);
  if (error) return fail(ErrorCode::InvalidArgument, "no such host: " + address.host);
  const tcp::endpoint endpoint = found.begin()->endpoint();

  std::unique_ptr<Listener> listener(new Listener(io, store, std::move(workers), limits));
  tcp::acceptor& acceptor = listener->acceptor_;
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(tcp::acceptor::max_listen_connections, error);
  if (error) {
    return fail(ErrorCode::Unavailable, "cannot listen on " + address.to_string() + ": " + error.message());
  }
  return listener;
}

HostPort Listener::address() const {
  error_code ignored;
  const tcp::endpoint local = acceptor_.local_endpoint(ignored);
  return {local.address().to_string(), local.port()};
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
  if (clients_.size() >= limits_.connections) return turn_away(std::move(socket));
  const asio::any_io_executor executor = socket.get_executor();
  auto session =
      std::make_shared<Session>(make_tcp_stream(std::move(socket)), store_, workers_, limits_.session);
  clients_.push_back({executor, std::move(session)});
  const auto client = std::prev(clients_.end());
  auto on_end = [this, client](std::exception_ptr thrown) {
    if (thrown) {
      log_exception(client->session->peer(), thrown);
    } else {
      log_end(*client->session);
    }
    asio::post(strand_, [this, client] { ended(client); });
  };
  asio::co_spawn(executor, client->session->run(), std::move(on_end));
}

void Listener::ended(std::list<Client>::iterator client) {
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
