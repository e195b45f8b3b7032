// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SELVAGE_THREAD_SANITIZER
#endif
#endif
#if defined(__SANITIZE_THREAD__)
#define SELVAGE_THREAD_SANITIZER
#endif

namespace selvage {

/// What threads did before give(), others see after take(). TBB orders its tasks and their callers so itself;
/// but where it was not built for ThreadSanitizer, as Debian's is not, that sees it only here. Nothing in all
/// other builds.
class Handover {
 public:
#ifdef SELVAGE_THREAD_SANITIZER
  void give() { order_.fetch_add(1, std::memory_order_release); }
  void take() { (void)order_.load(std::memory_order_acquire); }

 private:
  std::atomic<unsigned> order_ = 0;
#else
  void give() {}
  void take() {}
#endif
};

}  // namespace selvage
