// SPDX-License-Identifier: MIT
//
// What steering a download takes on a slow link, frame by frame: how long until the first byte of a region,
// how much still comes after a cancel, how late a ping is answered beside a saturating download.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/serve/destination.h"

namespace selvage::bench {

/// Seconds from the established connection until the first bytes of a region are there (as many as one frame
/// holds), where hello, open and get travel in one flight; over TLS the handshake counts.
double first_region_seconds(const Destination& to, const std::string& model);

struct CancelCost {
  std::uint64_t bytes = 0;  ///< received between the Cancel and the answer to it, everything counted
  double seconds = 0;       ///< between them
};
/// Cancels a get of all of a large model, `after` seconds into it.
CancelCost cancel_cost(const Destination& to, const std::string& model, double after);

struct LinkPings {
  std::vector<double> seconds;  ///< ascending
  double bytes_per_second = 0;  ///< of the download beside them
};
/// One ping at a time, on the connection that a get of a large model saturates.
LinkPings pings_beside_bulk(const Destination& to, const std::string& model, double seconds);

}  // namespace selvage::bench
