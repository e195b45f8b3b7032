// SPDX-License-Identifier: MIT
//
// How the server's sessions end, and what they bear: broken protocol, clients that waste time or memory,
// shutdown.
#include <vector>

#include <boost/asio/detached.hpp>
#include <gtest/gtest.h>

#include "tests/session/client_moves.h"
#include "tests/session/session_harness.h"

namespace selvage {
namespace {

using namespace std::chrono_literals;
using namespace testing;

// ---- what ends a connection
// ----------------------------------------------------------------------------------

using Bytes = std::vector<std::byte>;

struct Offence {
  const char* name;
  bool greets;
  Bytes bytes;
  ErrorCode code = ErrorCode::Protocol;
};

Bytes raw_frame(FrameHeader header, std::size_t payload = 0) {
  Bytes bytes(kFrameHeaderSize + payload);
  write_header(header, HeaderBytes(bytes.data(), kFrameHeaderSize));
  return bytes;
}

Bytes text(std::string_view characters) {
  const auto bytes = std::as_bytes(std::span(characters));
  return {bytes.begin(), bytes.end()};
}

std::vector<Offence> offences() {
  Hello future;
  future.min_version = 2;
  future.max_version = 9;
  Hello stingy;
  stingy.initial_credit = 10;
  return {
      {"http", false, text("GET / HTTP/1.1\r\nHost: example.org\r\n\r\n")},
      {"no_hello", false, to_frame(OpenModel{"row"}, 1)},
      {"hello_of_the_future", false, to_frame(future, 0), ErrorCode::Unsupported},
      {"hello_with_too_little_credit", false, to_frame(stingy, 0)},
      {"second_hello", true, to_frame(Hello{}, 0)},
      {"unknown_type", true, raw_frame({0, static_cast<FrameType>(200), 0, 1, 0})},
      {"frame_beyond_the_limit", true, raw_frame({600'000, FrameType::GetParts, 0, 1, 0})},
      {"frame_beyond_the_format", true, raw_frame({0xFFFFFFFF, FrameType::GetParts, 0, 1, 0})},
      {"data", true, raw_frame({10, FrameType::Data, 0, 1, 0}, 10)},
      {"what_servers_send", true, to_frame(Pong{}, 1)},
      {"request_without_id", true, to_frame(OpenModel{"row"}, 0)},
      {"seq", true, to_frame(OpenModel{"row"}, 1, 1)},
      {"flags", true, raw_frame({0, FrameType::Ping, kFlagEnd, 1, 0})},
      {"garbage_in_a_get", true, raw_frame({100, FrameType::GetParts, 0, 1, 0}, 100)},
      {"credit_overflow", true, to_frame(Credit{0xFFFFFFFF}, 0)},
      {"ping_with_payload", true, raw_frame({3, FrameType::Ping, 0, 1, 0}, 3)},
  };
}

class BrokenProtocol : public ::testing::TestWithParam<Offence> {};

TEST_P(BrokenProtocol, EndsTheConnectionWithItsReason) {
  SessionHarness harness;
  harness.folder().put("row.selvage", fake_pack_bytes(3));
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client, Offence offence) -> Work {
    if (offence.greets) co_await greet(client, kMaxCredit);
    co_await client.send_bytes(offence.bytes);
    co_await expect_end(client, offence.code);
  };
  harness.run(work(peer, GetParam()));
  ASSERT_TRUE(harness.session().reason());
  EXPECT_EQ(harness.session().reason()->code, GetParam().code);
}

INSTANTIATE_TEST_SUITE_P(Each, BrokenProtocol, ::testing::ValuesIn(offences()),
                         [](const auto& test) { return test.param.name; });

TEST(ServerSession, EndsWhenTheClientLeavesInTheMiddleOfAFrame) {
  SessionHarness harness;
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await greet(client);
    Bytes half = to_frame(OpenModel{"row"}, 1);
    half.resize(half.size() - 1);
    co_await client.send_bytes(std::move(half));
    client.close();
  };
  harness.run(work(peer));
  EXPECT_EQ(harness.session().reason()->code, ErrorCode::Io);
}

/// Has the session end the connection, and hears why.
Work provoke_an_end(RawPeer& client) {
  co_await client.send(Ping{}, 1);  // no Hello first
  const auto frame = co_await client.receive();
  EXPECT_TRUE(frame && frame->is(FrameType::Error));
}

TEST(ServerSession, AnEndSaysWhyAndReadsOnUntilTheClientLeaves) {
  SessionHarness harness;
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await provoke_an_end(client);
    co_await client.send_bytes(Bytes(1 << 20));  // more than is under way, so it is read
    EXPECT_FALSE(client.broken());
    client.close();
  };
  harness.run(work(peer));
  EXPECT_EQ(harness.session().reason()->code, ErrorCode::Protocol);
}

TEST(ServerSession, AnEndDoesNotWaitForEver) {
  SessionHarness harness;
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await provoke_an_end(client);
    while (!client.broken()) co_await client.send_bytes(Bytes(1 << 10));
  };
  harness.run(work(peer));
}

// ---- clients that waste time or memory
// -----------------------------------------------------------------------

TEST(ServerSession, DropsAClientThatNeverSaysHello) {
  SessionHarness harness({.handshake_timeout = 5ms});
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await client.send_bytes(text("\x05"));
    co_await expect_end(client, ErrorCode::Timeout);
  };
  harness.run(work(peer));
}

