// SPDX-License-Identifier: MIT
//
// A session's sending: from the outbox to the stream, at the stream's pace and within the client's rate.
#include <algorithm>
#include <utility>

#include <boost/asio/co_spawn.hpp>

#include "server/session/session.h"

namespace selvage {
namespace {

/// So long a client that has been sent everything may take to leave.
constexpr std::chrono::seconds kFarewell{1};

}  // namespace

void Session::send_error(const Error& error, std::uint32_t request_id) {
  services_.counters.count_error(error.code);
  note("error", request_id, {{"code", std::string(to_string(error.code))}, {"message", error.message}});
  send(ErrorMessage{error, is_retryable(error.code)}, request_id);
}

void Session::send_answer(Answer answer) {
  const std::uint32_t request_id = answer.request_id;
  const Result<void> queued = draining_
                                  ? Result<void>(fail(ErrorCode::Unavailable, "the server is shutting down"))
                                  : outbox_.push_answer(std::move(answer));
  if (!queued) send_error(queued.error(), request_id);
  wake_writer();
}

/// What is left of answers from packs that were overwritten since would be nonsense.
void Session::refuse_damaged() {
  for (std::uint32_t id = outbox_.drop_damaged(); id != 0; id = outbox_.drop_damaged()) {
    send_error(
        Error{ErrorCode::BadStream,
              "the model's pack was overwritten in place while it was served; packs are to be replaced by "
              "renaming"},
        id);
  }
}

/// Answers to what came together go together. Before waiting for anything the reader lets them go.
void Session::uncork() {
  corked_ = false;
  if (std::exchange(has_news_, false)) wake_writer();
}

/// There is a writer only while something waits to be written: an idle connection does without, and most
/// answers do too.
void Session::wake_writer() {
  if (corked_) {
    has_news_ = true;
  } else if (is_writing_) {
    rate_pause_.notify();
  } else if (!ended_ && !write_at_once()) {
    start_writer(Batch(), 0);
  }
}

/// As much as suits the stream and the client's rate.
void Session::take_next(Batch& batch) {
  const std::uint64_t allowed = rate_.available(RateLimit::Clock::now());
  outbox_.take(batch, std::min<std::uint64_t>(stream_->write_size(), allowed));
  rate_.spend(batch.size_bytes());
}

/// What the kernel takes without waiting needs no coroutine. False if a writer has still something to do.
bool Session::write_at_once() {
  if (closing_ || draining_ || outbox_.idle() || !stream_->may_write_at_once()) return false;
  thread_local Batch batch;
  is_writing_ = true;
  refuse_damaged();
  take_next(batch);
  const std::size_t written = stream_->write_at_once(batch.pieces());
  services_.counters.bytes_sent += written;
  is_writing_ = false;
  const bool is_whole = written == batch.size_bytes();
  if (!is_whole) start_writer(std::exchange(batch, Batch()), written);
  batch.clear();
  return !is_whole || outbox_.idle();
}

/// `batch` goes first, but for the bytes of it that are written.
void Session::start_writer(Batch batch, std::size_t written) {
  is_writing_ = true;
  ++writers_;
  auto on_end = [this](std::exception_ptr thrown) {
    --writers_;
    if (thrown) {
      is_writing_ = false;
      thrown_ = thrown;
      stream_->close();
    }
    writer_ended_.notify();
  };
  asio::co_spawn(stream_->executor(), write_loop(std::move(batch), written), std::move(on_end));
}

asio::awaitable<void> Session::write_loop(Batch batch, std::size_t written) {
  bool is_broken = false;
  if (!batch.empty()) {
    const Result<void> rest = co_await write(batch, written);
    is_broken = !rest;
  }
  while (!is_broken) {
    if (!outbox_.idle()) {
      set_deadline(write_by_, Deadline::Clock::now() + limits_.write_timeout);
      const Result<void> is_time = co_await stream_->wait_to_write();
      set_deadline(write_by_, kNever);
      is_broken = !is_time;
      if (is_broken) continue;
      refuse_damaged();
    }
    take_next(batch);
    if (!batch.empty()) {
      if (!outbox_.full()) wake_reader_.notify();
      const Result<void> all_written = co_await write(batch);
      is_broken = !all_written;
      continue;
    }
    const auto pause = rate_.wait_for(kBurst, RateLimit::Clock::now());
    if (outbox_.idle() || pause <= RateLimit::Clock::duration::zero()) break;
    co_await rate_pause_.wait_for(pause);
  }
  is_writing_ = false;
  const bool is_drained = draining_ && outbox_.idle() && !upload_;
  if (is_broken) {
    closing_ = true;
    stream_->close();  // which ends the reader
  } else if ((closing_ || is_drained) && !sent_all_) {
    sent_all_ = true;
    stream_->end_writing();
    set_deadline(read_by_, Deadline::Clock::now() + kFarewell);
  }
  if (closing_) wake_reader_.notify();
}

asio::awaitable<Result<void>> Session::write(Batch& batch, std::size_t written) {
  set_deadline(write_by_, Deadline::Clock::now() + limits_.write_timeout);
  Result<void> all_written = co_await stream_->write(batch.pieces(written));
  set_deadline(write_by_, kNever);
  if (all_written) services_.counters.bytes_sent += batch.size_bytes() - written;
  co_return all_written;
}

}  // namespace selvage
