// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "common/net/tcp_stream.h"

namespace selvage::bench {

/// A server to talk to, and whom to trust if it encrypts.
struct Destination {
  HostPort address;
  std::optional<std::filesystem::path> ca;
};

/// Over TCP, before the stream's own handshake. Throws when nobody is there.
asio::awaitable<std::unique_ptr<ByteStream>> connect(Destination to);

}  // namespace selvage::bench
