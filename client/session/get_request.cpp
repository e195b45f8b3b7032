// SPDX-License-Identifier: MIT
#include "client/session/get_request.h"

#include <utility>

namespace selvage {

void UrgencyDial::turn(std::uint8_t urgency) {
  const std::scoped_lock lock(mutex_);
  urgency_ = urgency;
  if (listener_) listener_(urgency);
}

std::uint8_t UrgencyDial::urgency() const {
  const std::scoped_lock lock(mutex_);
  return urgency_;
}

void UrgencyDial::listen(Listener listener) {
  const std::scoped_lock lock(mutex_);
  listener_ = std::move(listener);
}

}  // namespace selvage
