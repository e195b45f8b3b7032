// SPDX-License-Identifier: MIT
//
// Accepts connections and keeps a Session for each until it ends.
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/strand.hpp>

#include "common/net/deadline.h"
#include "common/net/signal.h"
#include "common/net/tcp_stream.h"
#include "common/net/tls.h"
#include "server/session/limits.h"
#include "server/session/session.h"

namespace selvage {

/// `io` may be run by several threads: each session has a strand of its own, and what all share is behind the
/// listener's. What `services` names outlives it, and it outlives the run of `io`.
class Listener {
 public:
  /// Unavailable or InvalidArgument if that address cannot be listened on; port 0 picks a free one. Without
  /// `tls` connections are plain.
  static Result<std::unique_ptr<Listener>> bind(asio::io_context& io, const HostPort& address,
                                                const SessionServices& services, const ServerLimits& limits,
                                                std::shared_ptr<TlsContext> tls = nullptr);

  /// TCP's, of the connections to come; by default the system's.
  Result<void> use_congestion_control(const std::string& name);

  HostPort address() const;     ///< with the port that was picked
  bool is_on_loopback() const;  ///< only this machine can connect

  /// For the connections to come. From any thread.
  void set_tls(std::shared_ptr<TlsContext> tls);

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
    std::string address;  ///< as counted
  };

  Listener(asio::io_context& io, const SessionServices& services, const ServerLimits& limits,
           std::shared_ptr<TlsContext> tls);
  asio::awaitable<void> accept_loop();
  asio::awaitable<void> drain();
  asio::awaitable<void> all_gone();
  void admit(Socket socket);
  void ended(std::list<Client>::iterator client);
  void tell_all(void (Session::*what)());

  asio::io_context& io_;
  const SessionServices services_;
  const ServerLimits limits_;

  Strand strand_;  ///< guards all below
  asio::ip::tcp::acceptor acceptor_;
  std::shared_ptr<TlsContext> tls_;
  std::list<Client> clients_;
  std::map<std::string, std::uint32_t> connections_of_;  ///< by address
  Signal changed_;                                       ///< a client left, or shut_down() was called
  Deadline grace_;
  bool shutting_down_ = false;
};

}  // namespace selvage
