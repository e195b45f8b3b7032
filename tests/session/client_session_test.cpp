// SPDX-License-Identifier: MIT
//
// The client's session against servers that lie, stall or break; and both sessions over a connection whose
// nth operation fails.
#include <boost/asio/detached.hpp>
#include <gtest/gtest.h>

#include "tests/session/session_harness.h"

namespace selvage {
namespace {

using namespace std::chrono_literals;
using testing::FaultPlan;
using testing::make_memory_streams;
using testing::MemoryStreamOptions;
using testing::RawPeer;
using testing::SessionHarness;
using Work = asio::awaitable<void>;
using Bytes = std::vector<std::byte>;

constexpr auto ignore_part = [](ReceivedPart) {};

// ---- servers that lie
// ----------------------------------------------------------------------------------------

/// A client and, by hand, its server.
class LyingServer : public ::testing::Test {
 protected:
  using Script = Work (*)(RawPeer&, const Pack&);

  /// What get(region 2 of 3) comes to when the server answers the get as `script` does.
  Result<GetStats> get_from(Script script, ClientOptions options = {}) {
    Result<GetStats> outcome = fail(ErrorCode::InvalidArgument, "no outcome");
    SessionHarness harness;  // runs coroutines; its own session stays unused
    auto [client_end, server_end] = make_memory_streams(harness.executor());
    RawPeer server(std::move(server_end));
    const auto pack = Pack::from_bytes(fake_pack_bytes(3, 1000)).value();
    asio::co_spawn(harness.executor(), serve(server, *pack, script), asio::detached);
    harness.run(fetch(std::move(client_end), options, outcome));
    return outcome;
  }

 private:
  static Work serve(RawPeer& server, const Pack& pack, Script script) {
    const auto hello = co_await server.receive();
    EXPECT_TRUE(hello && hello->is(FrameType::Hello));
    HelloAck ack;
    ack.max_message_bytes = 100'000;
    ack.max_ids = 100;
    ack.idle_timeout_ms = 60'000;
    co_await server.send(std::move(ack));
    const auto open = co_await server.receive();
    EXPECT_TRUE(open && open->is(FrameType::OpenModel));
    const auto directory = pack.directory_bytes();
    ManifestBegin begin{pack.id(), pack.header().summary_size, directory.size(), directory.size()};
    co_await server.send(begin, open->header.request_id, 0);
    Bytes bytes(directory.begin(), directory.end());
    co_await server.send_data(open->header.request_id, 1, std::move(bytes), true);
    RequestEnd end{0, directory.size(), 0};
    co_await server.send(end, open->header.request_id, 2);
    const auto get = co_await server.receive();
    if (!get) co_return;
    EXPECT_TRUE(get->is(FrameType::GetParts));
    EXPECT_EQ(get->header.request_id, 2u);
    co_await script(server, pack);
    std::optional<RawPeer::Received> more = co_await server.receive();
    while (more) more = co_await server.receive();
    server.close();
  }

