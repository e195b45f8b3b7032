// SPDX-License-Identifier: MIT
#include "server/session/session.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <boost/asio/co_spawn.hpp>

#include "common/net/await.h"
#include "common/net/frame_io.h"
#include "server/session/request_handler.h"

namespace selvage {
namespace {

constexpr std::string_view kSoftware = "selvage-server";
/// One read: many small requests, or a Credit. An idle connection holds no more than this.
constexpr std::size_t kReadSize = 512;
/// Requests that look at more than so many things (bytes of the request, regions of the model) are answered
/// on the workers: they may take a millisecond or more.
constexpr std::size_t kSmallRequest = 16u << 10;
constexpr std::size_t kSmallModel = 4096;
/// With a limit on the rate this much may go at once, and a write waits until it may carry as much as that.
constexpr std::uint64_t kBurst = 64u << 10;
/// So long a client that has been sent everything may take to leave.
constexpr std::chrono::seconds kFarewell{1};

bool is_request(FrameType type) {
  return type == FrameType::ListModels || type == FrameType::OpenModel || type == FrameType::GetParts ||
         type == FrameType::Status;
}

bool changes_models(FrameType type) { return type == FrameType::Publish || type == FrameType::Unpublish; }

}  // namespace

Session::Session(std::unique_ptr<ByteStream> stream, const SessionServices& services,
                 const SessionLimits& limits)
    : stream_(std::move(stream)),
      services_(services),
      limits_(limits),
      peer_(stream_->peer()),
      number_(++services.counters.connections),
      incoming_(limits.message_bytes, kReadSize),
      outbox_(limits),
      rate_(limits.bytes_per_second, kBurst, RateLimit::Clock::now()),
      deadline_(stream_->executor()) {
  ++services_.counters.sessions;
}

Session::~Session() { --services_.counters.sessions; }

asio::awaitable<void> Session::run() {
  const LifelineHold hold(*this);
  watch_deadlines();
  set_deadline(read_by_, Deadline::Clock::now() + limits_.handshake_timeout);
  try {
    co_await read_loop();
  } catch (...) {
    thrown_ = std::current_exception();
  }
  finish();
  while (writers_ > 0) co_await writer_ended_.wait();
  ended_ = true;
  co_await see_off();
  deadline_.stop();
  stream_->close();
  if (thrown_) std::rethrow_exception(thrown_);
}

/// By calls, not by coroutines and operators that join them: those would hold several times as much memory
/// for an idle connection as all the rest.
void Session::watch_deadlines() {
  deadline_.on_expiry([this] { on_deadline(); });
}

void Session::set_deadline(Deadline::Clock::time_point& which, Deadline::Clock::time_point at) {
  which = at;
  deadline_.expires_at(std::min(read_by_, write_by_));
}

void Session::on_deadline() {
  const bool is_write = write_by_ <= read_by_;
  set_deadline(is_write ? write_by_ : read_by_, kNever);
  if (is_write) {
    end_for({ErrorCode::Timeout, "the client does not take what it asked for"});
    stream_->close();
  } else if (sent_all_) {
    stream_->close();
  } else {
    end_for({ErrorCode::Timeout, "nothing heard from the client for too long"});
    if (!is_ready_) return stream_->close();  // in the middle of a handshake nothing can be said
    finish();
  }
}

/// The first reason is the one that is told.
void Session::end_for(const Error& reason) {
  if (!reason_) reason_ = std::make_unique<const Error>(reason);
}

/// No more requests are taken: tells the client why, and lets the writer end.
void Session::finish() {
  corked_ = false;
  if (closing_) return;
  closing_ = true;
  outbox_.drop_answers();
  if (thrown_) return stream_->close();
  if (reason_) send_error(*reason_, 0);
  wake_writer();
}

void Session::shut_down() {
  if (draining_) return;
  draining_ = true;
  send(GoAway{"the server is shutting down"}, 0);
}

// ---- reading
// -------------------------------------------------------------------------------------------------

/// Until there is a reason not to.
asio::awaitable<void> Session::read_loop() {
  Result<void> good = co_await stream_->handshake();
  is_ready_ = good.has_value();
  if (!good) stream_->close();
  while (good) {
    if (outbox_.full()) uncork();
    while (outbox_.full() && !closing_) co_await wake_reader_.wait();
    if (closing_) co_return;
    Result<std::optional<Frame>> frame = incoming_.take();
    if (frame && !frame->has_value()) {
      uncork();
      if (incoming_.between_frames()) {
        incoming_.release();
        (void)co_await stream_->wait_to_read();  // what is wrong, the read says
      }
      frame = co_await read_frame(*stream_, incoming_);
    }
    if (closing_ || sent_all_) co_return;
    if (frame && !frame->has_value()) co_return;  // the client has left
    if (frame) {
      set_deadline(read_by_, kNever);  // what comes is our time, not the client's
      corked_ = true;
      good = co_await handle(**frame);
      if (!closing_ && !sent_all_) set_deadline(read_by_, Deadline::Clock::now() + limits_.idle_timeout);
    } else {
      good = forward_error(frame);
    }
  }
  if (!closing_ && !sent_all_) end_for(good.error());
}

/// To close while anything from the client is unread would take back what it has not received yet. So what it
/// still says is read and ignored, until it leaves or its time is up.
asio::awaitable<void> Session::see_off() {
  while (sent_all_) {
    std::array<std::byte, kReadSize> ignored;
    const Result<std::size_t> count = co_await stream_->read_some(ignored);
    if (!count || *count == 0) co_return;
  }
}

/// Fails only for what ends the connection. The frame's payload lives until the next read.
asio::awaitable<Result<void>> Session::handle(Frame frame) {
  const std::uint32_t id = frame.header.request_id;
  if (frame.header.seq != 0 || (frame.header.flags != 0 && !frame.is(FrameType::Data))) {
    co_return fail(ErrorCode::Protocol, "frames from a client have seq 0, and no flags but for END on Data");
  }
  if (!greeted_) co_return greet(frame);
  const bool reads = is_request(frame.header.type), changes = changes_models(frame.header.type);
  if (id == 0 && (reads || changes)) co_return fail(ErrorCode::Protocol, "a request has an id");
  if (reads && refuse(id, access_.may_read, "read")) co_return Result<void>();
  if (changes && refuse(id, access_.may_publish, "publish")) co_return Result<void>();
  switch (frame.header.type) {
    case FrameType::ListModels: {
      Result<ListModels> request = parse<ListModels>(frame.payload);
      if (!request) co_return forward_error(request);
      ++services_.counters.lists;
      co_return co_await list(id, std::move(*request));
    }
    case FrameType::OpenModel: {
      Result<OpenModel> request = parse<OpenModel>(frame.payload);
      if (!request) co_return forward_error(request);
      ++services_.counters.opens;
      co_return co_await open(id, std::move(*request));
    }
    case FrameType::GetParts: {
      co_return co_await get(id, frame.payload);
    }
    case FrameType::Status: {
      const Result<Status> request = parse<Status>(frame.payload);
      if (!request) co_return tl::unexpected(request.error());
      ++services_.counters.statuses;
      status(id);
      co_return Result<void>();
    }
    case FrameType::Publish: {
      Result<Publish> request = parse<Publish>(frame.payload);
      if (!request) co_return forward_error(request);
      ++services_.counters.publishes;
      co_return co_await publish(id, std::move(*request));
    }
    case FrameType::Unpublish: {
      Result<Unpublish> request = parse<Unpublish>(frame.payload);
      if (!request) co_return forward_error(request);
      ++services_.counters.unpublishes;
      co_return co_await unpublish(id, std::move(*request));
    }
    case FrameType::Data:
      co_return co_await take_upload(frame);
    case FrameType::Credit: {
      Result<Credit> credit = parse<Credit>(frame.payload);
      if (!credit) co_return forward_error(credit);
      const Result<void> granted = outbox_.grant(credit->bytes);
      wake_writer();
      co_return granted;
    }
    case FrameType::Cancel: {
      const Result<Cancel> request = parse<Cancel>(frame.payload);
      if (!request) co_return tl::unexpected(request.error());
      // A cancel may cross the end of its request on the way: then there is nothing left to do.
      if (!cancel_upload(id) && outbox_.cancel(id)) send_error(Error{ErrorCode::Cancelled, "cancelled"}, id);
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
  auto access = services_.access.table()->access_of(hello->token);
  if (!access) return forward_error(access);
  access_ = std::move(*access);
  note("hello", 0, {{"peer", peer_}, {"who", access_.who}, {"software", hello->software}});
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

/// A line of the log about one request.
void Session::note(const char* what, std::uint32_t request_id, LogFields fields) const {
  if (!is_logged(LogLevel::Debug)) return;
  fields.insert(fields.begin(), {"request", std::to_string(request_id)});
  fields.insert(fields.begin(), {"connection", std::to_string(number_)});
  log(LogLevel::Debug, what, fields);
}

void Session::note_model(const char* what, std::uint32_t request_id, const std::string& model) const {
  if (is_logged(LogLevel::Debug)) note(what, request_id, {{"model", model}});
}

/// Whether the request is answered already: with the scope that its sender lacks.
bool Session::refuse(std::uint32_t request_id, bool is_allowed, const char* scope) {
  if (is_allowed) return false;
  const std::string needs = std::string("this needs the scope '") + scope + "', which ";
  const std::string lacks = access_.who == "anonymous" ? "clients without a token do not have"
                                                       : "the token of '" + access_.who + "' does not have";
  send_error(Error{ErrorCode::Unauthorised, needs + lacks}, request_id);
  return true;
}

// ---- requests
// ------------------------------------------------------------------------------------------------

asio::awaitable<Result<void>> Session::list(std::uint32_t request_id, ListModels request) {
  note("list", request_id, LogFields());
  auto look = [&store = services_.store] { return store.list(); };
  Result<std::vector<PackStore::Model>> models = co_await on_workers(std::move(look));
  if (models) {
    send(answer_list(request, *models), request_id);
  } else {
    send_error(models.error(), request_id);
  }
  co_return Result<void>();
}

asio::awaitable<Result<void>> Session::open(std::uint32_t request_id, OpenModel request) {
  note_model("open", request_id, request.name);
  Result<std::shared_ptr<const Pack>> pack = co_await open_pack(request.name);
  if (pack) {
    send_answer(answer_open(request_id, request, std::move(*pack)));
  } else {
    send_error(pack.error(), request_id);
  }
  co_return Result<void>();
}

/// A get need not wait for an open's answer, nor even follow one. `payload` lives until the next read.
asio::awaitable<Result<void>> Session::get(std::uint32_t request_id, std::span<const std::byte> payload) {
  const bool is_small = payload.size() <= kSmallRequest;
  auto parse_request = [payload] { return parse<GetParts>(payload); };
  Result<GetParts> request;
  if (is_small) {
    request = parse_request();
  } else {
    request = co_await on_workers(parse_request);
  }
  if (!request) co_return forward_error(request);
  ++services_.counters.gets;
  note_model("get", request_id, request->model);

  Result<std::shared_ptr<const Pack>> pack = opened_pack(request->model);
  if (*pack == nullptr) pack = co_await open_pack(request->model);
  if (!pack) {
    send_error(pack.error(), request_id);
    co_return Result<void>();
  }
  auto look_up = [&] { return answer_get(request_id, *request, *pack, limits_); };
  Result<Answer> answer;
  if (is_small && (*pack)->directory().regions.size() <= kSmallModel) {
    answer = look_up();
  } else {
    answer = co_await on_workers(look_up);
  }
  if (answer) {
    send_answer(std::move(*answer));
  } else {
    send_error(answer.error(), request_id);
  }
  co_return Result<void>();
}

void Session::status(std::uint32_t request_id) { send(answer_status(services_, draining_), request_id); }

std::shared_ptr<const Pack> Session::opened_pack(const std::string& name) const {
  const auto found = std::ranges::find(opened_, name, &OpenedModel::name);
  return found == opened_.end() || found->pack->is_damaged() ? nullptr : found->pack;
}

/// The pack as the store has it now; remembered for the gets to come.
asio::awaitable<Result<std::shared_ptr<const Pack>>> Session::open_pack(std::string name) {
  auto look = [&store = services_.store, &name] { return store.open(name); };
  Result<std::shared_ptr<const Pack>> pack = co_await on_workers(std::move(look));
  if (pack) {
    std::erase_if(opened_, [&](const OpenedModel& model) { return model.name == name; });
    opened_.push_back({std::move(name), *pack});
    if (opened_.size() > limits_.opened_models) opened_.erase(opened_.begin());
  }
  co_return pack;
}

// ---- sending
// -------------------------------------------------------------------------------------------------

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

/// What the kernel takes without waiting needs no coroutine. False if a writer has still something to do.
bool Session::write_at_once() {
  if (closing_ || draining_ || outbox_.idle() || !stream_->may_write_at_once()) return false;
  thread_local Batch batch;
  is_writing_ = true;
  refuse_damaged();
  const auto now = RateLimit::Clock::now();
  outbox_.take(batch, std::min<std::uint64_t>(stream_->write_size(), rate_.available(now)));
  rate_.spend(batch.size_bytes());
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
    const auto now = RateLimit::Clock::now();
    outbox_.take(batch, std::min<std::uint64_t>(stream_->write_size(), rate_.available(now)));
    if (!batch.empty()) {
      if (!outbox_.full()) wake_reader_.notify();
      rate_.spend(batch.size_bytes());
      const Result<void> all_written = co_await write(batch);
      is_broken = !all_written;
      continue;
    }
    const auto pause = rate_.wait_for(kBurst, now);
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
