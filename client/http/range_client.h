// SPDX-License-Identifier: MIT
//
// Byte ranges of one file on a web server. The only door to libcurl. Whatever the server says, memory and
// time stay bounded: an answer is cut off at the first header or byte that is not the range that was asked
// for.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "common/base/result.h"

namespace selvage {

struct HttpOptions {
  std::chrono::milliseconds connect_timeout{10'000};
  std::chrono::milliseconds silence_timeout{30'000};  ///< without a byte
  std::uint64_t max_directory_bytes = 512u << 20;
  std::uint64_t window_bytes = 8u << 20;  ///< of parts that wait to be decoded; beyond it nothing is read
  unsigned connections = 6;               ///< at a time
};

struct RangeRequest {
  std::uint64_t begin = 0, end = 0;  ///< not empty
  bool may_be_short = false;         ///< the file may end before `end`
  /// Called on the thread of fetch() with each piece that comes, in order. An error ends everything.
  std::function<Result<void>(std::span<const std::byte>)> on_bytes;
};

/// One thread at a time.
class RangeClient {
 public:
  RangeClient(std::string url, HttpOptions options);
  ~RangeClient();
  RangeClient(const RangeClient&) = delete;
  RangeClient& operator=(const RangeClient&) = delete;

  /// Runs the requests, a few side by side, in the order given; returns when all are complete or with the
  /// first error. NotFound, Unauthorised; Unsupported if the server does not serve ranges or encodes them;
  /// ModelChanged if the file is not the one of the first answer any more; BadStream for an answer that is
  /// not what it should be; Io, Unavailable, Timeout if it may be tried again; Cancelled.
  Result<void> fetch(std::vector<RangeRequest> requests, const std::stop_token& stop = {});

  /// Of the whole file, after the first answer.
  std::uint64_t file_size() const;

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace selvage
