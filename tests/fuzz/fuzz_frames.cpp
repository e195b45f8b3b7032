// SPDX-License-Identifier: MIT
//
// A connection's bytes as either side first sees them: cut into frames, each parsed as the message it says it
// is. The first byte sets how many bytes each read brings. What is taken for a message can be said again, and
// then means the same.
#include <algorithm>
#include <cstdlib>
#include <span>

#include "common/net/frame.h"
#include "common/net/messages.h"

namespace {

using namespace selvage;

void require(bool claim) {
  if (!claim) std::abort();
}

template <class Message>
void take(std::span<const std::byte> payload) {
  const auto message = parse<Message>(payload);
  if (!message) return require(message.error().code == ErrorCode::Protocol);
  const auto frame = to_frame(*message, 1);
  const auto again = parse<Message>(std::span(frame).subspan(kFrameHeaderSize));
  require(again.has_value());
  require(to_frame(*again, 1) == frame);
}

void parse_any(const Frame& frame) {
  switch (frame.header.type) {
    case FrameType::Publish:
      take<Publish>(frame.payload);
      break;
    case FrameType::PublishReady:
      take<PublishReady>(frame.payload);
      break;
    case FrameType::PublishProgress:
      take<PublishProgress>(frame.payload);
      break;
    case FrameType::Published:
      take<Published>(frame.payload);
      break;
    case FrameType::Unpublish:
      take<Unpublish>(frame.payload);
      break;
    case FrameType::Status:
      take<Status>(frame.payload);
      break;
    case FrameType::StatusReport:
      take<StatusReport>(frame.payload);
      break;
    case FrameType::Hello:
      take<Hello>(frame.payload);
      break;
    case FrameType::HelloAck:
      take<HelloAck>(frame.payload);
      break;
    case FrameType::ListModels:
      take<ListModels>(frame.payload);
      break;
    case FrameType::Models:
      take<Models>(frame.payload);
      break;
    case FrameType::OpenModel:
      take<OpenModel>(frame.payload);
      break;
    case FrameType::ManifestBegin:
      take<ManifestBegin>(frame.payload);
      break;
    case FrameType::GetParts:
      take<GetParts>(frame.payload);
      break;
    case FrameType::PartBegin:
      take<PartBegin>(frame.payload);
      break;
    case FrameType::RequestEnd:
      take<RequestEnd>(frame.payload);
      break;
    case FrameType::Credit:
      take<Credit>(frame.payload);
      break;
    case FrameType::Error:
      take<ErrorMessage>(frame.payload);
      break;
    case FrameType::GoAway:
      take<GoAway>(frame.payload);
      break;
    case FrameType::Cancel:
      take<Cancel>(frame.payload);
      break;
    case FrameType::Ping:
      take<Ping>(frame.payload);
      break;
    case FrameType::Pong:
      take<Pong>(frame.payload);
      break;
    case FrameType::Reprioritise:
      take<Reprioritise>(frame.payload);
      break;
    case FrameType::Data:
      break;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::size_t step = data[0] + std::size_t{1};
  auto bytes = std::as_bytes(std::span(data + 1, size - 1));
  FrameBuffer buffer(kMaxPayload, 64);
  while (!bytes.empty()) {
    const auto room = buffer.writable();
    const auto read = bytes.first(std::min({step, room.size(), bytes.size()}));
    std::ranges::copy(read, room.begin());
    buffer.commit(read.size());
    bytes = bytes.subspan(read.size());
    for (;;) {
      const auto frame = buffer.take();
      if (!frame) return 0;
      if (!frame->has_value()) break;
      parse_any(**frame);
    }
  }
  return 0;
}
