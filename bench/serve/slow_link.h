// SPDX-License-Identifier: MIT
//
// A slow link between two networks that exist for the benchmark alone: a namespace for the servers, one for
// the clients, and between them a pair of TUN devices whose packets this process carries, late and one at a
// time. Nothing else on the machine sees or feels it. Needs Linux, `ip`, and root or user namespaces.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>

namespace selvage::bench {

/// The same both ways. Congestion control is said to the kernel by route, so nothing of it is left to chance.
struct LinkShape {
  double bits_per_second = 20e6;
  std::chrono::milliseconds round_trip{50};
  std::chrono::milliseconds queue{100};  ///< that the bottleneck holds at most; more is dropped
  std::string congestion_control = "bbr";
};

class SlowLink {
 public:
  static constexpr const char* kServerAddress = "10.77.0.1";

  /// The calling thread, and what it starts from here on, is in the servers' network. Must be the only thread
  /// if the process is not root. Throws std::runtime_error.
  explicit SlowLink(const LinkShape& shape);
  ~SlowLink();
  SlowLink(const SlowLink&) = delete;
  SlowLink& operator=(const SlowLink&) = delete;

  /// From here on the calling thread is in the clients' network.
  void enter_clients_side() const;

  const LinkShape& shape() const { return shape_; }
  /// What the link carries in one round trip.
  double bytes_per_round_trip() const;

 private:
  void carry();

  const LinkShape shape_;
  int clients_side_ = -1;  ///< network namespace
  int server_device_ = -1, client_device_ = -1;
  std::atomic<bool> stopping_ = false;
  std::thread carrier_;
};

}  // namespace selvage::bench
