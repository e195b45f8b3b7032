// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace selvage {

class ByteStream;

/// Whom to believe about who a server is.
struct TlsTrust {
  std::filesystem::path ca;  ///< PEM file of authorities; empty: the system's
};

/// How a client speaks to a server.
struct ClientOptions {
  std::string software = "selvage";
  std::string token;                           ///< sent in the Hello; empty: none
  std::optional<TlsTrust> tls = std::nullopt;  ///< absent: plain TCP
  bool allow_plain =
      false;  ///< send a token over plain TCP even to other machines, where it can be overheard
  std::chrono::milliseconds connect_timeout{10'000};  ///< for the connection, and again for the greeting
  /// False: the first requests go out with the greeting, without waiting for the server's. What it has
  /// against the greeting is then their error.
  bool await_greeting = true;
  std::chrono::milliseconds silence_timeout{30'000};  ///< a server that says nothing for so long is gone
  std::uint64_t window_bytes = 8u << 20;              ///< see credit_window.h; at least kMinInitialCredit
  std::uint64_t max_directory_bytes = 512u << 20;
  std::size_t read_bytes = 256u << 10;  ///< that one read may bring; each connection has room for so many
  bool check_hashes = true;             ///< false only for load tests
  /// Puts something between a connection that was made and the session; empty: nothing. For load tests.
  std::function<std::unique_ptr<ByteStream>(std::unique_ptr<ByteStream>)> wrap_stream = {};
};

}  // namespace selvage
