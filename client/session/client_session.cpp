// SPDX-License-Identifier: MIT
#include "client/session/client_session.h"

#include <algorithm>
#include <concepts>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/net/await.h"
#include "common/net/frame_io.h"
#include "common/net/tls.h"

namespace selvage {
namespace {

/// Together they keep a GetParts below the size of a frame, whatever the server says its limits are.
constexpr std::size_t kMaxIds = 65'536;
constexpr std::size_t kMaxHave = 32'768;

/// A server that wants to hear from us more often than this is not taken at its word.
constexpr std::uint32_t kMinIdleTimeoutMs = 1000;

/// What a server accepts that has not said so yet: docs/PROTOCOL.md, "Limits".
constexpr std::uint32_t kUsualMessageBytes = 512u << 10;

/// How long a cancelled publish waits for the server to say so.
constexpr std::chrono::seconds kCancelTimeout{2};

/// The frame after which nothing comes for its request.
bool ends_answer(FrameType type) {
  return type == FrameType::RequestEnd || type == FrameType::Error || type == FrameType::Models ||
         type == FrameType::Pong || type == FrameType::Published || type == FrameType::StatusReport;
}

/// The server's words on why it says no.
Error error_in(const Frame& frame) {
  auto message = parse<ErrorMessage>(frame.payload);
  return message ? std::move(message->error) : std::move(message.error());
}

/// Tells the others of a request's failure.
asio::awaitable<Result<void>> end_with(asio::awaitable<Result<void>> request, std::stop_source others) {
  Result<void> outcome = co_await std::move(request);
  if (!outcome) others.request_stop();
  co_return outcome;
}

bool is_loopback(const asio::ip::tcp::socket& socket) {
  boost::system::error_code ignored;
  return socket.remote_endpoint(ignored).address().is_loopback();
}

}  // namespace

// ---- life

ClientSession::ClientSession(std::unique_ptr<ByteStream> stream, ClientOptions options)
    : stream_(std::move(stream)),
      options_(std::move(options)),
      incoming_(kMaxPayload, options_.read_bytes),
      greeting_(stream_->executor()),
      window_(options_.window_bytes) {
  server_.max_message_bytes = kUsualMessageBytes;
  server_.max_ids = kMaxIds;
}

/// Leaves no connection behind, whatever ends its scope.
class ClientSession::CloseUnlessKept {
 public:
  explicit CloseUnlessKept(std::shared_ptr<ClientSession> session) : session_(std::move(session)) {}
  ~CloseUnlessKept() {
    if (session_) session_->close();
  }
  CloseUnlessKept(const CloseUnlessKept&) = delete;
  CloseUnlessKept& operator=(const CloseUnlessKept&) = delete;
  void keep() { session_.reset(); }

