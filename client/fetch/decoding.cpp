// SPDX-License-Identifier: MIT
#include "client/fetch/decoding.h"

#include <utility>

namespace selvage {
namespace {

/// About a thousand regions: enough that no core waits for the next, little beside the decoded mesh.
constexpr std::uint64_t kMaxQueuedBytes = 4u << 20;

}  // namespace

Decoding::Decoding(PartCollector& collector, unsigned threads, OnDecoded on_decoded)
    : collector_(collector), on_decoded_(std::move(on_decoded)), tasks_(threads) {}

Result<void> Decoding::add(ReceivedPart part) {
  if (auto ok = failure(); !ok) return ok;
  if (queued_bytes_ > kMaxQueuedBytes) {
    decode(part);
    return failure();
  }
  const auto queued = std::make_shared<ReceivedPart>(std::move(part));
  queued_bytes_ += queued->bytes.size();
  tasks_.run([this, queued] {
    decode(*queued);
    queued_bytes_ -= queued->bytes.size();
  });
  return {};
}

void Decoding::decode(const ReceivedPart& part) {
  if (is_over_) return;
  auto outcome = collector_.add(part.id, part.bytes);
  if (outcome) return on_decoded_(part.id);
  const std::scoped_lock lock(mutex_);
  if (!failure_) failure_ = std::move(outcome.error());
  is_over_ = true;
}

Result<void> Decoding::finish() {
  tasks_.wait();
  return failure();
}

Result<void> Decoding::failure() const {
  const std::scoped_lock lock(mutex_);
  if (failure_) return tl::unexpected(*failure_);
  return {};
}

}  // namespace selvage
