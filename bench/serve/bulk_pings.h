// SPDX-License-Identifier: MIT
//
// How long a ping waits beside data that saturates its connection.
#pragma once

#include "bench/serve/peers.h"

namespace selvage::bench {

struct PingTimes {
  std::size_t pings = 0;
  double median = 0, p99 = 0, worst = 0;  ///< seconds
  double bulk_bytes_per_second = 0;
};
/// Pings on a connection whose own answer, of all of a model again and again, saturates it; `others`
/// connections do the same meanwhile.
PingTimes ping_under_bulk(const Peer& selvage, const std::string& model, unsigned others, double seconds);

}  // namespace selvage::bench
