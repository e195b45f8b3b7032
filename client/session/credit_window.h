// SPDX-License-Identifier: MIT
//
// How much a server may send before it must wait for us: the client's half of flow control.
//
// A part's bytes come back to the server as credit when they arrive, so that a large part can always be
// completed, whatever else is half there; but whole parts that wait for the consumer are held against the
// window, and while they fill it nothing is granted. So memory stays below twice the window and one part for
// each request in flight, and a consumer that stops costs the server nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>

namespace selvage {

/// Single-strand arithmetic.
class CreditWindow {
 public:
  /// `size` is granted to begin with, by the Hello.
  explicit CreditWindow(std::uint64_t size) : size_(size), outstanding_(size) {}

  /// Data arrived. False: the server sent more than it was granted.
  [[nodiscard]] bool receive(std::uint64_t bytes);
  void hold(std::uint64_t bytes) { held_ += bytes; }
  void release(std::uint64_t bytes) { held_ -= bytes; }

  /// What to grant now, and counts it as granted: nothing until a quarter of the window is due, so that
  /// Credit frames stay rare.
  std::uint32_t take_grant();

 private:
  std::uint64_t size_;
  std::uint64_t outstanding_;  ///< granted, not yet arrived
  std::uint64_t held_ = 0;     ///< in whole parts that nobody has consumed
};

/// Collects, from any thread, the bytes that consumers are done with, and tells the session about them.
class ConsumedBytes {
 public:
  /// `tell` is called from the thread that consumes, once until the next take(); it must not block.
  explicit ConsumedBytes(std::function<void()> tell) : tell_(std::move(tell)) {}

  void add(std::uint64_t bytes);
  std::uint64_t take();
  void close();  ///< `tell` is never called again

 private:
  std::mutex mutex_;
  std::function<void()> tell_;
  std::uint64_t bytes_ = 0;
  bool told_ = false;
};

/// Goes with a received part: as long as it lives, the part counts as not consumed. May go on any thread,
/// and after its session.
class Receipt {
 public:
  Receipt() = default;
  Receipt(std::shared_ptr<ConsumedBytes> consumed, std::uint64_t bytes)
      : consumed_(std::move(consumed)), bytes_(bytes) {}
  Receipt(Receipt&&) noexcept = default;
  Receipt& operator=(Receipt&& other) noexcept;
  ~Receipt() { release(); }

  void release();

 private:
  std::shared_ptr<ConsumedBytes> consumed_;
  std::uint64_t bytes_ = 0;
};

}  // namespace selvage
