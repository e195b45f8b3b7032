// SPDX-License-Identifier: MIT
//
// The server's session against clients of every kind, frame by frame.
#include <iterator>
#include <map>

#include <boost/asio/detached.hpp>
#include <gtest/gtest.h>

#include "tests/session/session_harness.h"

namespace selvage {
namespace {

using namespace std::chrono_literals;
using testing::FaultPlan;
using testing::MemoryStreamOptions;
using testing::RawPeer;
using testing::SessionHarness;
using Work = asio::awaitable<void>;

Hello hello_with(std::uint64_t credit) {
  Hello hello;
  hello.initial_credit = credit;
  return hello;
}

GetParts get_all() {
  GetParts get;
  get.model = "row";
  return get;
}

Work greet(RawPeer& peer, std::uint64_t credit = 1 << 30) {
  co_await peer.send(hello_with(credit));
  const auto ack = co_await peer.receive();
  EXPECT_TRUE(ack && ack->is(FrameType::HelloAck));
}

/// The connection ends with this error.
Work expect_end(RawPeer& peer, ErrorCode code) {
  const auto frame = co_await peer.receive_control();
  EXPECT_TRUE(frame && frame->is(FrameType::Error)) << "no error";
  if (!frame || !frame->is(FrameType::Error)) co_return;
  EXPECT_EQ(frame->header.request_id, 0u);
  EXPECT_EQ(frame->as<ErrorMessage>().error.code, code) << frame->as<ErrorMessage>().error.message;
  const auto after = co_await peer.receive();
  EXPECT_FALSE(after);
}

/// This request ends with this error, and the connection goes on.
Work expect_refused(RawPeer& peer, std::uint32_t request_id, ErrorCode code) {
  const auto frame = co_await peer.receive_control();
  EXPECT_TRUE(frame && frame->is(FrameType::Error)) << "no error";
  if (!frame || !frame->is(FrameType::Error)) co_return;
  EXPECT_EQ(frame->header.request_id, request_id);
  EXPECT_EQ(frame->as<ErrorMessage>().error.code, code) << frame->as<ErrorMessage>().error.message;
  co_await peer.send(Ping{}, 4711);
  const auto pong = co_await peer.receive_control();
  EXPECT_TRUE(pong && pong->is(FrameType::Pong) && pong->header.request_id == 4711u);
}

Work expect_whole_answer(RawPeer& peer, std::uint32_t request_id, std::uint32_t parts) {
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

TEST(ServerSession, AnswersHelloOpenAndGetInOneFlight) {
  SessionHarness harness;
  harness.folder().put("row.selvage", fake_pack_bytes(10));
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await client.send(hello_with(1 << 20));
    OpenModel open{"row"};
    co_await client.send(std::move(open), 1);
    co_await client.send(get_all(), 2);
    const auto ack = co_await client.receive();
    EXPECT_EQ(ack->as<HelloAck>().version, kProtocolVersion);
    const auto manifest = co_await client.receive();
    EXPECT_TRUE(manifest->is(FrameType::ManifestBegin));
    const auto end = co_await client.receive_control();
    EXPECT_TRUE(end->is(FrameType::RequestEnd));
    EXPECT_EQ(client.data_bytes(), manifest->as<ManifestBegin>().directory_size);
    co_await expect_whole_answer(client, 2, 19);
    client.close();
  };
  harness.run(work(peer));
  EXPECT_FALSE(harness.session().reason());
}

TEST(ServerSession, AColdClientGetsSummaryPageAndRegionInOneFlight) {
  SessionHarness harness;
  harness.folder().put("row.selvage", fake_pack_bytes(1000));
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await client.send(hello_with(1 << 20));
    OpenModel open{"row", true};
    co_await client.send(std::move(open), 1);
    GetParts get = get_all();
    get.selection.kind = Selection::Kind::Ids;
    get.selection.ids.push_back(700);
    get.pages = Pages::Needed;
    co_await client.send(get, 2);
    std::vector<FrameType> types;
    std::vector<RawPeer::Received> frames;
    for (int i = 0; i < 9; ++i) {
      const auto frame = co_await client.receive();
      types.push_back(frame->header.type);
      frames.push_back(*frame);
    }
    const std::vector<FrameType> expected = [] {
      using enum FrameType;
      return std::vector{HelloAck, ManifestBegin, Data, RequestEnd, PartBegin,
                         Data,     PartBegin,     Data, RequestEnd};
    }();
    EXPECT_EQ(types, expected);
    const auto begin = frames[1].as<ManifestBegin>();
    Directory directory = parse_summary(frames[2].payload, begin.directory_size).value();
    const PartId page = frames[4].as<PartBegin>().id;
    EXPECT_EQ(page.kind, PartKind::Page);
    EXPECT_TRUE(read_page(directory, page.region, frames[5].payload));
    EXPECT_TRUE(check_part(directory.regions[700].levels[0].part, frames[7].payload));
    client.close();
  };
  harness.run(work(peer));
}

TEST(ServerSession, ReprioritiseOvertakesAndIsIgnoredWhenLate) {
  SessionHarness harness;
  harness.folder().put("row.selvage", fake_pack_bytes(3, 1'000'000));
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await greet(client, kMinInitialCredit);
    co_await client.send(get_all(), 1);
    co_await client.send(get_all(), 2);
    Reprioritise first{0};
    co_await client.send(first, 2);
    co_await client.send(first, 99);
    co_await client.send(Ping{}, 3);
    std::optional<RawPeer::Received> frame = co_await client.receive_control();
    while (frame && !frame->is(FrameType::Pong)) frame = co_await client.receive_control();
    Credit credit{8'000'000};
    co_await client.send(credit);
    // What is left of the first comes after all of the second.
    frame = co_await client.receive_control();
    while (frame && !frame->is(FrameType::RequestEnd)) frame = co_await client.receive_control();
    EXPECT_EQ(frame->header.request_id, 2u);
    client.close();
  };
  harness.run(work(peer));
}

