// SPDX-License-Identifier: MIT
#include "client/session/credit_window.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace selvage {

bool CreditWindow::receive(std::uint64_t bytes) {
  if (bytes > outstanding_) return false;
  outstanding_ -= bytes;
  return true;
}

std::uint32_t CreditWindow::take_grant() {
  const std::uint64_t used = outstanding_ + held_;
  const std::uint64_t due = used < size_ ? size_ - used : 0;
  if (due < size_ / 4 || due == 0) return 0;
  const std::uint64_t granted = std::min<std::uint64_t>(due, std::numeric_limits<std::uint32_t>::max());
  outstanding_ += granted;
  return static_cast<std::uint32_t>(granted);
}

void ConsumedBytes::add(std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  bytes_ += bytes;
  if (told_ || !tell_) return;
  told_ = true;
  tell_();
}

std::uint64_t ConsumedBytes::take() {
  const std::lock_guard lock(mutex_);
  told_ = false;
  return std::exchange(bytes_, 0);
}

void ConsumedBytes::close() {
  const std::lock_guard lock(mutex_);
  tell_ = nullptr;
}

Receipt& Receipt::operator=(Receipt&& other) noexcept {
  release();
  consumed_ = std::move(other.consumed_);
  bytes_ = other.bytes_;
  return *this;
}

void Receipt::release() {
  if (const auto consumed = std::exchange(consumed_, nullptr)) consumed->add(bytes_);
}

}  // namespace selvage
