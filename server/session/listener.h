// SPDX-License-Identifier: MIT
//
// Accepts connections and keeps a Session for each until it ends.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/strand.hpp>

#include "common/net/deadline.h"
#include "common/net/signal.h"
#include "common/net/tcp_stream.h"
#include "server/session/limits.h"
#include "server/session/session.h"
#include "server/store/pack_store.h"

namespace selvage {

/// `io` may be run by several threads: each session has a strand of its own, and what all share is behind the
/// listener's. `store` and `workers` outlive it, and it outlives the run of `io`.
class Listener {
 public:
  /// Unavailable or InvalidArgument if that address cannot be listened on; port 0 picks a free one.
  static Result<std::unique_ptr<Listener>> bind(asio::io_context& io, const HostPort& address,
                                                PackStore& store, asio::any_io_executor workers,
                                                const ServerLimits& limits);

  HostPort address() const;  ///< with the port that was picked

  /// Accepts until shut down, then lets sessions finish within the grace and cuts off the rest. Returns when
  /// none is left. Spawn it on executor().
  asio::awaitable<void> run();

  asio::any_io_executor executor() { return strand_; }

  /// Ends run(). From any thread; a second call cuts off the grace.
  void shut_down();

 private:
  using Strand = asio::strand<asio::io_context::executor_type>;
  using Socket = asio::ip::tcp::socket;
  struct Client {
    asio::any_io_executor executor;  ///< the session's strand
    std::shared_ptr<Session> session;
  };

  Listener(asio::io_context& io, PackStore& store, asio::any_io_executor workers, const ServerLimits& limits);
  asio::awaitable<void> accept_loop();
  asio::awaitable<void> drain();
  asio::awaitable<void> all_gone();
  void admit(Socket socket);
  void ended(std::list<Client>::iterator client);
  void tell_all(void (Session::*what)());

  asio::io_context& io_;
  PackStore& store_;
  asio::any_io_executor workers_;
  const ServerLimits limits_;

  Strand strand_;  ///< guards all below
  asio::ip::tcp::acceptor acceptor_;
  std::list<Client> clients_;
  Signal changed_;  ///< a client left, or shut_down() was called
  Deadline grace_;
  bool shutting_down_ = false;
};

}  // namespace selvage
