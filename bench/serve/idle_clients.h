// SPDX-License-Identifier: MIT
//
// Connections that said hello and then nothing: what does each cost the server?
#pragma once

#include <cstdint>

#include "bench/serve/peers.h"

namespace selvage::bench {

struct IdleCost {
  unsigned connections = 0;
  unsigned answered = 0;  ///< a ping each, after all were there
  double bytes_each = 0;  ///< of the server's own memory
};
IdleCost hold_idle(const Peer& selvage, unsigned connections);

struct PingTimes {
  std::size_t pings = 0;
  double median = 0, p99 = 0, worst = 0;  ///< seconds
  double bulk_bytes_per_second = 0;
};
/// Pings on a connection whose own answer, of all of a model again and again, saturates it; `others`
/// connections do the same meanwhile.
PingTimes ping_under_bulk(const Peer& selvage, const std::string& model, unsigned others, double seconds);

}  // namespace selvage::bench
