// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>

namespace selvage {

/// One line on stderr that is rewritten in place while a tool works: "encode  43 %". Shown only on a
/// terminal, at most ten times a second; silent in a pipe or a log. The destructor wipes it.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const std::string& text);
  void show_now(const std::string& text);  ///< however little time has passed
  void wipe();

 private:
  bool is_terminal_;
  bool is_shown_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace selvage