TEST(ServerSession, AnyFailureButBrokenProtocolEndsItsRequestAlone) {
  SessionHarness harness({.requests = 2, .ids_per_request = 3});
  harness.folder().put("row.selvage", fake_pack_bytes(10, 100'000));
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await greet(client, kMinInitialCredit);
    OpenModel none{"none"}, outside{"../row"};
    co_await client.send(std::move(none), 1);
    co_await expect_refused(client, 1, ErrorCode::NotFound);
    co_await client.send(std::move(outside), 2);
    co_await expect_refused(client, 2, ErrorCode::NotFound);

    GetParts get = get_all();
    get.pack_id = Hash{};
    co_await client.send(get, 3);
    co_await expect_refused(client, 3, ErrorCode::ModelChanged);
    get = get_all();
    get.selection.kind = Selection::Kind::Ids;
    get.selection.ids.push_back(11);
    co_await client.send(get, 4);
    co_await expect_refused(client, 4, ErrorCode::NotFound);
    get.selection.ids.assign(4, 1);
    co_await client.send(get, 5);
    co_await expect_refused(client, 5, ErrorCode::LimitExceeded);

    // Two that wait for credit, and one too many.
    co_await client.send(get_all(), 6);
    co_await client.send(get_all(), 7);
    co_await client.send(get_all(), 8);
    std::optional<RawPeer::Received> frame = co_await client.receive_control();
    while (frame && frame->is(FrameType::PartBegin)) frame = co_await client.receive_control();
    EXPECT_TRUE(frame && frame->is(FrameType::Error));
    EXPECT_EQ(frame->header.request_id, 8u);
    EXPECT_EQ(parse<ErrorMessage>(frame->payload)->error.code, ErrorCode::LimitExceeded);
    client.close();
  };
  harness.run(work(peer));
}

TEST(ServerSession, CancelEndsARequestAndOthersGoOn) {
  SessionHarness harness;
  harness.folder().put("row.selvage", fake_pack_bytes(100, 100'000));
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await greet(client, kMinInitialCredit);
    co_await client.send(get_all(), 1);
    const auto begin = co_await client.receive_control();
    EXPECT_TRUE(begin->is(FrameType::PartBegin));
    co_await client.send(Cancel{}, 1);
    co_await expect_refused(client, 1, ErrorCode::Cancelled);
    EXPECT_LE(client.data_bytes(), kMinInitialCredit);
    co_await client.send(Cancel{}, 1);  // late: there is nothing to cancel any more
    co_await client.send(Cancel{}, 99);
    Credit credit{200'000};
    co_await client.send(credit);
    GetParts one = get_all();
    one.selection.kind = Selection::Kind::Ids;
    one.selection.ids.push_back(7);
    co_await client.send(one, 2);
    co_await expect_whole_answer(client, 2, 1);
    client.close();
  };
  harness.run(work(peer));
}

TEST(ServerSession, AnswersPingsWhileDataWaitsForCredit) {
  SessionHarness harness;
  harness.folder().put("row.selvage", fake_pack_bytes(10, 100'000));
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await greet(client, kMinInitialCredit);
    co_await client.send(get_all(), 1);
    const auto begin = co_await client.receive_control();
    EXPECT_TRUE(begin->is(FrameType::PartBegin));
    co_await client.send(Ping{}, 5);
    const auto pong = co_await client.receive_control();
    EXPECT_TRUE(pong->is(FrameType::Pong));
    client.close();
  };
  harness.run(work(peer));
}

/// Receives Data until `total` bytes of it have come; how much of that for each request.
asio::awaitable<std::map<std::uint32_t, std::size_t>> receive_data(RawPeer& peer, std::size_t total) {
  std::map<std::uint32_t, std::size_t> data;
  for (std::size_t sum = 0; sum < total;) {
    const std::optional<RawPeer::Received> frame = co_await peer.receive();
    EXPECT_TRUE(frame);
    if (!frame) break;
    if (!frame->is(FrameType::Data)) continue;
    data[frame->header.request_id] += frame->payload.size();
    sum += frame->payload.size();
  }
  co_return data;
}

TEST(ServerSession, AnswersToWhatCameTogetherGoTogether) {
  MemoryStreamOptions options;
  SessionHarness harness({}, options);
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client, const FaultPlan& server) -> Work {
    co_await greet(client);
    const std::size_t before = server.operations;
    Bytes pings;
    for (std::uint32_t id = 1; id <= 30; ++id)
      std::ranges::copy(to_frame(Ping{}, id), std::back_inserter(pings));
    co_await client.send_bytes(std::move(pings));
    for (std::uint32_t id = 1; id <= 30; ++id) {
      const auto pong = co_await client.receive();
      EXPECT_TRUE(pong && pong->is(FrameType::Pong) && pong->header.request_id == id);
    }
    EXPECT_LE(server.operations - before, 3u);  // a read, a write, and the next read
    client.close();
  };
  harness.run(work(peer, *options.first_fault));
}

TEST(ServerSession, RequestsOfEqualUrgencyShareTheConnection) {
  SessionHarness harness;
  harness.folder().put("row.selvage", fake_pack_bytes(20, 1'000'000));
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await greet(client);
    for (std::uint32_t id = 1; id <= 3; ++id) co_await client.send(get_all(), id);
    co_await client.send(Ping{}, 9);
    std::optional<RawPeer::Received> frame = co_await client.receive_control();
    while (frame && !frame->is(FrameType::Pong)) frame = co_await client.receive_control();
    // All are under way; what went before is not counted.
    const std::map<std::uint32_t, std::size_t> data = co_await receive_data(client, 3'000'000);
    for (std::uint32_t id = 1; id <= 3; ++id) {
      EXPECT_NEAR(static_cast<double>(data.at(id)), 1e6, 3.0 * ByteStream::kUsualWrite) << id;
    }
    client.close();
  };
  harness.run(work(peer));
}

TEST(ServerSession, ClientsShareTheServer) {
  SessionHarness harness;
  harness.folder().put("row.selvage", fake_pack_bytes(40, 1'000'000));
  RawPeer modest(harness.connect()), greedy(harness.connect());
  std::size_t taken = 0;
  const auto take_all = [](RawPeer& client, std::size_t& bytes) -> Work {
    co_await greet(client);
    for (std::uint32_t id = 1; id <= 20; ++id) co_await client.send(get_all(), id);
    while (const std::optional<RawPeer::Received> frame = co_await client.receive()) {
      if (frame->is(FrameType::Data)) bytes += frame->payload.size();
    }
  };
  const auto take_some = [](RawPeer& client, RawPeer& other, std::size_t& bytes) -> Work {
    co_await greet(client);
    co_await client.send(get_all(), 1);
    (void)co_await receive_data(client, 1'000'000);  // the other has begun, too
    const std::size_t before = bytes;
    (void)co_await receive_data(client, 10'000'000);
    EXPECT_GT(bytes - before, 1'000'000u);
    EXPECT_LT(bytes - before, 20'000'000u) << "twenty requests count as much as one";
    client.close();
    other.close();
  };
  asio::co_spawn(harness.executor(), take_all(greedy, taken), asio::detached);
  harness.run(take_some(modest, greedy, taken));
}

TEST(ServerSession, ForgetsTheModelThatWasOpenedFirst) {
  const auto old_row = fake_pack_bytes(3), new_row = fake_pack_bytes(4);
  for (const std::uint32_t most : {1u, 2u}) {
    SessionHarness harness({.opened_models = most});
    harness.folder().put("row.selvage", old_row);
    harness.folder().put("other.selvage", old_row);
    RawPeer peer(harness.connect());
    const auto work = [](RawPeer& client, const TempFolder& folder, Bytes fresh, Hash id,
                         bool forgets) -> Work {
      co_await greet(client);
      OpenModel row{"row"}, other{"other"};
      co_await client.send(std::move(row), 1);
      co_await expect_whole_answer(client, 1, 0);
      co_await client.send(std::move(other), 2);
      co_await expect_whole_answer(client, 2, 0);
      folder.put("row.selvage", fresh);
      GetParts get = get_all();
      get.pack_id = id;
      co_await client.send(get, 3);
      if (forgets) {
        co_await expect_refused(client, 3, ErrorCode::ModelChanged);
      } else {
        co_await expect_whole_answer(client, 3, 5);
      }
      client.close();
    };
    const Hash id = Pack::from_bytes(old_row).value()->id();
    harness.run(work(peer, harness.folder(), new_row, id, most == 1));
  }
}

TEST(ServerSession, APackThatIsCutShortEndsTheRequestAlone) {
  survive_truncated_files();
  SessionHarness harness;
  harness.folder().put("row.selvage", fake_pack_bytes(10, 100'000));
  harness.folder().put("other.selvage", fake_pack_bytes(3));
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client, const TempFolder& folder) -> Work {
    co_await greet(client, kMinInitialCredit);
    co_await client.send(get_all(), 1);
    std::optional<RawPeer::Received> frame = co_await client.receive_control();
    EXPECT_TRUE(frame && frame->is(FrameType::PartBegin));
    std::filesystem::resize_file(folder.path() / "row.selvage", 5000);
    Credit credit{10'000'000};
    co_await client.send(credit);
    while (frame && frame->is(FrameType::PartBegin)) frame = co_await client.receive_control();
    EXPECT_TRUE(frame && frame->is(FrameType::Error));
    EXPECT_EQ(frame->as<ErrorMessage>().error.code, ErrorCode::BadStream);
    co_await client.send(get_all(), 2);
    co_await expect_refused(client, 2, ErrorCode::BadStream);
    OpenModel other{"other"};
    co_await client.send(std::move(other), 3);
    co_await expect_whole_answer(client, 3, 0);
    client.close();
  };
  harness.run(work(peer, harness.folder()));
}

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

TEST(ServerSession, AnEndSaysWhyAndReadsOnUntilTheClientLeaves) {
  SessionHarness harness;
  RawPeer peer(harness.connect());
  const auto work = [](RawPeer& client) -> Work {
    co_await client.send(Ping{}, 1);
    const auto frame = co_await client.receive();
    EXPECT_TRUE(frame && frame->is(FrameType::Error));
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
    co_await client.send(Ping{}, 1);
    const auto frame = co_await client.receive();
    EXPECT_TRUE(frame && frame->is(FrameType::Error));
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
