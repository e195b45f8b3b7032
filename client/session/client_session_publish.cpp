// SPDX-License-Identifier: MIT
//
// What a publisher does with a session: sends a mesh, or takes a model away.
#include "client/session/client_session.h"

#include <algorithm>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>

namespace selvage {

/// Shared between publish(), which waits for the answer, and upload(), which sends.
struct ClientSession::UploadState {
  PublishRequest request;
  OnPublishState on_state;
  std::uint64_t offset = 0;
  std::stop_source failed;       ///< cancels the request because reading failed ...
  std::optional<Error> failure;  ///< ... with this
  bool is_over = false;
};

asio::awaitable<Result<Published>> ClientSession::publish(PublishRequest request, OnPublishState on_state,
                                                          std::stop_token stop) {
  const auto state = std::make_shared<UploadState>();
  state->request = std::move(request);
  state->on_state = std::move(on_state);
  auto on_ready = [this, state](std::uint32_t request_id, std::uint64_t offset) {
    state->offset = offset;
    asio::co_spawn(executor(), upload(request_id, state), asio::detached);
  };
  auto on_progress = [state](const PublishProgress& progress) {
    const PublishState now{state->request.what.size_bytes, progress};
    state->on_state(now);
  };
  PublishReader reader(state->request.what.size_bytes, std::move(on_ready), std::move(on_progress));
  auto pass_on = [state] { state->failed.request_stop(); };
  const std::stop_callback cancels(stop, std::move(pass_on));
  Publish message = state->request.what;
  Result<void> answered = co_await exchange(std::move(message), reader, state->failed.get_token());
  state->is_over = true;
  wake_upload_.notify();
  if (state->failure) co_return tl::unexpected(*state->failure);
  if (!answered) co_return forward_error(answered);
  co_return reader.take();
}

/// Sends the file in Data frames, never more than one ahead of the writer: what waits for a slow connection
/// waits in the file.
asio::awaitable<void> ClientSession::upload(std::uint32_t request_id, std::shared_ptr<UploadState> state) {
  const std::shared_ptr<ClientSession> self = shared_from_this();
  const std::uint64_t size = state->request.what.size_bytes;
  std::vector<std::byte> frame;
  const std::stop_token stop = state->failed.get_token();
  while (state->offset < size && !state->is_over && !stop.stop_requested() && !ended_) {
    if (!outgoing_.empty()) {
      co_await wake_upload_.wait();
      continue;
    }
    frame.resize(kFrameHeaderSize + std::min<std::uint64_t>(kMaxDataPayload, size - state->offset));
    const Result<std::size_t> count =
        state->request.read(state->offset, std::span(frame).subspan(kFrameHeaderSize));
    if (!count || *count == 0) {
      state->failure = count ? Error{ErrorCode::Io, "the file has become shorter"} : count.error();
      state->failed.request_stop();
      co_return;
    }
    frame.resize(kFrameHeaderSize + *count);
    state->offset += *count;
    const FrameHeader header{static_cast<std::uint32_t>(*count), FrameType::Data,
                             state->offset == size ? kFlagEnd : std::uint8_t{0}, request_id, 0};
    write_header(header, HeaderBytes(frame.data(), kFrameHeaderSize));
    outgoing_.insert(outgoing_.end(), frame.begin(), frame.end());
    wake_writer_.notify();
    const PublishState now{state->offset, PublishProgress()};
    state->on_state(now);
  }
}

asio::awaitable<Result<void>> ClientSession::unpublish(std::string name) {
  EndReader reader;
  Unpublish request{std::move(name)};
  co_return co_await exchange(std::move(request), reader, std::stop_token());
}

}  // namespace selvage
