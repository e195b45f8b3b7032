// SPDX-License-Identifier: MIT
//
// Connections that said hello and then nothing: what does each cost the server?
#pragma once

#include "bench/serve/destination.h"
#include "bench/serve/process.h"

namespace selvage::bench {

struct IdleCost {
  unsigned connections = 0;
  unsigned answered = 0;  ///< a ping each, after all were there
  double bytes_each = 0;  ///< of the server's own memory
};
/// `server` listens at `to`. Throws when it does not take them all.
IdleCost hold_idle(const Process& server, const Destination& to, unsigned connections);

}  // namespace selvage::bench
