// SPDX-License-Identifier: MIT
#include "bench/serve/destination.h"

#include <chrono>
#include <stdexcept>

#include "common/net/tls.h"

namespace selvage::bench {

asio::awaitable<std::unique_ptr<ByteStream>> connect(Destination to) {
  Result<asio::ip::tcp::socket> socket =
      co_await connect_socket(to.address.host, to.address.port, std::chrono::seconds(10));
  if (!socket) throw std::runtime_error(socket.error().message);
  if (!to.ca) co_return make_tcp_stream(std::move(*socket));
  co_return make_tls_stream(std::move(*socket), tls_client_context(*to.ca).value(), to.address.host);
}

}  // namespace selvage::bench
