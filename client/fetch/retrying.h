// SPDX-License-Identifier: MIT
//
// The one way in which this client tries again: pauses that grow, a limit to its patience, a stop that ends a
// pause at once.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <stop_token>

#include "client/fetch/backoff.h"
#include "common/base/result.h"

namespace selvage {

/// Whether the same may succeed later, without anybody changing anything.
bool may_pass(const Error& error);

/// Waits between tries, and knows when to give up.
///
///     Retrying retrying(policy);
///     for (;;) {
///       auto outcome = attempt([&] { retrying.note_progress(); });
///       if (outcome || !retrying.try_again(outcome.error(), stop)) return outcome;
///     }
class Retrying {
 public:
  /// Told of every failure that is not the last word, and how long the pause will be.
  using OnRetry = std::function<void(const Error&, std::chrono::milliseconds)>;

  explicit Retrying(const RetryPolicy& policy, OnRetry on_retry = {});

  /// Something got through: the next failure is a first one.
  void note_progress();

  /// Waits. False, soon, if this error is the last word: it will not pass, patience is at an end, or `stop`
  /// was requested.
  bool try_again(const Error& error, const std::stop_token& stop);

 private:
  RetryPolicy policy_;
  OnRetry on_retry_;
  Backoff backoff_;
  std::optional<std::chrono::steady_clock::time_point> failing_since_;
};

}  // namespace selvage
