// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>

#include "client/fetch/model.h"
#include "common/base/progress_line.h"

namespace selvage {

/// "[########............] 12 of 21 regions, 1.2 of 3.4 MB, 560 KB/s, 4 s left", at most `width` characters:
/// what does not fit is left out from the end. A rate of 0 is not known yet.
std::string progress_text(const FetchProgress& progress, double bytes_per_second, std::size_t width);

/// Shows on a terminal how a fetch goes; silent elsewhere.
class ProgressBar {
 public:
  void show(const FetchProgress& progress);
  void show_retry(const Error& error, std::chrono::milliseconds delay);
  void wipe() { line_.wipe(); }

 private:
  using Clock = std::chrono::steady_clock;

  ProgressLine line_;
  Clock::time_point measured_ = Clock::now();  ///< when the rate was last
  std::uint64_t measured_bytes_ = 0;
  double rate_ = 0;  ///< bytes a second, of about the last two seconds
};

}  // namespace selvage
