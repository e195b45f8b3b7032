// SPDX-License-Identifier: MIT
#include "client/fetch/retrying.h"

#include <condition_variable>
#include <mutex>
#include <random>
#include <utility>

namespace selvage {
namespace {

/// False if `stop` came first.
bool sleep_for(std::chrono::milliseconds time, const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any wakes;
  std::unique_lock lock(mutex);
  wakes.wait_for(lock, stop, time, [] { return false; });
  return !stop.stop_requested();
}

}  // namespace

bool may_pass(const Error& error) {
  return error.code == ErrorCode::Io || error.code == ErrorCode::Unavailable ||
         error.code == ErrorCode::Timeout;
}

Retrying::Retrying(const RetryPolicy& policy, OnRetry on_retry)
    : policy_(policy), on_retry_(std::move(on_retry)), backoff_(policy, std::random_device()()) {}

void Retrying::note_progress() {
  failing_since_.reset();
  backoff_.reset();
}

bool Retrying::try_again(const Error& error, const std::stop_token& stop) {
  if (!may_pass(error) || stop.stop_requested()) return false;
  const auto now = std::chrono::steady_clock::now();
  if (!failing_since_) failing_since_ = now;
  const std::chrono::milliseconds delay = backoff_.next();
  if (now - *failing_since_ + delay > policy_.give_up_after) return false;
  if (on_retry_) on_retry_(error, delay);
  return sleep_for(delay, stop);
}

}  // namespace selvage
