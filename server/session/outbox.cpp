// SPDX-License-Identifier: MIT
#include "server/session/outbox.h"

#include <algorithm>

namespace selvage {

// ---- Batch
// ---------------------------------------------------------------------------------------------------

void Batch::clear() {
  buffer_.clear();
  runs_.clear();
  kept_.clear();
  size_bytes_ = 0;
}

/// What was appended to buffer_ from `start` on is next.
void Batch::add_buffered(std::size_t start) {
  const std::size_t size = buffer_.size() - start;
  size_bytes_ += size;
  const bool continues = !runs_.empty() && runs_.back().outside == nullptr;
  if (continues) {
    runs_.back().size += size;
  } else {
    runs_.push_back({nullptr, start, size, false});
  }
}

void Batch::add_bytes(std::span<const std::byte> bytes) {
  const std::size_t start = buffer_.size();
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  add_buffered(start);
}

void Batch::add_data(const FrameHeader& header, const Piece& payload) {
  const std::size_t start = buffer_.size();
  buffer_.resize(start + kFrameHeaderSize);
  write_header(header, HeaderBytes(&buffer_[start], kFrameHeaderSize));
  add_buffered(start);
  if (payload.bytes.size() <= Outbox::kCopiedData) return add_bytes(payload.bytes);
  runs_.push_back({payload.bytes.data(), 0, payload.bytes.size(), payload.is_mapped});
  size_bytes_ += payload.bytes.size();
}

void Batch::keep(const std::shared_ptr<const Pack>& pack) {
  if (kept_.empty() || kept_.back() != pack) kept_.push_back(pack);
}

const Pieces& Batch::pieces(std::size_t written) {
  pieces_.clear();
  for (const Run& run : runs_) {
    const std::byte* bytes = run.outside ? run.outside : &buffer_[run.start];
    const std::size_t gone = std::min(written, run.size);
    written -= gone;
    if (gone < run.size) pieces_.emplace_back(std::span(bytes, run.size).subspan(gone), run.is_mapped);
  }
  return pieces_;
}

// ---- Outbox
// --------------------------------------------------------------------------------------------------

void Outbox::push_control(std::vector<std::byte> frame) {
  control_bytes_ += frame.size();
  control_.push_back(std::move(frame));
}

Result<void> Outbox::push_answer(Answer answer) {
  if (find(answer.request_id) != answers_.end()) {
    return fail(ErrorCode::InvalidArgument,
                "request id " + std::to_string(answer.request_id) + " is still being answered");
  }
  if (answers_.size() >= max_answers_) {
    return fail(ErrorCode::LimitExceeded,
                "more than " + std::to_string(max_answers_) + " requests in flight; wait for one to end");
  }
  if (answer.items.size() > max_parts_ - queued_parts_) {
    return fail(ErrorCode::LimitExceeded,
                "more than " + std::to_string(max_parts_) + " parts queued; ask for fewer at a time");
  }
  queued_parts_ += answer.items.size();
  Sending sending;
  sending.sums.held = answer.held;
  sending.answer = std::move(answer);
  answers_.push_back(std::move(sending));
  return {};
}

Outbox::Answers::iterator Outbox::find(std::uint32_t request_id) {
  return std::ranges::find_if(
      answers_, [&](const Sending& sending) { return sending.answer.request_id == request_id; });
}

void Outbox::reprioritise(std::uint32_t request_id, std::uint8_t urgency) {
  const auto found = find(request_id);
  if (found != answers_.end()) found->answer.urgency = urgency;
}

bool Outbox::cancel(std::uint32_t request_id) {
  const auto found = find(request_id);
  if (found == answers_.end()) return false;
  queued_parts_ -= found->answer.items.size();
  answers_.erase(found);
  return true;
}

std::uint32_t Outbox::drop_damaged() {
  const auto found = std::ranges::find_if(
      answers_, [](const Sending& sending) { return sending.answer.pack->is_damaged(); });
  if (found == answers_.end()) return 0;
  const std::uint32_t request_id = found->answer.request_id;
  cancel(request_id);
  return request_id;
}

Result<void> Outbox::grant(std::uint64_t bytes) {
  if (bytes > kMaxCredit - credit_) return fail(ErrorCode::Protocol, "more credit than a window can hold");
  credit_ += bytes;
  return {};
}

void Outbox::take(Batch& batch, std::size_t quantum) {
  batch.clear();
  quantum_ = quantum;
  take_control(batch);
  take_answers(batch);
}

void Outbox::take_answers(Batch& batch) {
  while (!answers_.empty()) {
    const std::size_t before = batch.size_bytes();
    const auto next =
        std::ranges::min_element(answers_, {}, [](const Sending& sending) { return sending.answer.urgency; });
    if (!take_from(*next, batch)) {
      // Whoever had nothing, for want of credit, keeps the turn: a large chunk is not starved by small ones.
      if (batch.size_bytes() > before) answers_.splice(answers_.end(), answers_, next);
      return;
    }
    queued_parts_ -= next->answer.items.size();
    answers_.erase(next);
  }
}

void Outbox::take_control(Batch& batch) {
  for (; !control_.empty() && batch.size_bytes() < kControlShare; control_.pop_front()) {
    control_bytes_ -= control_.front().size();
    batch.add_bytes(control_.front());
  }
}

/// True when the answer is complete; false when the batch is full or credit is out.
bool Outbox::take_from(Sending& sending, Batch& batch) {
  batch.keep(sending.answer.pack);
  if (sending.answer.manifest && !send_manifest(sending, batch)) return false;
  while (sending.next < sending.answer.items.size()) {
    if (!send_item(sending, batch)) return false;
  }
  batch.add(sending.sums, sending.answer.request_id, sending.seq++);
  return true;
}

/// How much of something with `left` bytes to go may be sent now: 0, or enough to be worth a frame.
std::uint64_t Outbox::chunk(std::uint64_t left, const Batch& batch) const {
  const std::uint64_t room = quantum_ - std::min(quantum_, batch.size_bytes());
  const std::uint64_t size = std::min({left, room, credit_, std::uint64_t{kMaxDataPayload}});
  return size < std::min<std::uint64_t>(left, kMinChunk) ? 0 : size;
}

/// Sends on from sending.at; true when all of `bytes` is out.
bool Outbox::send_bytes(Sending& sending, std::span<const std::byte> bytes, Batch& batch) {
  while (sending.at < bytes.size()) {
    const std::uint64_t size = chunk(bytes.size() - sending.at, batch);
    if (size == 0) return false;
    const bool ends = sending.at + size == bytes.size();
    const FrameHeader header{static_cast<std::uint32_t>(size), FrameType::Data,
                             ends ? kFlagEnd : std::uint8_t{0}, sending.answer.request_id, sending.seq++};
    batch.add_data(header, Piece(bytes.subspan(sending.at, size), sending.answer.pack->is_mapped()));
    credit_ -= size;
    sending.at += size;
    sending.sums.bytes += size;
  }
  return true;
}

bool Outbox::send_manifest(Sending& sending, Batch& batch) {
  const auto bytes = sending.answer.pack->directory_bytes().first(sending.answer.manifest->data_size);
  if (!sending.introduced) batch.add(*sending.answer.manifest, sending.answer.request_id, sending.seq++);
  sending.introduced = true;
  if (!send_bytes(sending, bytes, batch)) return false;
  sending.answer.manifest.reset();
  sending.introduced = false;
  return true;
}

bool Outbox::send_item(Sending& sending, Batch& batch) {
  const SendItem& item = sending.answer.items[sending.next];
  if (!sending.introduced) {
    // Not before its bytes may follow: a PartBegin without data would only stand in a cancel's way.
    if (chunk(item.ref->size - item.offset, batch) == 0) return false;
    const PartBegin begin{item.id, item.ref->size, item.offset, item.ref->hash};
    batch.add(begin, sending.answer.request_id, sending.seq++);
    sending.at = item.offset;
    sending.introduced = true;
  }
  if (!send_bytes(sending, sending.answer.pack->part(*item.ref), batch)) return false;
  ++sending.sums.parts;
  ++sending.next;
  sending.introduced = false;
  return true;
}

}  // namespace selvage
