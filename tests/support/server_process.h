// SPDX-License-Identifier: MIT
#pragma once

#include "common/net/tcp_stream.h"
#include "tests/support/child_process.h"

namespace selvage::testing {

/// A selvage-server as operators run it.
class ServerProcess : public ChildProcess {
 public:
  using ChildProcess::ChildProcess;

  /// Waits until it says where it listens; throws what it logged if it ends before.
  HostPort address() {
    if (address_.port != 0) return address_;
    const std::string said = read_line(), prefix = "listening on ";
    if (!said.starts_with(prefix)) throw std::runtime_error("the server does not start: " + log());
    address_ = parse_host_port(said.substr(prefix.size())).value();
    return address_;
  }

 private:
  HostPort address_;
};

}  // namespace selvage::testing