TEST(ServerSession, DropsAClientThatFallsSilent) {
  SessionHarness harness({.idle_timeout = 5ms});
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await greet(client);
    co_await expect_end(client, ErrorCode::Timeout);
  };
  harness.run(work(peer));
}

TEST(ServerSession, DropsAClientThatStopsReading) {
  SessionHarness harness({.write_timeout = 5ms});
  harness.folder().put("row.selvage", fake_pack_bytes(10, 1 << 20));
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await client.send(hello_with(1 << 30));
    co_await client.send(get_all(), 1);
  };
  harness.run(work(peer));
  EXPECT_EQ(harness.session().reason()->code, ErrorCode::Timeout);
}

TEST(ServerSession, ALimitOnTheRateHoldsDataBackAndNothingElse) {
  // The burst of 64 KiB, and then so slowly that the rest does not come.
  SessionHarness harness({.bytes_per_second = 1});
  harness.folder().put("row.selvage", fake_pack_bytes(10, 100'000));
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await greet(client);
    co_await client.send(get_all(), 1);
    std::optional<RawPeer::Received> frame = co_await client.receive_control();
    EXPECT_TRUE(frame->is(FrameType::PartBegin));
    for (std::uint32_t id = 7; id < 17; ++id) {
      co_await client.send(Ping{}, id);
      frame = co_await client.receive_control();
      while (frame && frame->is(FrameType::PartBegin)) frame = co_await client.receive_control();
      EXPECT_TRUE(frame && frame->is(FrameType::Pong) && frame->header.request_id == id);
    }
    EXPECT_LE(client.data_bytes(), 64u << 10);
    co_await client.send(Cancel{}, 1);
    co_await expect_refused(client, 1, ErrorCode::Cancelled);
    client.close();
  };
  harness.run(work(peer));
}

TEST(ServerSession, ALargeRequestIsAnsweredTheSame) {
  SessionHarness harness;  // beyond what is looked up on the strand: by its size, then by the model's
  harness.folder().put("row.selvage", fake_pack_bytes(5000, 10));
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await greet(client);
    GetParts get = get_all();
    get.selection.kind = Selection::Kind::Ids;
    get.selection.ids.assign(30'000, 17);
    co_await client.send(get, 1);
    co_await expect_whole_answer(client, 1, 1);
    co_await client.send(get_all(), 2);
    co_await expect_whole_answer(client, 2, 9999);
    std::vector<std::byte> garbage(200'000, std::byte{0xFF});
    FrameHeader header{200'000, FrameType::GetParts, 0, 3, 0};
    garbage.insert(garbage.begin(), kFrameHeaderSize, std::byte{0});
    write_header(header, HeaderBytes(garbage.data(), kFrameHeaderSize));
    co_await client.send_bytes(std::move(garbage));
    co_await expect_end(client, ErrorCode::Protocol);
  };
  harness.run(work(peer));
}

TEST(ServerSession, StopsReadingFromAClientThatFloodsWithoutListening) {
  SessionHarness harness({.write_timeout = 50ms, .queued_bytes = 4096});
  RawPeer peer(harness.connect());
  std::size_t sent = 0;
  const auto work = [](RawPeer& client, std::size_t& count) -> Work {
    co_await client.send(hello_with(1 << 20));
    for (; !client.broken() && count < 1'000'000; ++count) co_await client.send(Ping{}, 1);
  };
  harness.run(work(peer, sent));
  EXPECT_EQ(harness.session().reason()->code, ErrorCode::Timeout);
  // What both directions of the connection hold, and the queue: all else was never read.
  EXPECT_LE(sent * kFrameHeaderSize, (64u << 10) + (64u << 10) + 4096 + 64 * 1024);
}

TEST(ServerSession, AFloodOfRequestsIsAnsweredInBoundedMemory) {
  SessionHarness harness({.requests = 4});
  harness.folder().put("row.selvage", fake_pack_bytes(2, 100'000));
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await greet(client, kMinInitialCredit);
    int refused = 0;
    for (std::uint32_t id = 1; id <= 1000; ++id) {
      co_await client.send(get_all(), id);
      if (id < 5) continue;
      std::optional<RawPeer::Received> frame = co_await client.receive_control();
      while (frame && frame->is(FrameType::PartBegin)) frame = co_await client.receive_control();
      refused += frame && frame->is(FrameType::Error) && frame->header.request_id == id;
    }
    EXPECT_EQ(refused, 996);
    client.close();
  };
  harness.run(work(peer));
}

// ---- shutdown
// ------------------------------------------------------------------------------------------------

TEST(ServerSession, ShutDownFinishesWhatIsInFlightAndRefusesMore) {
  SessionHarness harness;
  harness.folder().put("row.selvage", fake_pack_bytes(3, 50'000));
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client, Session& session) -> Work {
    co_await greet(client, kMinInitialCredit);
    co_await client.send(get_all(), 1);
    std::optional<RawPeer::Received> frame = co_await client.receive_control();
    EXPECT_TRUE(frame->is(FrameType::PartBegin));
    session.shut_down();
    co_await client.send(get_all(), 2);
    Credit credit{200'000};
    co_await client.send(credit);
    bool told = false, refused = false, finished = false;
    while ((frame = co_await client.receive_control())) {
      told |= frame->is(FrameType::GoAway);
      refused |= frame->is(FrameType::Error) && frame->header.request_id == 2 &&
                 frame->as<ErrorMessage>().error.code == ErrorCode::Unavailable;
      finished |= frame->is(FrameType::RequestEnd) && frame->header.request_id == 1;
    }
    EXPECT_TRUE(told);
    EXPECT_TRUE(refused);
    EXPECT_TRUE(finished);
  };
  harness.run(work(peer, harness.session()));
}

TEST(ServerSession, ShutDownEndsAnIdleConnection) {
  SessionHarness harness;
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client, Session& session) -> Work {
    co_await greet(client);
    session.shut_down();
    const auto frame = co_await client.receive();
    EXPECT_TRUE(frame && frame->is(FrameType::GoAway));
    const auto end = co_await client.receive();
    EXPECT_FALSE(end);
  };
  harness.run(work(peer, harness.session()));
}

}  // namespace
}  // namespace selvage