 private:
  std::shared_ptr<ClientSession> session_;
};

asio::awaitable<Result<std::shared_ptr<ClientSession>>> ClientSession::connect(HostPort server,
                                                                               ClientOptions options) {
  std::shared_ptr<TlsContext> tls;
  if (options.tls) {
    Result<std::shared_ptr<TlsContext>> context = tls_client_context(options.tls->ca);
    if (!context) co_return forward_error(context);
    tls = std::move(*context);
  }
  Result<asio::ip::tcp::socket> socket =
      co_await connect_socket(server.host, server.port, options.connect_timeout);
  if (!socket) co_return forward_error(socket);
  if (!tls && !options.token.empty() && !options.allow_plain && !is_loopback(*socket)) {
    co_return fail(ErrorCode::InvalidArgument,
                   "the token would travel unencrypted; connect with TLS, or allow plain connections");
  }
  std::unique_ptr<ByteStream> stream =
      tls ? make_tls_stream(std::move(*socket), tls, server.host) : make_tcp_stream(std::move(*socket));
  if (options.wrap_stream) stream = options.wrap_stream(std::move(stream));
  co_return co_await start(std::move(stream), std::move(options));
}

asio::awaitable<Result<std::shared_ptr<ClientSession>>> ClientSession::start(
    std::unique_ptr<ByteStream> stream, ClientOptions options) {
  std::shared_ptr<ClientSession> session(new ClientSession(std::move(stream), std::move(options)));
  CloseUnlessKept guard(session);
  Result<void> ready = co_await session->greet();
  if (!ready) co_return forward_error(ready);
  guard.keep();
  co_return session;
}

/// Says Hello once the transport is ready, and waits for the answer if it is to.
asio::awaitable<Result<void>> ClientSession::greet() {
  using namespace asio::experimental::awaitable_operators;
  greeting_.expires_after(options_.connect_timeout);
  auto handshake = stream_->handshake();
  auto silence = greeting_.expired();
  auto first = co_await (std::move(handshake) || std::move(silence));
  if (first.index() == 1) co_return tl::unexpected(no_answer());
  Result<void> ready = std::get<0>(first);
  if (!ready) co_return ready;

  auto notice = [weak = weak_from_this(), executor = executor()] {
    asio::post(executor, [weak] {
      if (const auto alive = weak.lock()) alive->grant();
    });
  };
  consumed_ = std::make_shared<ConsumedBytes>(std::move(notice));
  Hello hello;
  hello.software = options_.software;
  hello.initial_credit = options_.window_bytes;
  hello.token = options_.token;
  send(hello, 0);
  asio::co_spawn(executor(), run(), asio::detached);
  while (options_.await_greeting && !is_greeted_ && !ended_) co_await greeted_.wait();
  if (ended_) co_return tl::unexpected(*ended_);
  co_return Result<void>();
}

Result<void> ClientSession::handle_greeting(const Frame& frame) {
  if (frame.is(FrameType::Error) && frame.header.request_id == 0) return tl::unexpected(error_in(frame));
  if (!frame.is(FrameType::HelloAck)) return fail(ErrorCode::Protocol, "the server does not greet");
  auto ack = parse<HelloAck>(frame.payload);
  if (!ack) return forward_error(ack);
  if (ack->version != kProtocolVersion)
    return fail(ErrorCode::Unsupported, "the server chose version " + std::to_string(ack->version));
  server_ = std::move(*ack);
  is_greeted_ = true;
  greeted_.notify();
  greeting_.expires_after({});  // ends the wait for it
  return {};
}

asio::awaitable<void> ClientSession::run() {
  using namespace asio::experimental::awaitable_operators;
  const std::shared_ptr<ClientSession> self = shared_from_this();
  last_heard_ = std::chrono::steady_clock::now();

  auto both = read_loop() && write_loop();
  auto silence = heartbeat();
  co_await (std::move(both) || std::move(silence));
  stream_->close();
  consumed_->close();
  greeted_.notify();
  for (const auto& [id, pending] : pending_) settle(*pending, tl::unexpected(*ended_));
}

/// The first reason counts: what follows are its consequences.
void ClientSession::end(Error reason) {
  if (ended_) return;
  if (going_away_ && reason.code == ErrorCode::Io) reason = {ErrorCode::Unavailable, *going_away_};
  const bool is_babble = reason.code == ErrorCode::Protocol || reason.code == ErrorCode::Io;
  if (!is_greeted_ && is_babble && !options_.tls) reason.message += " (does the server want TLS?)";
  ended_ = std::move(reason);
}

void ClientSession::close() {
  end({ErrorCode::Cancelled, "the session was closed"});
  stream_->close();
}

Error ClientSession::no_answer() const {
  return {ErrorCode::Timeout, stream_->peer() + " does not answer like a selvage server"};
}

asio::awaitable<void> ClientSession::heartbeat() {
  co_await greeting_.expired();
  if (!is_greeted_) {
    end(no_answer());
    co_return;
  }
  const std::chrono::milliseconds idle(std::max(server_.idle_timeout_ms, kMinIdleTimeoutMs));
  const auto interval = std::min<std::chrono::milliseconds>(options_.silence_timeout, idle) / 3;
  asio::steady_timer timer(stream_->executor());
  for (;;) {
    timer.expires_after(interval);
    co_await timer.async_wait(kAwait);
    if (std::chrono::steady_clock::now() - last_heard_ > options_.silence_timeout) break;
    send(Ping{}, 0);
  }
  end({ErrorCode::Timeout, "nothing heard from " + stream_->peer() + " for too long"});
}

// ---- reading

asio::awaitable<void> ClientSession::read_loop() {
  while (!ended_) {
    Result<std::optional<Frame>> frame = co_await read_frame(*stream_, incoming_);
    if (!frame) {
      end(std::move(frame.error()));
    } else if (!frame->has_value()) {
      end({ErrorCode::Io, "the server closed the connection"});
    } else {
      last_heard_ = std::chrono::steady_clock::now();
      Result<void> handled = handle(**frame);
      if (!handled) end(std::move(handled.error()));
    }
  }
  wake_writer_.notify();
}

/// Fails only for what ends the connection.
Result<void> ClientSession::handle(const Frame& frame) {
  if (frame.is(FrameType::Data) && !window_.receive(frame.payload.size())) {
    return fail(ErrorCode::Protocol, "the server sends more than it was granted");
  }
  if (!is_greeted_) return handle_greeting(frame);
  auto handled = frame.header.request_id == 0 ? handle_connection_frame(frame) : handle_answer(frame);
  grant();
  return handled;
}

Result<void> ClientSession::handle_connection_frame(const Frame& frame) {
  switch (frame.header.type) {
    case FrameType::Pong:
      return {};
    case FrameType::Error:
      return tl::unexpected(error_in(frame));
    case FrameType::GoAway: {
      auto message = parse<GoAway>(frame.payload);
      if (!message) return forward_error(message);
      going_away_ = std::move(message->reason);
      return {};
    }
    default:
      return fail(ErrorCode::Protocol, "the server sends " + std::string(to_string(frame.header.type)));
  }
}

Result<void> ClientSession::handle_answer(const Frame& frame) {
  const std::uint32_t id = frame.header.request_id;
  const bool is_last = ends_answer(frame.header.type);
  if (abandoned_.contains(id)) {
    if (is_last) abandoned_.erase(id);
    return {};
  }
  const auto found = pending_.find(id);
  if (found == pending_.end()) return fail(ErrorCode::Protocol, "the server answers what was not asked");
  Pending& pending = *found->second;
  if (pending.outcome) return fail(ErrorCode::Protocol, "the server goes on after the end of an answer");
  if (frame.is(FrameType::Error)) return settle(pending, tl::unexpected(error_in(frame))), Result<void>();
  if (frame.header.seq != pending.next_seq++)
    return fail(ErrorCode::Protocol, "frames of an answer are missing");

  auto complete = pending.reader.on_frame(frame);
  if (complete) {
    if (*complete) settle(pending, {});
    return {};
  }
  if (complete.error().code == ErrorCode::Protocol) return forward_error(complete);
  // A request that failed on our side: the rest of its answer is not wanted.
  settle(pending, tl::unexpected(complete.error()));
  if (!is_last) abandon(id);
  return {};
}

void ClientSession::grant() {
  window_.release(consumed_->take());
  if (const std::uint32_t bytes = window_.take_grant()) send(Credit{bytes}, 0);
}

// ---- writing

template <class Message>
void ClientSession::send(const Message& message, std::uint32_t request_id) {
  append_frame(outgoing_, message, request_id);
  wake_writer_.notify();
}

/// A write that fails says less than what the reader is about to see, so it ends nothing by itself.
asio::awaitable<void> ClientSession::write_loop() {
  while (!ended_) {
    if (outgoing_.empty()) {
      co_await wake_writer_.wait();
      continue;
    }
    const std::vector<std::byte> bytes = std::exchange(outgoing_, {});
    wake_upload_.notify();
    const Pieces pieces(1, bytes);
    const Result<void> written = co_await stream_->write(pieces);
    if (!written) co_return;
  }
}

// ---- requests

/// Registers a request for as long as somebody waits for it. If that ends before the answer has come, the
/// rest is cancelled and dropped.
class ClientSession::PendingEntry {
 public:
  PendingEntry(std::shared_ptr<ClientSession> session, Pending& pending)
      : session_(std::move(session)), pending_(pending) {
    do {
      id_ = ++session_->last_request_id_;
    } while (id_ == 0 || session_->pending_.contains(id_) || session_->abandoned_.contains(id_));
    session_->pending_.emplace(id_, &pending_);
  }
  ~PendingEntry() {
    session_->pending_.erase(id_);
    if (!pending_.outcome) session_->abandon(id_);
  }
  PendingEntry(const PendingEntry&) = delete;
  PendingEntry& operator=(const PendingEntry&) = delete;

