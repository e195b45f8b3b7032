// SPDX-License-Identifier: MIT
//
// A server under test: started, accounted by the operating system, stopped.
#pragma once

#include <cstdint>
#include <string>
#include <sys/types.h>
#include <vector>

namespace selvage::bench {

class Process {
 public:
  /// `output`: where its stdout and stderr go. Throws std::runtime_error if it cannot be started.
  Process(const std::vector<std::string>& command, const std::string& output);
  ~Process();  ///< SIGTERM, then SIGKILL
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Of all its threads so far, user and system, from /proc/PID/task/*/schedstat.
  double cpu_seconds() const;
  /// Memory that is its own: RssAnon of /proc/PID/status.
  std::uint64_t anonymous_bytes() const;
  bool is_running() const;

 private:
  pid_t pid_ = -1;
};

}  // namespace selvage::bench
