// SPDX-License-Identifier: MIT
//
// What clients of a server's session do and expect, frame by frame.
#pragma once

#include <gtest/gtest.h>

#include "tests/support/raw_peer.h"

namespace selvage::testing {

using Work = asio::awaitable<void>;

inline Hello hello_with(std::uint64_t credit) {
  Hello hello;
  hello.initial_credit = credit;
  return hello;
}

inline GetParts get_all() {
  GetParts get;
  get.model = "row";
  return get;
}

inline Work greet(RawPeer& peer, std::uint64_t credit = 1 << 30) {
  co_await peer.send(hello_with(credit));
  const auto ack = co_await peer.receive();
  EXPECT_TRUE(ack && ack->is(FrameType::HelloAck));
}

/// The connection ends with this error.
inline Work expect_end(RawPeer& peer, ErrorCode code) {
  const auto frame = co_await peer.receive_control();
  EXPECT_TRUE(frame && frame->is(FrameType::Error)) << "no error";
  if (!frame || !frame->is(FrameType::Error)) co_return;
  EXPECT_EQ(frame->header.request_id, 0u);
  EXPECT_EQ(frame->as<ErrorMessage>().error.code, code) << frame->as<ErrorMessage>().error.message;
  const auto after = co_await peer.receive();
  EXPECT_FALSE(after);
}

/// This request ends with this error, and the connection goes on.
inline Work expect_refused(RawPeer& peer, std::uint32_t request_id, ErrorCode code) {
  const auto frame = co_await peer.receive_control();
  EXPECT_TRUE(frame && frame->is(FrameType::Error)) << "no error";
  if (!frame || !frame->is(FrameType::Error)) co_return;
  EXPECT_EQ(frame->header.request_id, request_id);
  EXPECT_EQ(frame->as<ErrorMessage>().error.code, code) << frame->as<ErrorMessage>().error.message;
  co_await peer.send(Ping{}, 4711);
  const auto pong = co_await peer.receive_control();
  EXPECT_TRUE(pong && pong->is(FrameType::Pong) && pong->header.request_id == 4711u);
}

inline Work expect_whole_answer(RawPeer& peer, std::uint32_t request_id, std::uint32_t parts) {
  for (;;) {
    const auto frame = co_await peer.receive_control();
    EXPECT_TRUE(frame);
    if (!frame) co_return;
    if (frame->is(FrameType::PartBegin) || frame->is(FrameType::ManifestBegin)) continue;
    EXPECT_TRUE(frame->is(FrameType::RequestEnd)) << to_string(frame->header.type);
    EXPECT_EQ(frame->header.request_id, request_id);
    if (frame->is(FrameType::RequestEnd)) {
      EXPECT_EQ(frame->as<RequestEnd>().parts, parts);
    }
    co_return;
  }
}

}  // namespace selvage::testing