  std::uint32_t id() const { return id_; }

 private:
  std::shared_ptr<ClientSession> session_;
  Pending& pending_;
  std::uint32_t id_ = 0;
};

/// Passes turns of a dial on to the session, from whatever thread, for as long as it lives.
class ClientSession::DialListener {
 public:
  DialListener(ClientSession& session, std::uint32_t request_id, std::shared_ptr<UrgencyDial> dial)
      : dial_(std::move(dial)) {
    if (!dial_) return;
    dial_->listen(
        [weak = session.weak_from_this(), executor = session.executor(), request_id](std::uint8_t urgency) {
          asio::post(executor, [weak, request_id, urgency] {
            if (const auto alive = weak.lock()) alive->reprioritise(request_id, urgency);
          });
        });
  }
  ~DialListener() {
    if (dial_) dial_->listen(nullptr);
  }
  DialListener(const DialListener&) = delete;
  DialListener& operator=(const DialListener&) = delete;

 private:
  std::shared_ptr<UrgencyDial> dial_;
};

template <class Message>
asio::awaitable<Result<void>> ClientSession::exchange(Message message, AnswerReader& reader,
                                                      std::stop_token stop, std::shared_ptr<UrgencyDial> dial,
                                                      std::uint8_t least_urgency) {
  if (ended_) co_return tl::unexpected(*ended_);
  if (going_away_) co_return fail(ErrorCode::Unavailable, *going_away_);
  if (stop.stop_requested()) co_return fail(ErrorCode::Cancelled, "cancelled");
  Pending pending{reader, Signal(), std::nullopt, 0};
  if constexpr (requires { message.urgency; }) pending.urgency = message.urgency;
  pending.is_promise = std::same_as<Message, Publish>;
  pending.least_urgency = least_urgency;
  const PendingEntry entry(shared_from_this(), pending);
  const std::vector<std::byte> frame = to_frame(message, entry.id());
  if (frame.size() - kFrameHeaderSize > server_.max_message_bytes) {
    pending.outcome =
        fail(ErrorCode::LimitExceeded, "the request is larger than the server accepts; ask for less");
    co_return *pending.outcome;
  }
  outgoing_.insert(outgoing_.end(), frame.begin(), frame.end());
  wake_writer_.notify();

  auto on_stop = [weak = weak_from_this(), executor = executor(), id = entry.id()] {
    asio::post(executor, [weak, id] {
      if (const auto session = weak.lock()) session->cancel(id);
    });
  };
  const std::stop_callback cancels(stop, std::move(on_stop));
  const DialListener listener(*this, entry.id(), dial);
  // It may have been turned between the message's making and now.
  if (dial) reprioritise(entry.id(), dial->urgency());
  while (!pending.outcome) {
    if (!pending.give_up_at) {
      co_await pending.answered.wait();
    } else if (const auto left = *pending.give_up_at - std::chrono::steady_clock::now(); left > left.zero()) {
      co_await pending.answered.wait_for(left);
    } else {
      settle(pending, fail(ErrorCode::Cancelled, "cancelled"));
      abandon(entry.id());
    }
  }
  co_return *pending.outcome;
}

void ClientSession::settle(Pending& pending, Result<void> outcome) {
  if (!pending.outcome) pending.outcome = std::move(outcome);
  pending.answered.notify();
}

void ClientSession::cancel(std::uint32_t request_id) {
  const auto found = pending_.find(request_id);
  if (found == pending_.end() || found->second->outcome) return;
  Pending& pending = *found->second;
  if (!pending.is_promise) {
    settle(pending, fail(ErrorCode::Cancelled, "cancelled"));
    abandon(request_id);
  } else if (!pending.give_up_at) {
    pending.give_up_at = std::chrono::steady_clock::now() + kCancelTimeout;
    pending.answered.notify();
    send(Cancel{}, request_id);
  }
}

void ClientSession::reprioritise(std::uint32_t request_id, std::uint8_t urgency) {
  const auto found = pending_.find(request_id);
  if (found == pending_.end() || found->second->outcome) return;
  urgency = std::max(urgency, found->second->least_urgency);
  if (std::exchange(found->second->urgency, urgency) != urgency) send(Reprioritise{urgency}, request_id);
}

/// The server may have begun to answer: it is told to stop, and what comes until it does is dropped.
void ClientSession::abandon(std::uint32_t request_id) {
  if (ended_) return;
  abandoned_.insert(request_id);
  send(Cancel{}, request_id);
}

asio::awaitable<Result<std::vector<ModelInfo>>> ClientSession::list() {
  std::vector<ModelInfo> all;
  for (bool more = true; more;) {
    ModelsReader reader;
    ListModels request;
    if (!all.empty()) request.after = all.back().name;
    Result<void> answered = co_await exchange(std::move(request), reader, std::stop_token());
    if (!answered) co_return forward_error(answered);
    Models page = reader.take();
    if (!all.empty() && !page.models.empty() && page.models.front().name <= all.back().name) {
      co_return fail(ErrorCode::BadStream, "the server's list of models goes in circles");
    }
    std::ranges::move(page.models, std::back_inserter(all));
    more = page.more;
  }
  co_return all;
}

asio::awaitable<Result<std::shared_ptr<const Manifest>>> ClientSession::open(std::string name,
                                                                             std::stop_token stop) {
  OpenModel request;
  request.name = std::move(name);
  std::shared_ptr<const Manifest> opened;
  auto on_manifest = [&opened](Manifest manifest) -> Result<void> {
    opened = std::make_shared<const Manifest>(std::move(manifest));
    return {};
  };
  ManifestReader reader(request, options_.max_directory_bytes, std::move(on_manifest));
  Result<void> answered = co_await exchange(std::move(request), reader, std::move(stop));
  if (!answered) co_return forward_error(answered);
  co_return opened;
}

/// Hands a part over that counts as held until its receipt goes.
PartsReader::OnPart ClientSession::deliver_to(OnPart& on_part) {
  return [this, &on_part](const PartId& id, std::vector<std::byte> bytes) {
    const std::uint64_t size = bytes.size();
    window_.hold(size);
    on_part({id, std::move(bytes), Receipt(consumed_, size)});
  };
}

asio::awaitable<Result<GetStats>> ClientSession::get(GetRequest request, OnPart on_part,
                                                     std::stop_token stop) {
  if (request.selection.ids.size() > std::min<std::size_t>(server_.max_ids, kMaxIds)) {
    co_return fail(ErrorCode::LimitExceeded, "too many region ids in one request; ask for fewer at a time");
  }
  // The rest is sent again, which costs time and nothing else.
  if (request.have.size() > kMaxHave) request.have.resize(kMaxHave);
  std::vector<PartialPart> partial;
  if (request.unfinished) {
    for (const auto& [hash, bytes] : *request.unfinished) {
      if (partial.size() < kMaxHave) partial.push_back({hash, static_cast<std::uint32_t>(bytes.size())});
    }
  }

  if (request.dial) request.urgency = request.dial->urgency();
  Result<PartsReader> reader = PartsReader::for_request(request, deliver_to(on_part));
  if (!reader) co_return forward_error(reader);
  if (!options_.check_hashes) reader->skip_hashes();
  GetParts message{request.manifest->name,  request.manifest->pack_id, std::move(request.selection),
                   std::move(request.have), std::move(partial),        request.urgency};
  Result<void> answered = co_await exchange(std::move(message), *reader, std::move(stop), request.dial);
  if (!answered) {
    reader->leave_unfinished();
    co_return forward_error(answered);
  }
  if (request.unfinished) request.unfinished->clear();
  co_return reader->stats();
}

/// The parts must not come before the directory does: an open is as urgent as can be, so the get is less so
/// until it has been answered.
asio::awaitable<Result<GetStats>> ClientSession::open_and_get(std::string name, FirstRequest request,
                                                              OnManifest on_manifest, OnPart on_part,
                                                              std::stop_token stop) {
  using namespace asio::experimental::awaitable_operators;
  constexpr std::uint8_t kAfterTheOpen = 1;
  if (!request.dial) request.dial = std::make_shared<UrgencyDial>(request.urgency);
  PartsReader parts(request, deliver_to(on_part));
  if (!options_.check_hashes) parts.skip_hashes();

  OpenModel open;
  open.name = name;
  open.summary_only = true;
  auto begin = [this, &parts, &on_manifest, &request](Manifest manifest) -> Result<void> {
    parts.begin(manifest.directory);
    on_manifest(std::move(manifest));
    allow_urgency(parts, *request.dial);
    return {};
  };
  ManifestReader summary(open, options_.max_directory_bytes, std::move(begin));
  GetParts get;
  get.model = std::move(name);
  get.selection = request.selection;
  get.urgency = std::max(request.dial->urgency(), kAfterTheOpen);
  get.pages = pages_for(request.selection);

  // Both frames are written before either is waited for; one that fails ends the other.
  std::stop_source ends;
  auto pass_on = [ends]() mutable { ends.request_stop(); };
  const std::stop_callback cancels(stop, std::move(pass_on));
  auto opening = end_with(exchange(std::move(open), summary, ends.get_token()), ends);
  auto getting =
      end_with(exchange(std::move(get), parts, ends.get_token(), request.dial, kAfterTheOpen), ends);
  auto both = co_await (std::move(opening) && std::move(getting));
  Result<void>& opened = std::get<0>(both);
  Result<void>& got = std::get<1>(both);
  if (!got) parts.leave_unfinished();
  const bool is_ended_by_get = !opened && !got && opened.error().code == ErrorCode::Cancelled;
  if (!opened && !is_ended_by_get) co_return forward_error(opened);
  if (!got) co_return forward_error(got);
  co_return parts.stats();
}

void ClientSession::allow_urgency(const AnswerReader& reader, const UrgencyDial& dial) {
  for (const auto& [id, pending] : pending_) {
    if (&pending->reader != &reader) continue;
    pending->least_urgency = 0;
    reprioritise(id, dial.urgency());
  }
}

asio::awaitable<Result<StatusReport>> ClientSession::status() {
  StatusReader reader;
  Result<void> answered = co_await exchange(Status(), reader, std::stop_token());
  if (!answered) co_return forward_error(answered);
  co_return reader.take();
}

asio::awaitable<Result<std::chrono::steady_clock::duration>> ClientSession::ping() {
  const auto start = std::chrono::steady_clock::now();
  PongReader reader;
  Result<void> answered = co_await exchange(Ping(), reader, std::stop_token());
  if (!answered) co_return forward_error(answered);
  co_return std::chrono::steady_clock::now() - start;
}

// For what client_session_publish.cpp says.
template asio::awaitable<Result<void>> ClientSession::exchange(Publish, AnswerReader&, std::stop_token,
                                                               std::shared_ptr<UrgencyDial>, std::uint8_t);
template asio::awaitable<Result<void>> ClientSession::exchange(Unpublish, AnswerReader&, std::stop_token,
                                                               std::shared_ptr<UrgencyDial>, std::uint8_t);

}  // namespace selvage
