// SPDX-License-Identifier: MIT
//
// The server's session against clients of every kind, frame by frame.
#include <iterator>
#include <map>

#include <boost/asio/detached.hpp>
#include <gtest/gtest.h>

#include "tests/session/client_moves.h"
#include "tests/session/session_harness.h"

namespace selvage {
namespace {

using namespace std::chrono_literals;
using namespace testing;

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

}  // namespace
}  // namespace selvage
