// SPDX-License-Identifier: MIT
//
// A connection's bytes as either side first sees them: cut into frames, each parsed as the message it says it
// is. The first byte sets how many bytes each read brings.
#include <algorithm>
#include <span>

#include "common/net/frame.h"
#include "common/net/messages.h"

namespace {

using namespace selvage;

void parse_any(const Frame& frame) {
  switch (frame.header.type) {
    case FrameType::Publish:
      (void)parse<Publish>(frame.payload);
      break;
    case FrameType::PublishReady:
      (void)parse<PublishReady>(frame.payload);
      break;
    case FrameType::PublishProgress:
      (void)parse<PublishProgress>(frame.payload);
      break;
    case FrameType::Published:
      (void)parse<Published>(frame.payload);
      break;
    case FrameType::Unpublish:
      (void)parse<Unpublish>(frame.payload);
      break;
    case FrameType::Status:
      (void)parse<Status>(frame.payload);
      break;
    case FrameType::StatusReport:
      (void)parse<StatusReport>(frame.payload);
      break;
    case FrameType::Hello:
      (void)parse<Hello>(frame.payload);
      break;
    case FrameType::HelloAck:
      (void)parse<HelloAck>(frame.payload);
      break;
    case FrameType::ListModels:
      (void)parse<ListModels>(frame.payload);
      break;
    case FrameType::Models:
      (void)parse<Models>(frame.payload);
      break;
    case FrameType::OpenModel:
      (void)parse<OpenModel>(frame.payload);
      break;
    case FrameType::ManifestBegin:
      (void)parse<ManifestBegin>(frame.payload);
      break;
    case FrameType::GetParts:
      (void)parse<GetParts>(frame.payload);
      break;
    case FrameType::PartBegin:
      (void)parse<PartBegin>(frame.payload);
      break;
    case FrameType::RequestEnd:
      (void)parse<RequestEnd>(frame.payload);
      break;
    case FrameType::Credit:
      (void)parse<Credit>(frame.payload);
      break;
    case FrameType::Error:
      (void)parse<ErrorMessage>(frame.payload);
      break;
    case FrameType::GoAway:
      (void)parse<GoAway>(frame.payload);
      break;
    case FrameType::Cancel:
      (void)parse<Cancel>(frame.payload);
      break;
    case FrameType::Ping:
      (void)parse<Ping>(frame.payload);
      break;
    case FrameType::Pong:
      (void)parse<Pong>(frame.payload);
      break;
    case FrameType::Reprioritise:
      (void)parse<Reprioritise>(frame.payload);
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
