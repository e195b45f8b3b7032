// SPDX-License-Identifier: MIT
//
// The publisher's half of a session: Publish, the Data that follows it, and what becomes of both. The reader
// writes each Data frame to the disk, on a worker, before it reads on, so an upload goes as fast as the disk.
#include <boost/asio/post.hpp>

#include "server/session/session.h"

namespace selvage {

/// What events from other threads find the session by, as long as it runs.
struct Session::Lifeline {
  Session* session;
};

Session::LifelineHold::LifelineHold(Session& session) : session_(session) {
  session_.lifeline_ = std::make_shared<Lifeline>(Lifeline{&session});
}
Session::LifelineHold::~LifelineHold() { session_.lifeline_.reset(); }

Result<void> Session::may_upload() const {
  if (services_.publishing == nullptr) {
    return fail(ErrorCode::Unsupported, "models cannot be published on this server");
  }
  if (draining_) return fail(ErrorCode::Unavailable, "the server is shutting down");
  if (upload_) return fail(ErrorCode::LimitExceeded, "one upload at a time on a connection");
  return {};
}

asio::awaitable<Result<void>> Session::publish(std::uint32_t request_id, Publish request) {
  note_model("publish", request_id, request.name);
  if (const Result<void> ok = may_upload(); !ok) {
    send_error(ok.error(), request_id);
    co_return Result<void>();
  }
  const std::uint64_t size = request.size_bytes;
  auto begin = [publishing = services_.publishing, request = std::move(request), who = access_.who] {
    return publishing->begin(request, who);
  };
  Result<std::shared_ptr<Upload>> upload = co_await on_workers(std::move(begin));
  if (!upload) {
    send_error(upload.error(), request_id);
    co_return Result<void>();
  }
  upload_ = std::make_unique<Uploading>();
  upload_->request_id = request_id;
  upload_->size = size;
  upload_->upload = std::move(*upload);
  last_upload_ = request_id;
  const std::uint64_t held = upload_->upload->held();
  outbox_.push_control(to_frame(PublishReady{held}, request_id, upload_->seq++));
  wake_writer();
  if (held == size) co_await submit_upload();
  co_return Result<void>();
}

/// Data of an upload that has failed may still be on its way: it is dropped.
asio::awaitable<Result<void>> Session::take_upload(Frame frame) {
  if (frame.header.request_id == 0 || frame.header.request_id != last_upload_) {
    co_return fail(ErrorCode::Protocol, "Data that belongs to no upload");
  }
  if (!upload_ || upload_->is_submitted) co_return Result<void>();
  if (frame.payload.empty() || frame.payload.size() > kMaxDataPayload) {
    co_return fail(ErrorCode::Protocol, "a Data frame of a wrong size");
  }
  const std::shared_ptr<Upload> upload = upload_->upload;
  const std::span<const std::byte> bytes = frame.payload;
  auto append = [upload, bytes] { return upload->append(bytes); };
  const Result<void> appended = co_await on_workers(std::move(append));
  if (!appended) {
    send_error(appended.error(), frame.header.request_id);
    upload_.reset();
    co_return Result<void>();
  }
  if (frame.ends()) co_await submit_upload();
  co_return Result<void>();
}

/// Events come from the thread that ingests, and find the session on its strand if it is still there.
PublishEvents Session::events_for(std::uint32_t request_id) {
  PublishEvents events;
  const std::weak_ptr<Lifeline> line = lifeline_;
  events.on_progress = [executor = stream_->executor(), line, request_id](const PublishProgress& progress) {
    asio::post(executor, [line, request_id, progress] {
      if (const auto alive = line.lock()) alive->session->tell_progress(request_id, progress);
    });
  };
  events.on_end = [executor = stream_->executor(), line, request_id](Result<Published> outcome) {
    asio::post(executor, [line, request_id, outcome = std::move(outcome)] {
      if (const auto alive = line.lock()) alive->session->end_upload(request_id, outcome);
    });
  };
  return events;
}

asio::awaitable<void> Session::submit_upload() {
  const std::uint32_t request_id = upload_->request_id;
  upload_->is_submitted = true;
  auto submit = [upload = upload_->upload, events = events_for(request_id)] {
    return upload->submit(events);
  };
  const Result<void> submitted = co_await on_workers(std::move(submit));
  if (!submitted) end_upload(request_id, tl::unexpected(submitted.error()));
}

/// Progress is news only: what finds no room is left out.
void Session::tell_progress(std::uint32_t request_id, const PublishProgress& progress) {
  if (!upload_ || upload_->request_id != request_id || outbox_.full()) return;
  outbox_.push_control(to_frame(progress, request_id, upload_->seq++));
  wake_writer();
}

void Session::end_upload(std::uint32_t request_id, const Result<Published>& outcome) {
  if (!upload_ || upload_->request_id != request_id) return;
  const std::uint32_t seq = upload_->seq;
  upload_.reset();
  if (!outcome) return send_error(outcome.error(), request_id);
  outbox_.push_control(to_frame(*outcome, request_id, seq));
  wake_writer();
}

bool Session::cancel_upload(std::uint32_t request_id) {
  if (!upload_ || upload_->request_id != request_id) return false;
  asio::post(services_.workers, [upload = upload_->upload] { upload->cancel(); });
  // One that is being worked on ends when the work has noticed.
  if (!upload_->is_submitted) end_upload(request_id, fail(ErrorCode::Cancelled, "cancelled"));
  return true;
}

asio::awaitable<Result<void>> Session::unpublish(std::uint32_t request_id, Unpublish request) {
  note_model("unpublish", request_id, request.name);
  if (services_.publishing == nullptr) {
    const Error error{ErrorCode::Unsupported, "models cannot be published on this server"};
    send_error(error, request_id);
    co_return Result<void>();
  }
  auto remove = [publishing = services_.publishing, request = std::move(request)] {
    return publishing->unpublish(request.name);
  };
  const Result<void> removed = co_await on_workers(std::move(remove));
  if (removed) {
    send(RequestEnd(), request_id);
  } else {
    send_error(removed.error(), request_id);
  }
  co_return Result<void>();
}

}  // namespace selvage
