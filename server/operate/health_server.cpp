// SPDX-License-Identifier: MIT
#include "server/operate/health_server.h"

#include <thread>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>

#include "common/base/log.h"
#include "common/net/await.h"

namespace selvage {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using boost::system::error_code;
using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

constexpr std::chrono::seconds kPatience{5};
constexpr int kMaxConnections = 32;

Response answer(const Request& request, const HealthPages& pages) {
  Response response{http::status::ok, request.version()};
  response.set(http::field::content_type, "text/plain; charset=utf-8");
  const beast::string_view target = request.target().substr(0, request.target().find('?'));
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    response.result(http::status::method_not_allowed);
    response.set(http::field::allow, "GET, HEAD");
  } else if (target == "/metrics") {
    response.set(http::field::content_type, "text/plain; version=0.0.4; charset=utf-8");
    response.body() = pages.metrics();
  } else if (target == "/healthz") {
    response.body() = "ok\n";
  } else if (target == "/readyz") {
    const Result<void> ready = pages.readiness();
    if (!ready) response.result(http::status::service_unavailable);
    response.body() = ready ? "ready\n" : ready.error().to_string() + "\n";
  } else {
    response.result(http::status::not_found);
    response.body() = "/metrics, /healthz and /readyz are here\n";
  }
  response.keep_alive(request.keep_alive());
  response.content_length(response.body().size());
  if (request.method() == http::verb::head) response.body().clear();
  return response;
}

asio::awaitable<void> serve(tcp::socket socket, const HealthPages& pages,
                            [[maybe_unused]] std::shared_ptr<int> counted) {
  beast::tcp_stream stream(std::move(socket));
  beast::flat_buffer buffer(16 << 10);
  for (bool goes_on = true; goes_on;) {
    Request request;
    stream.expires_after(kPatience);
    auto [read_error, read_size] = co_await http::async_read(stream, buffer, request, kAwait);
    if (read_error) break;
    Response response = answer(request, pages);
    goes_on = response.keep_alive();
    http::serializer<false, http::string_body> serializer(response);
    stream.expires_after(kPatience);
    auto [write_error, written] = co_await http::async_write(stream, serializer, kAwait);
    if (write_error) break;
  }
  error_code ignored;
  stream.socket().shutdown(tcp::socket::shutdown_both, ignored);
}

}  // namespace

struct HealthServer::Impl {
  explicit Impl(HealthPages given) : pages(std::move(given)) {}

  asio::awaitable<void> accept_loop() {
    // Copies of it are held by connections, so its use count says how many there are.
    const auto connections = std::make_shared<int>(0);
    for (;;) {
      auto [error, socket] = co_await acceptor.async_accept(io, kAwait);
      if (error == asio::error::operation_aborted) co_return;
      if (error) {
        asio::steady_timer pause(io, std::chrono::milliseconds(50));
        co_await pause.async_wait(kAwait);
      } else if (connections.use_count() <= kMaxConnections) {
        asio::co_spawn(io, serve(std::move(socket), pages, connections), asio::detached);
      }
    }
  }

  const HealthPages pages;
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  std::jthread thread;  ///< last: uses the rest
};

HealthServer::HealthServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

HealthServer::~HealthServer() { impl_->io.stop(); }

Result<std::unique_ptr<HealthServer>> HealthServer::start(const HostPort& address, HealthPages pages) {
  auto impl = std::make_unique<Impl>(std::move(pages));
  if (auto ok = listen_on(impl->acceptor, address); !ok) return forward_error(ok);
  asio::co_spawn(impl->io, impl->accept_loop(), asio::detached);
  impl->thread = std::jthread([&io = impl->io] { io.run(); });
  return std::unique_ptr<HealthServer>(new HealthServer(std::move(impl)));
}

HostPort HealthServer::address() const { return address_of(impl_->acceptor); }

}  // namespace selvage
