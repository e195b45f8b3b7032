// SPDX-License-Identifier: MIT
#include "server/session/session.h"

#include <algorithm>

#include <boost/asio/associated_executor.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/post.hpp>

#include "common/net/await.h"
#include "common/net/frame_io.h"
#include "server/session/request_handler.h"

namespace selvage {
namespace {

constexpr std::string_view kSoftware = "selvage-server";
/// One read: many small requests, or a Credit. An idle connection holds no more than this.
constexpr std::size_t kReadSize = 2048;

bool is_request(FrameType type) {
  return type == FrameType::ListModels || type == FrameType::OpenModel || type == FrameType::GetParts;
}

/// What `work()` returns when run on `workers`. The coroutine itself never leaves its strand: resuming it
/// elsewhere would race with whoever cancels it.
template <class Work, class Value = std::invoke_result_t<Work>>
asio::awaitable<Value> run_on(asio::any_io_executor workers, Work work) {
  auto initiate = [workers](auto done, Work job) {
    auto home = asio::make_work_guard(asio::get_associated_executor(done));
    auto run = [done = std::move(done), job = std::move(job), home = std::move(home)]() mutable {
      std::exception_ptr thrown;
      Value value{};
      try {
        value = job();
      } catch (...) {
        thrown = std::current_exception();
      }
      const auto executor = home.get_executor();
      auto finish = [done = std::move(done), home = std::move(home), thrown,
                     value = std::move(value)]() mutable { std::move(done)(thrown, std::move(value)); };
      asio::post(executor, std::move(finish));
    };
    asio::post(workers, std::move(run));
  };
  const asio::use_awaitable_t<> token;
  co_return co_await asio::async_initiate<const asio::use_awaitable_t<>, void(std::exception_ptr, Value)>(
      std::move(initiate), token, std::move(work));
}

}  // namespace

Session::Session(std::unique_ptr<ByteStream> stream, PackStore& store, asio::any_io_executor workers,
                 const SessionLimits& limits)
    : stream_(std::move(stream)),
      store_(store),
      workers_(std::move(workers)),
      limits_(limits),
      peer_(stream_->peer()),
      incoming_(limits.message_bytes, kReadSize),
      outbox_(limits),
      wake_writer_(stream_->executor()),
      wake_reader_(stream_->executor()),
      reading_(stream_->executor()),
      writing_(stream_->executor()) {}

asio::awaitable<void> Session::run() {
  using namespace asio::experimental::awaitable_operators;
  reading_.expires_after(limits_.handshake_timeout);
  auto both = read_until_end() && write_loop();
  auto stalled = writing_.expired();
  const auto first = co_await (std::move(both) || std::move(stalled));
  if (first.index() == 1) reason_ = Error{ErrorCode::Timeout, "the client does not take what it asked for"};
  stream_->close();
}

void Session::shut_down() {
  if (draining_) return;
  draining_ = true;
  send(GoAway{"the server is shutting down"}, 0);
}

// ---- reading
// -------------------------------------------------------------------------------------------------

/// Reads until there is a reason not to, tells the client, and lets the writer finish.
asio::awaitable<void> Session::read_until_end() {
  using namespace asio::experimental::awaitable_operators;
  auto loop = read_loop();
  auto silence = reading_.expired();
  const auto first = co_await (std::move(loop) || std::move(silence));
  if (first.index() == 1) reason_ = Error{ErrorCode::Timeout, "nothing heard from the client for too long"};
  if (reason_) send_error(*reason_, 0);
  closing_ = true;
  outbox_.drop_answers();
  wake_writer_.notify();
}

asio::awaitable<void> Session::read_loop() {
  for (;;) {
    while (outbox_.full()) co_await wake_reader_.wait();
    Result<std::optional<Frame>> frame = co_await read_frame(*stream_, incoming_);
    if (frame && !frame->has_value()) co_return;  // the client has left
    Result<void> handled;
    if (frame) {
      reading_.clear();  // what comes is our time, not the client's
      handled = co_await handle(**frame);
      reading_.expires_after(limits_.idle_timeout);
    } else {
      handled = forward_error(frame);
    }
    if (!handled) {
      reason_ = handled.error();
      co_return;
    }
  }
}

/// Fails only for what ends the connection. The frame's payload lives until the next read.
asio::awaitable<Result<void>> Session::handle(Frame frame) {
  const std::uint32_t id = frame.header.request_id;
  if (frame.header.seq != 0 || frame.header.flags != 0) {
    co_return fail(ErrorCode::Protocol, "frames from a client have seq 0 and no flags");
  }
  if (!greeted_) co_return greet(frame);
  if (id == 0 && is_request(frame.header.type)) co_return fail(ErrorCode::Protocol, "a request has an id");
  switch (frame.header.type) {
    case FrameType::ListModels: {
      Result<ListModels> request = parse<ListModels>(frame.payload);
      if (!request) co_return forward_error(request);
      co_return co_await list(id, std::move(*request));
    }
    case FrameType::OpenModel: {
      Result<OpenModel> request = parse<OpenModel>(frame.payload);
      if (!request) co_return forward_error(request);
      co_return co_await open(id, std::move(*request));
    }
    case FrameType::GetParts: {
      Result<GetParts> request = parse<GetParts>(frame.payload);
      if (!request) co_return forward_error(request);
      co_return co_await get(id, std::move(*request));
    }
    case FrameType::Credit: {
      Result<Credit> credit = parse<Credit>(frame.payload);
      if (!credit) co_return forward_error(credit);
      wake_writer_.notify();
      co_return outbox_.grant(credit->bytes);
    }
    case FrameType::Cancel: {
      const Result<Cancel> request = parse<Cancel>(frame.payload);
      if (!request) co_return tl::unexpected(request.error());
      // A cancel may cross the end of its request on the way: then there is nothing left to do.
      if (outbox_.cancel(id)) send_error(Error{ErrorCode::Cancelled, "cancelled"}, id);
      co_return Result<void>();
    }
    case FrameType::Ping: {
      const Result<Ping> request = parse<Ping>(frame.payload);
      if (!request) co_return tl::unexpected(request.error());
      send(Pong{}, id);
      co_return Result<void>();
    }
    case FrameType::Reprioritise: {
      Result<Reprioritise> request = parse<Reprioritise>(frame.payload);
      if (!request) co_return forward_error(request);
      outbox_.reprioritise(id, request->urgency);
      co_return Result<void>();
    }
    default:
      co_return fail(ErrorCode::Protocol,
                     "a client does not send " + std::string(to_string(frame.header.type)) + " here");
  }
}

Result<void> Session::greet(const Frame& frame) {
  if (!frame.is(FrameType::Hello)) return fail(ErrorCode::Protocol, "the first frame must be a Hello");
  auto hello = parse<Hello>(frame.payload);
  if (!hello) return forward_error(hello);
  if (hello->min_version > kProtocolVersion || hello->max_version < kProtocolVersion) {
    return fail(ErrorCode::Unsupported,
                "this server speaks version " + std::to_string(kProtocolVersion) + " of the protocol");
  }
  greeted_ = true;
  HelloAck ack;
  ack.software = kSoftware;
  ack.max_message_bytes = limits_.message_bytes;
  ack.max_requests = limits_.requests;
  ack.max_ids = limits_.ids_per_request;
  ack.idle_timeout_ms = static_cast<std::uint32_t>(limits_.idle_timeout.count());
  send(ack, 0);
  return outbox_.grant(hello->initial_credit);
}

// ---- requests
// ------------------------------------------------------------------------------------------------

asio::awaitable<Result<void>> Session::list(std::uint32_t request_id, ListModels request) {
  auto look = [&store = store_] { return store.list(); };
  Result<std::vector<PackStore::Model>> models = co_await run_on(workers_, std::move(look));
  if (models) {
    send(answer_list(request, *models), request_id);
  } else {
    send_error(models.error(), request_id);
  }
  co_return Result<void>();
}

asio::awaitable<Result<void>> Session::open(std::uint32_t request_id, OpenModel request) {
  Result<std::shared_ptr<const Pack>> pack = co_await open_pack(request.name);
  if (pack) {
    send_answer(answer_open(request_id, request, std::move(*pack)));
  } else {
    send_error(pack.error(), request_id);
  }
  co_return Result<void>();
}

/// A get need not wait for an open's answer, nor even follow one.
asio::awaitable<Result<void>> Session::get(std::uint32_t request_id, GetParts request) {
  Result<std::shared_ptr<const Pack>> pack = opened_pack(request.model);
  if (*pack == nullptr) pack = co_await open_pack(request.model);
  Result<Answer> answer = pack ? answer_get(request_id, request, *pack, limits_) : forward_error(pack);
  if (answer) {
    send_answer(std::move(*answer));
  } else {
    send_error(answer.error(), request_id);
  }
  co_return Result<void>();
}

std::shared_ptr<const Pack> Session::opened_pack(const std::string& name) const {
  const auto found = std::ranges::find(opened_, name, &OpenedModel::name);
  return found == opened_.end() ? nullptr : found->pack;
}

/// The pack as the store has it now; remembered for the gets to come.
asio::awaitable<Result<std::shared_ptr<const Pack>>> Session::open_pack(std::string name) {
  auto look = [&store = store_, &name] { return store.open(name); };
  Result<std::shared_ptr<const Pack>> pack = co_await run_on(workers_, std::move(look));
  if (pack) {
    std::erase_if(opened_, [&](const OpenedModel& model) { return model.name == name; });
    opened_.push_back({std::move(name), *pack});
    if (opened_.size() > limits_.opened_models) opened_.pop_front();
  }
  co_return pack;
}

// ---- sending
// -------------------------------------------------------------------------------------------------

template <class Message>
void Session::send(const Message& message, std::uint32_t request_id) {
  outbox_.push_control(to_frame(message, request_id));
  wake_writer_.notify();
}

void Session::send_error(const Error& error, std::uint32_t request_id) {
  send(ErrorMessage{error, is_retryable(error.code)}, request_id);
}

void Session::send_answer(Answer answer) {
  const std::uint32_t request_id = answer.request_id;
  const Result<void> queued = draining_
                                  ? Result<void>(fail(ErrorCode::Unavailable, "the server is shutting down"))
                                  : outbox_.push_answer(std::move(answer));
  if (!queued) send_error(queued.error(), request_id);
  wake_writer_.notify();
}

asio::awaitable<void> Session::write_loop() {
  Batch batch;
  for (;;) {
    outbox_.take(batch);
    if (batch.empty()) {
      if (closing_ || (draining_ && outbox_.idle())) break;
      co_await wake_writer_.wait();
      continue;
    }
    if (!outbox_.full()) wake_reader_.notify();
    writing_.expires_after(limits_.write_timeout);
    const Result<void> written = co_await stream_->write(batch.pieces());
    writing_.clear();
    if (!written) break;
  }
  stream_->close();  // which ends the reader too
}

}  // namespace selvage
