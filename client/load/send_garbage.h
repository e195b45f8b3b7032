// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "common/net/tcp_stream.h"

namespace selvage {

/// Connects, sends so many bytes of nonsense, half of the time behind a proper greeting, and waits for the
/// server to hang up. Timeout if it does not.
asio::awaitable<Result<void>> send_garbage(HostPort server, std::uint64_t size, std::uint32_t seed);

}  // namespace selvage