  static Work fetch(std::unique_ptr<ByteStream> stream, ClientOptions options, Result<GetStats>& outcome) {
    const auto session = co_await ClientSession::start(std::move(stream), options);
    EXPECT_TRUE(session);
    const auto manifest = co_await (*session)->open("row");
    EXPECT_TRUE(manifest);
    GetRequest request;
    request.manifest = *manifest;
    request.selection.kind = Selection::Kind::Ids;
    request.selection.ids.push_back(2);
    outcome = co_await (*session)->get(std::move(request), ignore_part);
    (*session)->close();
  }
};

const PartRef& region_2(const Pack& pack) { return pack.directory().regions[2].levels[0].part; }
Bytes bytes_of_2(const Pack& pack) {
  const auto part = pack.part(region_2(pack));
  return {part.begin(), part.end()};
}
PartBegin begin_2(const Pack& pack) { return {{PartKind::Region, 2, 0}, 1000, 0, region_2(pack).hash}; }

TEST_F(LyingServer, TheTruthIsAccepted) {
  const auto stats = get_from([](RawPeer& server, const Pack& pack) -> Work {
    co_await server.send(begin_2(pack), 2, 0);
    co_await server.send_data(2, 1, bytes_of_2(pack), true);
    RequestEnd end{1, 1000, 0};
    co_await server.send(end, 2, 2);
  });
  ASSERT_TRUE(stats) << stats.error().message;
  EXPECT_EQ(stats->parts, 1u);
}

TEST_F(LyingServer, WrongBytes) {
  const auto stats = get_from([](RawPeer& server, const Pack& pack) -> Work {
    co_await server.send(begin_2(pack), 2, 0);
    Bytes bytes = bytes_of_2(pack);
    bytes[500] ^= std::byte{1};
    co_await server.send_data(2, 1, std::move(bytes), true);
  });
  EXPECT_EQ(stats.error().code, ErrorCode::BadStream);
  EXPECT_NE(stats.error().message.find("region 2"), std::string::npos);
}

TEST_F(LyingServer, APartNotAskedFor) {
  const auto stats = get_from([](RawPeer& server, const Pack& pack) -> Work {
    PartBegin begin = begin_2(pack);
    begin.id.region = 1;
    co_await server.send(begin, 2, 0);
  });
  EXPECT_EQ(stats.error().code, ErrorCode::BadStream);
}

TEST_F(LyingServer, APartTwice) {
  const auto stats = get_from([](RawPeer& server, const Pack& pack) -> Work {
    co_await server.send(begin_2(pack), 2, 0);
    co_await server.send_data(2, 1, bytes_of_2(pack), true);
    co_await server.send(begin_2(pack), 2, 2);
  });
  EXPECT_EQ(stats.error().code, ErrorCode::BadStream);
}

TEST_F(LyingServer, AnotherSizeThanTheDirectorys) {
  const auto stats = get_from([](RawPeer& server, const Pack& pack) -> Work {
    PartBegin begin = begin_2(pack);
    begin.size = 0xFFFFFFFF;
    co_await server.send(begin, 2, 0);
  });
  EXPECT_EQ(stats.error().code, ErrorCode::BadStream);
}

TEST_F(LyingServer, MoreDataThanThePart) {
  const auto stats = get_from([](RawPeer& server, const Pack& pack) -> Work {
    co_await server.send(begin_2(pack), 2, 0);
    Bytes bytes(1001);
    co_await server.send_data(2, 1, std::move(bytes), true);
  });
  EXPECT_EQ(stats.error().code, ErrorCode::Protocol);
}

TEST_F(LyingServer, AnEndBeforeAllParts) {
  const auto stats = get_from([](RawPeer& server, const Pack&) -> Work {
    RequestEnd end{1, 1000, 0};
    co_await server.send(end, 2, 0);
  });
  EXPECT_EQ(stats.error().code, ErrorCode::BadStream);
}

TEST_F(LyingServer, AFrameLeftOut) {
  const auto stats = get_from([](RawPeer& server, const Pack& pack) -> Work {
    co_await server.send(begin_2(pack), 2, 0);
    co_await server.send_data(2, 2, bytes_of_2(pack), true);
  });
  EXPECT_EQ(stats.error().code, ErrorCode::Protocol);
}

TEST_F(LyingServer, AnAnswerToNobody) {
  const auto stats =
      get_from([](RawPeer& server, const Pack& pack) -> Work { co_await server.send(begin_2(pack), 3, 0); });
  EXPECT_EQ(stats.error().code, ErrorCode::Protocol);
}

TEST_F(LyingServer, MoreThanWasGranted) {
  const auto stats = get_from(
      [](RawPeer& server, const Pack&) -> Work {
        for (std::uint32_t seq = 0; seq < 3; ++seq) {
          Bytes bytes(kMaxDataPayload);
          co_await server.send_data(77, seq, std::move(bytes), false);
        }
      },
      {.window_bytes = kMinInitialCredit});
  EXPECT_EQ(stats.error().code, ErrorCode::Protocol);
}

TEST_F(LyingServer, AnErrorKeepsItsCode) {
  const auto stats = get_from([](RawPeer& server, const Pack&) -> Work {
    ErrorMessage message;
    message.error = Error{ErrorCode::ModelChanged, "another pack"};
    co_await server.send(message, 2, 0);
  });
  EXPECT_EQ(stats.error().code, ErrorCode::ModelChanged);
  EXPECT_EQ(stats.error().message, "another pack");
}

TEST_F(LyingServer, Silence) {
  const auto stats = get_from([](RawPeer&, const Pack&) -> Work { co_return; }, {.silence_timeout = 15ms});
  EXPECT_EQ(stats.error().code, ErrorCode::Timeout);
}

TEST_F(LyingServer, LeavingInTheMiddle) {
  const auto stats = get_from([](RawPeer& server, const Pack& pack) -> Work {
    co_await server.send(begin_2(pack), 2, 0);
    server.close();
  });
  EXPECT_EQ(stats.error().code, ErrorCode::Io);
}

TEST_F(LyingServer, LeavingAfterGoAway) {
  const auto stats = get_from([](RawPeer& server, const Pack&) -> Work {
    GoAway away{"maintenance"};
    co_await server.send(away, 0, 0);
    server.close();
  });
  EXPECT_EQ(stats.error().code, ErrorCode::Unavailable);
  EXPECT_EQ(stats.error().message, "maintenance");
}

TEST_F(LyingServer, AFrontLeftOutThatNobodyHas) {
  const auto stats = get_from([](RawPeer& server, const Pack& pack) -> Work {
    PartBegin begin = begin_2(pack);
    begin.offset = 500;
    co_await server.send(begin, 2, 0);
  });
  EXPECT_EQ(stats.error().code, ErrorCode::BadStream);
}

// ---- answers that break off
// ----------------------------------------------------------------------------------

/// The session of a real server breaks at its nth operation; the same get over a new connection brings the
/// rest.
// ---- and lie at once
// -----------------------------------------------------------------------------------------

/// What opening and getting region 2 of 3 in one flight comes to, where the server answers as `script` does:
/// the open is request 1, the get request 2.
Result<GetStats> open_and_get_from(Work (*script)(RawPeer&, const Pack&)) {
  Result<GetStats> outcome = fail(ErrorCode::InvalidArgument, "no outcome");
  SessionHarness harness;
  auto [client_end, server_end] = make_memory_streams(harness.executor());
  RawPeer server(std::move(server_end));
  const auto pack = Pack::from_bytes(fake_pack_bytes(3, 1000)).value();
  const auto serve = [](RawPeer& peer, const Pack& served, Work (*play)(RawPeer&, const Pack&)) -> Work {
    for (const FrameType type : {FrameType::Hello, FrameType::OpenModel, FrameType::GetParts}) {
      const auto frame = co_await peer.receive();
      EXPECT_TRUE(frame && frame->is(type)) << "the client waits for an answer";
    }
    HelloAck ack;
    ack.max_message_bytes = 100'000;
    ack.max_ids = 100;
    ack.idle_timeout_ms = 60'000;
    co_await peer.send(std::move(ack));
    co_await play(peer, served);
    std::optional<RawPeer::Received> more = co_await peer.receive();
    while (more) more = co_await peer.receive();
    peer.close();
  };
  const auto fetch = [](std::unique_ptr<ByteStream> stream, Result<GetStats>& into) -> Work {
    ClientOptions options;
    options.await_greeting = false;
    const auto session = co_await ClientSession::start(std::move(stream), options);
    EXPECT_TRUE(session);
    FirstRequest request;
    request.selection.kind = Selection::Kind::Ids;
    request.selection.ids.push_back(2);
    request.urgency = 0;
    auto ignore_manifest = [](const Manifest&) {};
    into = co_await (*session)->open_and_get("row", std::move(request), ignore_manifest, ignore_part);
    (*session)->close();
  };
  asio::co_spawn(harness.executor(), serve(server, *pack, script), asio::detached);
  harness.run(fetch(std::move(client_end), outcome));
  return outcome;
}

Work send_summary(RawPeer& server, const Pack& pack) {
  const auto directory = pack.directory_bytes();
  const auto summary = directory.first(pack.header().summary_size);
  ManifestBegin begin{pack.id(), pack.header().summary_size, directory.size(), summary.size()};
  co_await server.send(begin, 1, 0);
  Bytes bytes(summary.begin(), summary.end());
  co_await server.send_data(1, 1, std::move(bytes), true);
  RequestEnd end{0, summary.size(), 0};
  co_await server.send(end, 1, 2);
}

Work send_page(RawPeer& server, const Pack& pack, std::size_t wrong_byte) {
  const PartRef& ref = pack.directory().pages[0].part;
  const auto part = pack.part(ref);
  PartBegin begin{{PartKind::Page, 0, 0}, ref.size, 0, ref.hash};
  co_await server.send(begin, 2, 0);
  Bytes bytes(part.begin(), part.end());
  if (wrong_byte < bytes.size()) bytes[wrong_byte] ^= std::byte{1};
  co_await server.send_data(2, 1, std::move(bytes), true);
}
constexpr std::size_t kNoByte = ~std::size_t{0};

TEST(FirstFlight, TheTruthIsAccepted) {
  const auto stats = open_and_get_from([](RawPeer& server, const Pack& pack) -> Work {
    co_await send_summary(server, pack);
    co_await send_page(server, pack, kNoByte);
    co_await server.send(begin_2(pack), 2, 2);
    co_await server.send_data(2, 3, bytes_of_2(pack), true);
    RequestEnd end{2, 1000 + pack.directory().pages[0].part.size, 0};
    co_await server.send(end, 2, 4);
  });
  ASSERT_TRUE(stats) << stats.error().message;
  EXPECT_EQ(stats->parts, 1u);
  EXPECT_EQ(stats->pages, 1u);
}

TEST(FirstFlight, PartsBeforeTheDirectory) {
  const auto stats = open_and_get_from(
      [](RawPeer& server, const Pack& pack) -> Work { co_await server.send(begin_2(pack), 2, 0); });
  EXPECT_EQ(stats.error().code, ErrorCode::BadStream);
}

TEST(FirstFlight, APartBeforeThePageThatListsIt) {
  const auto stats = open_and_get_from([](RawPeer& server, const Pack& pack) -> Work {
    co_await send_summary(server, pack);
    co_await server.send(begin_2(pack), 2, 0);
  });
  EXPECT_EQ(stats.error().code, ErrorCode::BadStream);
}

TEST(FirstFlight, APageThatIsAnother) {
  const auto stats = open_and_get_from([](RawPeer& server, const Pack& pack) -> Work {
    co_await send_summary(server, pack);
    co_await send_page(server, pack, 10);
  });
  EXPECT_EQ(stats.error().code, ErrorCode::BadStream);
}

TEST(FirstFlight, AnEndBeforeAnyPage) {
  const auto stats = open_and_get_from([](RawPeer& server, const Pack& pack) -> Work {
    co_await send_summary(server, pack);
    RequestEnd end{0, 0, 0};
    co_await server.send(end, 2, 0);
  });
  EXPECT_FALSE(stats);
}

TEST(FirstFlight, ARegionNotAskedFor) {
  const auto stats = open_and_get_from([](RawPeer& server, const Pack& pack) -> Work {
    co_await send_summary(server, pack);
    co_await send_page(server, pack, kNoByte);
    const PartRef& ref = pack.directory().regions[3].levels[0].part;
    PartBegin begin{{PartKind::Region, 3, 0}, ref.size, 0, ref.hash};
    co_await server.send(begin, 2, 2);
  });
  EXPECT_EQ(stats.error().code, ErrorCode::BadStream);
}

TEST(FirstFlight, AModelThatIsNotThere) {
  const auto stats = open_and_get_from([](RawPeer& server, const Pack& pack) -> Work {
    ErrorMessage message{{ErrorCode::NotFound, "no such model"}, false};
    co_await server.send(message, 1, 0);
    co_await server.send(message, 2, 0);
    (void)pack;
  });
  EXPECT_EQ(stats.error().code, ErrorCode::NotFound);
}

TEST(ClientSession, TakesUpAPartWhereTheLastConnectionLeftIt) {
  constexpr std::uint32_t kPartSize = 300'000;
  std::uint64_t resumed_bytes = 0;
  for (std::size_t n = 4; n < 14; ++n) {
    auto unfinished = std::make_shared<UnfinishedParts>();
    std::vector<Hash> have;
    std::uint64_t received = 0;
    const auto work = [&](std::unique_ptr<ByteStream> stream) -> Work {
      ClientOptions options;
      const auto session = co_await ClientSession::start(std::move(stream), options);
      if (!session) co_return;
      const auto manifest = co_await (*session)->open("row");
      if (manifest) {
        GetRequest request;
        request.manifest = *manifest;
        request.have = have;
        request.unfinished = unfinished;
        auto on_part = [&have](ReceivedPart part) { have.push_back(hash_of(part.bytes)); };
        const auto stats = co_await (*session)->get(std::move(request), std::move(on_part));
        if (stats) received = stats->bytes;
      }
      (*session)->close();
    };
    MemoryStreamOptions breaking;
    breaking.capacity = 100'000;
    breaking.first_fault->fails_at = n;
    SessionHarness first({}, breaking), second;
    first.folder().put("row.selvage", fake_pack_bytes(3, kPartSize));
    second.folder().put("row.selvage", fake_pack_bytes(3, kPartSize));
    first.run(work(first.connect()));
    const std::size_t finished = have.size();
    std::uint64_t left = 0;
    for (const auto& [hash, bytes] : *unfinished) left += bytes.size();
    second.run(work(second.connect()));
    EXPECT_EQ(have.size(), 5u);
    EXPECT_TRUE(unfinished->empty()) << "done with";
    if (finished < 5) {
      EXPECT_GT(received, 0u);
    }
    std::uint64_t finished_bytes = 0;
    for (std::size_t i = 0; i < finished; ++i) finished_bytes += i % 2 == 0 ? kPartSize : 3;
    if (left > 0) {
      EXPECT_EQ(received + left + finished_bytes, 3 * kPartSize + 2 * 3) << n;
    }
    resumed_bytes += left;
  }
  EXPECT_GT(resumed_bytes, 0u) << "no connection broke inside a part";
}

TEST(ClientSession, GivesUpOnAServerThatDoesNotGreet) {
  SessionHarness harness;
  auto [client_end, server_end] = make_memory_streams(harness.executor());
  const auto work = [](std::unique_ptr<ByteStream> stream) -> Work {
    ClientOptions options;
    options.connect_timeout = 5ms;
    const auto session = co_await ClientSession::start(std::move(stream), options);
    EXPECT_EQ(session.error().code, ErrorCode::Timeout);
  };
  harness.run(work(std::move(client_end)));
}

// ---- flow control between both sessions
// ----------------------------------------------------------------------

TEST(ClientSession, PartsThatNobodyConsumesStopTheServerWithinTwoWindows) {
  SessionHarness harness;
  harness.folder().put("row.selvage", fake_pack_bytes(500, 10'000));
  std::vector<ReceivedPart> kept;
  const auto work = [](std::unique_ptr<ByteStream> stream, std::vector<ReceivedPart>& parts) -> Work {
    ClientOptions options;
    options.window_bytes = 100'000;
    const auto session = co_await ClientSession::start(std::move(stream), options);
    GetRequest request;
    request.manifest = (co_await (*session)->open("row")).value();
    bool ended = false;
    auto on_part = [&parts](ReceivedPart part) { parts.push_back(std::move(part)); };
    auto on_end = [&ended](std::exception_ptr, Result<GetStats> stats) { ended = stats.has_value(); };
    asio::co_spawn((*session)->executor(), (*session)->get(std::move(request), std::move(on_part)),
                   std::move(on_end));

    // As many round trips as would do for all of it.
    std::size_t most = 0;
    for (int i = 0; i < 500; ++i) {
      const auto pong = co_await (*session)->ping();
      EXPECT_TRUE(pong);
      most = std::max(most, parts.size());
    }
    EXPECT_FALSE(ended);
    EXPECT_GE(most * 10'000, 100'000u);
    EXPECT_LE(most / 2 * 10'000, 200'000u);  // every other part is a tiny bundle

    // Consuming sets it going again.
    while (!ended) {
      parts.clear();
      const auto pong = co_await (*session)->ping();
      EXPECT_TRUE(pong);
      if (!pong) break;
    }
    (*session)->close();
  };
  harness.run(work(harness.connect(), kept));
}

TEST(ClientSession, ACancelledGetLeavesRoomForTheNext) {
  SessionHarness harness;
  harness.folder().put("row.selvage", fake_pack_bytes(50, 100'000));
  const auto work = [](std::unique_ptr<ByteStream> stream) -> Work {
    ClientOptions options;
    options.window_bytes = 200'000;
    const auto session = co_await ClientSession::start(std::move(stream), options);
    const auto manifest = (co_await (*session)->open("row")).value();
    for (int i = 0; i < 5; ++i) {
      std::stop_source source;
      int parts = 0;
      auto on_part = [&](ReceivedPart) { ++parts, source.request_stop(); };
      GetRequest request;
      request.manifest = manifest;
      const auto stats = co_await (*session)->get(request, std::move(on_part), source.get_token());
      EXPECT_FALSE(stats);
      EXPECT_EQ(stats.error().code, ErrorCode::Cancelled);
    }
    GetRequest request;
    request.manifest = manifest;
    const auto stats = co_await (*session)->get(request, ignore_part);
    EXPECT_TRUE(stats);
    (*session)->close();
  };
  harness.run(work(harness.connect()));
}

TEST(ClientSession, TurningTheDialReachesTheServer) {
  SessionHarness harness;
  auto [client_end, server_end] = make_memory_streams(harness.executor());
  RawPeer server(std::move(server_end));
  const auto dial = std::make_shared<UrgencyDial>(5);
  const auto serve = [](RawPeer& peer, std::shared_ptr<UrgencyDial> turned) -> Work {
    const auto hello = co_await peer.receive();
    HelloAck ack;
    ack.max_message_bytes = 100'000;
    ack.max_ids = 100;
    ack.idle_timeout_ms = 60'000;
    co_await peer.send(std::move(ack));
    const auto get = co_await peer.receive();
    EXPECT_TRUE(get && get->is(FrameType::GetParts));
    EXPECT_EQ(get->as<GetParts>().urgency, 5);
    turned->turn(0);
    const auto change = co_await peer.receive();
    EXPECT_TRUE(change && change->is(FrameType::Reprioritise));
    EXPECT_EQ(change->as<Reprioritise>().urgency, 0);
    EXPECT_EQ(change->header.request_id, get->header.request_id);
    peer.close();
  };
  const auto fetch = [](std::unique_ptr<ByteStream> stream, std::shared_ptr<UrgencyDial> turned) -> Work {
    ClientOptions options;
    const auto session = co_await ClientSession::start(std::move(stream), options);
    EXPECT_TRUE(session);
    GetRequest request;
    const auto pack = Pack::from_bytes(fake_pack_bytes(3)).value();
    Manifest manifest;
    manifest.name = "row";
    manifest.directory = pack->directory();
    request.manifest = std::make_shared<const Manifest>(std::move(manifest));
    request.dial = turned;
    const auto stats = co_await (*session)->get(std::move(request), ignore_part);
    EXPECT_FALSE(stats);
    turned->turn(7);  // too late, and nobody's business
    (*session)->close();
  };
  asio::co_spawn(harness.executor(), serve(server, dial), asio::detached);
  harness.run(fetch(std::move(client_end), dial));
}

TEST(ClientSession, RequestsOverlap) {
  SessionHarness harness;
  harness.folder().put("row.selvage", fake_pack_bytes(50, 20'000));
  const auto work = [](std::unique_ptr<ByteStream> stream) -> Work {
    ClientOptions options;
    const auto session = co_await ClientSession::start(std::move(stream), std::move(options));
    const auto manifest = (co_await (*session)->open("row")).value();
    int running = 5;
    Signal all_done;
    for (int i = 0; i < 5; ++i) {
      GetRequest request;
      request.manifest = manifest;
      auto on_end = [&](std::exception_ptr, Result<GetStats> stats) {
        EXPECT_TRUE(stats) << stats.error().message;
        if (--running == 0) all_done.notify();
      };
      asio::co_spawn((*session)->executor(), (*session)->get(std::move(request), ignore_part),
                     std::move(on_end));
    }
    co_await all_done.wait();
    (*session)->close();
  };
  harness.run(work(harness.connect()));
}

// ---- failure everywhere
// --------------------------------------------------------------------------------------

/// List, open, get, ping. Whatever fails, both sides come to an end, and the client says so.
Work use_everything(std::unique_ptr<ByteStream> stream, bool& succeeded) {
  ClientOptions options;
  options.window_bytes = kMinInitialCredit;
  const auto session = co_await ClientSession::start(std::move(stream), options);
  if (!session) co_return;
  const auto models = co_await (*session)->list();
  const auto manifest = co_await (*session)->open("row");
  if (manifest) {
    GetRequest request;
    request.manifest = *manifest;
    const auto stats = co_await (*session)->get(std::move(request), ignore_part);
    const auto pong = co_await (*session)->ping();
    succeeded = models && stats && pong;
    if (stats) {
      EXPECT_EQ(stats->parts, 19u);
    }
  }
  (*session)->close();
}

/// The same for one flight.
Work use_first_flight(std::unique_ptr<ByteStream> stream, bool& succeeded) {
  ClientOptions options;
  options.window_bytes = kMinInitialCredit;
  options.await_greeting = false;
  const auto session = co_await ClientSession::start(std::move(stream), options);
  if (!session) co_return;
  auto ignore_manifest = [](const Manifest&) {};
  FirstRequest request;
  const auto stats =
      co_await (*session)->open_and_get("row", std::move(request), ignore_manifest, ignore_part);
  succeeded = stats.has_value();
  if (stats) {
    EXPECT_EQ(stats->parts, 19u);
  }
  (*session)->close();
}

class NthOperation : public ::testing::TestWithParam<bool> {
 protected:
  /// A stream that is small, and whose nth operation fails at the end that is tested.
  static MemoryStreamOptions failing_at(std::size_t n) {
    MemoryStreamOptions options;
    options.capacity = 20'000;
    options.read_limit = 10'000;
    (GetParam() ? options.first_fault : options.second_fault)->fails_at = n;
    return options;
  }
};

TEST_P(NthOperation, FailingEndsBothSidesInGoodOrder) {
  bool succeeded = false;
  std::size_t n = 0;
  for (; !succeeded; ++n) {
    ASSERT_LT(n, 1000u);
    const MemoryStreamOptions options = failing_at(n);
    const auto fault = GetParam() ? options.first_fault : options.second_fault;
    SessionHarness harness({}, options);
    harness.folder().put("row.selvage", fake_pack_bytes(10, 8'000));
    harness.run(use_everything(harness.connect(), succeeded));
    // A client whose stream fails once all is said just leaves; a server must know why it ended.
    if (GetParam()) {
      EXPECT_TRUE(!succeeded || !fault->happened() || harness.session().reason()) << n;
    }
  }
  EXPECT_GT(n, 10u);
}

TEST_P(NthOperation, FailingEndsAFirstFlightInGoodOrder) {
  bool succeeded = false;
  std::size_t n = 0;
  for (; !succeeded; ++n) {
    ASSERT_LT(n, 1000u);
    SessionHarness harness({}, failing_at(n));
    harness.folder().put("row.selvage", fake_pack_bytes(10, 8'000));
    harness.run(use_first_flight(harness.connect(), succeeded));
  }
  EXPECT_GT(n, 5u);
}

INSTANTIATE_TEST_SUITE_P(On, NthOperation, ::testing::Values(true, false),
                         [](const auto& test) { return test.param ? "TheServersEnd" : "TheClientsEnd"; });

}  // namespace
}  // namespace selvage
