// SPDX-License-Identifier: MIT
//
// One connection to a server, for coroutines. (blocking_client.h is the same for plain threads.)
//
//     auto session = co_await ClientSession::connect({"example.org", 7878}, {});
//     auto manifest = co_await (*session)->open("bunny");
//     auto stats = co_await (*session)->get({*manifest, {.ids = {3, 5}}}, [](ReceivedPart part) { ... });
//     (*session)->close();
//
// One coroutine reads, one writes; requests may overlap, each waits for its own answer. When the connection
// ends, whatever the cause, every request in flight fails with it.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "client/session/answer_reader.h"
#include "client/session/client_options.h"
#include "client/session/credit_window.h"
#include "client/session/get_request.h"
#include "common/net/byte_stream.h"
#include "common/net/deadline.h"
#include "common/net/frame.h"
#include "common/net/messages.h"
#include "common/net/signal.h"
#include "common/net/tcp_stream.h"

namespace selvage {

/// A mesh file to be published. `read` gives its bytes from an offset on, at most as many as fit; it is
/// called on the strand, and an error of it ends the publishing.
struct PublishRequest {
  Publish what;
  std::function<Result<std::size_t>(std::uint64_t offset, std::span<std::byte> into)> read;
};

/// How far publishing is, called on the strand. `sent_bytes` counts what the server held already.
struct PublishState {
  std::uint64_t sent_bytes = 0;
  PublishProgress server;  ///< once all is sent
};
using OnPublishState = std::function<void(const PublishState&)>;

/// Single-strand: call everything on executor(). It lives until close() is called or the connection ends,
/// even when nobody holds it.
class ClientSession : public std::enable_shared_from_this<ClientSession> {
 public:
  /// Connects and greets. NotFound, Unavailable, Timeout; Unauthorised if either side does not accept the
  /// other; Unsupported if the versions do not meet; Protocol.
  /// The session's strand is the executor of the caller, which must be one.
  static asio::awaitable<Result<std::shared_ptr<ClientSession>>> connect(HostPort server,
                                                                         ClientOptions options);
  /// The same over a stream that is connected already.
  static asio::awaitable<Result<std::shared_ptr<ClientSession>>> start(std::unique_ptr<ByteStream> stream,
                                                                       ClientOptions options);

  /// All models, ascending by name.
  asio::awaitable<Result<std::vector<ModelInfo>>> list();

  /// NotFound; BadStream if the server's pack is damaged or its directory is not what it says; Cancelled.
  asio::awaitable<Result<std::shared_ptr<const Manifest>>> open(std::string name, std::stop_token stop = {});

  /// Called on the strand with each part as it completes; must not block. Parts may come in any order.
  using OnPart = std::function<void(ReceivedPart)>;
  /// Called on the strand with the directory, which may lack pages: see open_and_get.
  using OnManifest = std::function<void(Manifest)>;

  /// Fetches the selected parts. ModelChanged if the server has another pack by now; BadStream if a part is
  /// not what the directory lists; Cancelled soon after `stop` is requested (from any thread), and no part
  /// after it. The request's dial changes its urgency on the server while it runs.
  asio::awaitable<Result<GetStats>> get(GetRequest request, OnPart on_part, std::stop_token stop = {});

  /// open() and get() in one flight, of whichever pack has the name. `on_manifest` is called once, before any
  /// part, with what the summary page says. The pages that list the parts are among the parts, each before
  /// what it lists. All others follow the parts, unless the selection is by ids: see pages_for.
  asio::awaitable<Result<GetStats>> open_and_get(std::string name, FirstRequest request,
                                                 OnManifest on_manifest, OnPart on_part,
                                                 std::stop_token stop = {});

  /// Uploads a mesh and waits until it is a model of the server; one at a time. Unauthorised without the
  /// scope; InvalidArgument if the name is in use and not to be replaced; what selvage-pack says of a bad
  /// mesh; Cancelled. Asked again after the connection was lost, it goes on where it was. A stop waits a
  /// moment for the server, so that nothing is left there; it may come too late, then it was published.
  asio::awaitable<Result<Published>> publish(PublishRequest request, OnPublishState on_state,
                                             std::stop_token stop = {});
  asio::awaitable<Result<void>> unpublish(std::string name);

  asio::awaitable<Result<StatusReport>> status();

  /// How long a round trip takes.
  asio::awaitable<Result<std::chrono::steady_clock::duration>> ping();

  /// Ends the connection; requests in flight fail with Cancelled.
  void close();

  asio::any_io_executor executor() { return stream_->executor(); }
  const HelloAck& server() const { return server_; }

 private:
  /// A request that waits for its answer; lives in the coroutine that waits.
  struct Pending {
    AnswerReader& reader;
    Signal answered;
    std::optional<Result<void>> outcome;
    std::uint32_t next_seq = 0;
    std::uint8_t urgency = kUsualUrgency;  ///< that the server knows of
    std::uint8_t least_urgency = 0;        ///< not more urgent than this for now
    bool is_promise = false;               ///< the server goes on with it unless it hears of a Cancel
    std::optional<std::chrono::steady_clock::time_point>
        give_up_at;  ///< cancelled; waits for the server's word
  };
  class PendingEntry;
  class CloseUnlessKept;
  class DialListener;

  ClientSession(std::unique_ptr<ByteStream> stream, ClientOptions options);

  asio::awaitable<Result<void>> greet();
  asio::awaitable<void> run();
  Result<void> handle_greeting(const Frame& frame);
  Error no_answer() const;
  asio::awaitable<void> read_loop();
  asio::awaitable<void> write_loop();
  asio::awaitable<void> heartbeat();

  Result<void> handle(const Frame& frame);
  Result<void> handle_connection_frame(const Frame& frame);
  Result<void> handle_answer(const Frame& frame);
  void grant();

  template <class Message>
  asio::awaitable<Result<void>> exchange(Message message, AnswerReader& reader, std::stop_token stop,
                                         std::shared_ptr<UrgencyDial> dial = {},
                                         std::uint8_t least_urgency = 0);
  void allow_urgency(const AnswerReader& reader, const UrgencyDial& dial);
  PartsReader::OnPart deliver_to(OnPart& on_part);
  struct UploadState;
  asio::awaitable<void> upload(std::uint32_t request_id, std::shared_ptr<UploadState> state);

  template <class Message>
  void send(const Message& message, std::uint32_t request_id);
  void cancel(std::uint32_t request_id);
  void reprioritise(std::uint32_t request_id, std::uint8_t urgency);
  void settle(Pending& pending, Result<void> outcome);
  void abandon(std::uint32_t request_id);
  void end(Error reason);

  std::unique_ptr<ByteStream> stream_;
  const ClientOptions options_;
  HelloAck server_;  ///< before it has greeted, what servers usually accept

  FrameBuffer incoming_;
  std::vector<std::byte> outgoing_;  ///< whole frames for the next write
  Signal wake_writer_;
  Signal wake_upload_;  ///< the writer has taken what was to be sent
  Deadline greeting_;
  Signal greeted_;
  bool is_greeted_ = false;
  std::chrono::steady_clock::time_point last_heard_;

  std::uint32_t last_request_id_ = 0;
  std::map<std::uint32_t, Pending*> pending_;
  std::set<std::uint32_t> abandoned_;  ///< cancelled without waiting: what still comes for them is dropped
  CreditWindow window_;
  std::shared_ptr<ConsumedBytes> consumed_;

  std::optional<std::string> going_away_;  ///< the server's reason
  std::optional<Error> ended_;             ///< why there is no connection any more
};

}  // namespace selvage
