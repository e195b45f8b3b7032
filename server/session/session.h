// SPDX-License-Identifier: MIT
//
// One client's connection on the server, from its Hello to its end. Two coroutines on one strand: the reader
// takes requests and queues what answers them, the writer alone writes, and exists while there is something
// to write. They meet in the outbox.
//
// Bad framing, an impossible message or credit, and a broken order of messages end the connection; any other
// failure ends its request alone. What a client can cost is bounded by SessionLimits.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/base/log.h"
#include "common/net/byte_stream.h"
#include "common/net/deadline.h"
#include "common/net/frame.h"
#include "common/net/messages.h"
#include "common/net/signal.h"
#include "server/session/limits.h"
#include "server/session/outbox.h"
#include "server/session/rate_limit.h"
#include "server/session/run_on.h"
#include "server/session/services.h"

namespace selvage {

/// Single-strand (the stream's), workers aside.
class Session {
 public:
  /// The store is asked on the services' workers, so that a disk never holds up the strand. `services` and
  /// `limits` outlive the session.
  Session(std::unique_ptr<ByteStream> stream, const SessionServices& services, const SessionLimits& limits);
  ~Session();

  /// The whole life of the connection. Returns when it is closed; the session may then go.
  asio::awaitable<void> run();

  /// Says GoAway, lets requests in flight finish and refuses new ones, then ends.
  void shut_down();
  /// Ends at once.
  void abort() { stream_->close(); }

  const std::string& peer() const { return peer_; }
  /// Which of the server's connections this is, counted from 1; in every line of the log about it.
  std::uint64_t number() const { return number_; }
  /// Why it ended, once run() has returned; null if the client left in good order.
  const Error* reason() const { return reason_.get(); }

 private:
  static constexpr auto kNever = Deadline::Clock::time_point::max();
  /// With a limit on the rate this much may go at once, and a write waits until it may carry as much.
  static constexpr std::uint64_t kBurst = 64u << 10;

  void watch_deadlines();
  void on_deadline();
  void set_deadline(Deadline::Clock::time_point& which, Deadline::Clock::time_point at);
  void end_for(const Error& reason);
  void finish();
  /// What work() returns. For all that handling a frame waits for: what is queued does not wait with it.
  template <class Work>
  auto on_workers(Work work) {
    uncork();
    return run_on(services_.workers, std::move(work));
  }
  void uncork();
  void wake_writer();
  void start_writer(Batch batch, std::size_t written);
  bool write_at_once();
  void take_next(Batch& batch);
  asio::awaitable<void> read_loop();
  asio::awaitable<void> see_off();
  asio::awaitable<void> write_loop(Batch batch, std::size_t written);
  asio::awaitable<Result<void>> write(Batch& batch, std::size_t written = 0);

  Result<void> greet(const Frame& frame);
  void note(const char* what, std::uint32_t request_id, LogFields fields) const;
  void note_model(const char* what, std::uint32_t request_id, const std::string& model) const;
  bool refuse(std::uint32_t request_id, bool is_allowed, const char* scope);
  asio::awaitable<Result<void>> handle(Frame frame);
  asio::awaitable<Result<void>> list(std::uint32_t request_id, ListModels request);
  asio::awaitable<Result<void>> open(std::uint32_t request_id, OpenModel request);
  asio::awaitable<Result<void>> get(std::uint32_t request_id, std::span<const std::byte> payload);
  asio::awaitable<Result<std::shared_ptr<const Pack>>> open_pack(std::string name);
  std::shared_ptr<const Pack> opened_pack(const std::string& name) const;

  void status(std::uint32_t request_id);

  // Publishing: session_publish.cpp.
  struct Lifeline;
  /// As long as it lives, events from other threads find the session.
  class LifelineHold {
   public:
    explicit LifelineHold(Session& session);
    ~LifelineHold();
    LifelineHold(const LifelineHold&) = delete;
    LifelineHold& operator=(const LifelineHold&) = delete;

   private:
    Session& session_;
  };
  /// The one upload that a session may have.
  struct Uploading {
    std::uint32_t request_id = 0;
    std::uint64_t size = 0;
    std::shared_ptr<Upload> upload;
    std::uint32_t seq = 0;
    bool is_submitted = false;  ///< all bytes are there: events say what becomes of them
  };
  asio::awaitable<Result<void>> publish(std::uint32_t request_id, Publish request);
  asio::awaitable<Result<void>> unpublish(std::uint32_t request_id, Unpublish request);
  asio::awaitable<Result<void>> take_upload(Frame frame);
  asio::awaitable<void> submit_upload();
  Result<void> may_upload() const;
  PublishEvents events_for(std::uint32_t request_id);
  void tell_progress(std::uint32_t request_id, const PublishProgress& progress);
  void end_upload(std::uint32_t request_id, const Result<Published>& outcome);
  bool cancel_upload(std::uint32_t request_id);

  template <class Message>
  void send(const Message& message, std::uint32_t request_id) {
    outbox_.push_control(to_frame(message, request_id));
    wake_writer();
  }
  void send_error(const Error& error, std::uint32_t request_id);
  void send_answer(Answer answer);
  void refuse_damaged();

  struct OpenedModel {
    std::string name;
    std::shared_ptr<const Pack> pack;
  };

  std::unique_ptr<ByteStream> stream_;
  const SessionServices& services_;
  const SessionLimits& limits_;
  const std::string peer_;
  const std::uint64_t number_;
  Access access_;  ///< since the Hello

  FrameBuffer incoming_;
  Outbox outbox_;
  RateLimit rate_;
  Signal rate_pause_;   ///< ends early when there is something new to send
  Signal wake_reader_;  ///< the outbox has room again
  /// One timer for two deadlines: idle sessions have nothing to spare.
  Deadline deadline_;
  Deadline::Clock::time_point read_by_ = kNever;   ///< the next whole frame
  Deadline::Clock::time_point write_by_ = kNever;  ///< the write under way

  std::vector<OpenedModel>
      opened_;  ///< a get finds the pack that this client opened, whatever the store has since
  Signal writer_ended_;
  int writers_ = 0;            ///< whose coroutines have not come to their end
  bool is_writing_ = false;    ///< one of them takes from the outbox
  bool corked_ = false;        ///< what is queued waits for more of what has come from the client
  bool has_news_ = false;      ///< something was queued meanwhile
  bool ended_ = false;         ///< no more writers
  std::exception_ptr thrown_;  ///< by a loop
  std::unique_ptr<Uploading> upload_;
  std::uint32_t last_upload_ = 0;  ///< the request whose Data may still arrive; 0: none
  std::shared_ptr<Lifeline> lifeline_;
  bool is_ready_ = false;  ///< the stream's own handshake is done
  bool greeted_ = false;
  bool draining_ = false;  ///< no new requests; the writer ends when all is sent
  bool closing_ = false;   ///< the writer sends what control frames are left, and ends
  bool sent_all_ = false;  ///< it has; what the client still says is read and ignored, until it leaves
  std::unique_ptr<const Error> reason_;
};

}  // namespace selvage
