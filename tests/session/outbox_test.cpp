// SPDX-License-Identifier: MIT
#include "server/session/outbox.h"

#include <gtest/gtest.h>

#include "server/session/request_handler.h"
#include "tests/support/fake_pack.h"

namespace selvage {
namespace {

constexpr std::size_t kQuantum = 64u << 10;
constexpr std::uint64_t kPlenty = std::uint64_t{1} << 30;

std::shared_ptr<const Pack> fake_pack(std::uint32_t regions, std::uint32_t part_size) {
  return Pack::from_bytes(fake_pack_bytes(regions, part_size)).value();
}

Answer get_all(std::uint32_t request_id, const std::shared_ptr<const Pack>& pack) {
  GetParts request;
  request.model = "row";
  return answer_get(request_id, request, pack, {}).value();
}

std::vector<std::byte> joined(Batch& batch) {
  std::vector<std::byte> bytes;
  for (const Piece& piece : batch.pieces()) bytes.insert(bytes.end(), piece.bytes.begin(), piece.bytes.end());
  return bytes;
}

std::vector<FrameHeader> headers(Batch& batch) {
  const auto bytes = joined(batch);
  std::vector<FrameHeader> found;
  for (std::size_t at = 0; at < bytes.size(); at += kFrameHeaderSize + found.back().length) {
    found.push_back(parse_header(ConstHeaderBytes(&bytes.at(at), kFrameHeaderSize)).value());
  }
  return found;
}

struct Sent {
  std::size_t data = 0, batches = 0;
  std::vector<FrameHeader> headers;
};

Sent drain(Outbox& outbox) {
  Sent sent;
  Batch batch;
  for (outbox.take(batch, kQuantum); !batch.empty(); outbox.take(batch, kQuantum)) {
    ++sent.batches;
    for (const FrameHeader& header : headers(batch)) {
      if (header.type == FrameType::Data) sent.data += header.length;
      sent.headers.push_back(header);
    }
  }
  return sent;
}

TEST(Outbox, SendsNothingWithoutCredit) {
  Outbox outbox({});
  ASSERT_TRUE(outbox.push_answer(get_all(1, fake_pack(3, 1000))));
  EXPECT_EQ(drain(outbox).batches, 0u);
  EXPECT_FALSE(outbox.idle());
}

TEST(Outbox, NeverSendsMoreDataThanCredit) {
  Outbox outbox({});
  ASSERT_TRUE(outbox.push_answer(get_all(1, fake_pack(50, 30'000))));
  std::uint64_t granted = 0, data = 0;
  for (int i = 0; i < 1000 && !outbox.idle(); ++i) {
    granted += 7001;
    ASSERT_TRUE(outbox.grant(7001));
    data += drain(outbox).data;
    ASSERT_LE(data, granted);
  }
  EXPECT_TRUE(outbox.idle());
  EXPECT_EQ(data, 50u * 30'000 + 49 * 3);
}

TEST(Outbox, ControlGoesWithoutCreditAndFirst) {
  Outbox outbox({});
  ASSERT_TRUE(outbox.push_answer(get_all(1, fake_pack(3, 100))));
  outbox.push_control(to_frame(Pong{}, 9));
  ASSERT_TRUE(outbox.grant(kPlenty));
  Batch batch;
  outbox.take(batch, kQuantum);
  EXPECT_EQ(headers(batch).front().type, FrameType::Pong);
  EXPECT_EQ(headers(batch).back().type, FrameType::RequestEnd);
  EXPECT_TRUE(outbox.idle());
}

TEST(Outbox, NumbersTheFramesOfAnAnswer) {
  Outbox outbox({});
  ASSERT_TRUE(outbox.push_answer(get_all(5, fake_pack(20, 100'000))));
  ASSERT_TRUE(outbox.grant(kPlenty));
  std::uint32_t seq = 0;
  for (const FrameHeader& header : drain(outbox).headers) {
    EXPECT_EQ(header.request_id, 5u);
    EXPECT_EQ(header.seq, seq++);
    EXPECT_LE(header.length, kMaxDataPayload);
  }
}

TEST(Outbox, ManySmallPartsShareAWrite) {
  Outbox outbox({});
  ASSERT_TRUE(outbox.push_answer(get_all(1, fake_pack(64, 4096))));
  ASSERT_TRUE(outbox.grant(kPlenty));
  EXPECT_LE(drain(outbox).batches, 6u);
}

TEST(Outbox, ABatchIsBounded) {
  Outbox outbox({});
  ASSERT_TRUE(outbox.push_answer(get_all(1, fake_pack(2, 10 << 20))));
  ASSERT_TRUE(outbox.grant(kPlenty));
  for (int i = 0; i < 1000; ++i) outbox.push_control(to_frame(GoAway{std::string(500, 'x')}, 0));
  Batch batch;
  for (outbox.take(batch, kQuantum); !batch.empty(); outbox.take(batch, kQuantum)) {
    EXPECT_LE(batch.size_bytes(), kQuantum + 1024);
  }
}

TEST(Outbox, RequestsTakeTurns) {
  Outbox outbox({});
  const auto pack = fake_pack(100, 100'000);
  ASSERT_TRUE(outbox.push_answer(get_all(1, pack)));
  ASSERT_TRUE(outbox.push_answer(get_all(2, pack)));
  ASSERT_TRUE(outbox.push_answer(get_all(3, fake_pack(1, 100))));
  ASSERT_TRUE(outbox.grant(kPlenty));
  std::map<std::uint32_t, std::size_t> data;
  Batch batch;
  for (int i = 0; i < 20; ++i) {
    outbox.take(batch, kQuantum);
    for (const FrameHeader& header : headers(batch)) data[header.request_id] += header.length;
    // The small one comes after at most one turn of each before it.
    if (i == 2) {
      EXPECT_GT(data[3], 0u);
    }
  }
  EXPECT_NEAR(static_cast<double>(data[1]), static_cast<double>(data[2]), 2 * kQuantum);
}

/// Which requests the next batches carry data of, in order.
std::vector<std::uint32_t> turns(Outbox& outbox, int batches) {
  std::vector<std::uint32_t> ids;
  Batch batch;
  for (int i = 0; i < batches; ++i) {
    outbox.take(batch, kQuantum);
    for (const FrameHeader& header : headers(batch)) {
      if (header.type == FrameType::Data && (ids.empty() || ids.back() != header.request_id))
        ids.push_back(header.request_id);
    }
  }
  return ids;
}

TEST(Outbox, TheMostUrgentGoesFirst) {
  Outbox outbox({});
  for (std::uint32_t id = 1; id <= 3; ++id) {
    Answer answer = get_all(id, fake_pack(10, 100'000));
    answer.urgency = id == 2 ? 1 : 5;
    ASSERT_TRUE(outbox.push_answer(std::move(answer)));
  }
  ASSERT_TRUE(outbox.grant(kPlenty));
  EXPECT_EQ(turns(outbox, 5), (std::vector<std::uint32_t>{2}));
}

TEST(Outbox, AChangeOfUrgencyActsWithTheNextBatch) {
  Outbox outbox({});
  ASSERT_TRUE(outbox.push_answer(get_all(1, fake_pack(10, 1'000'000))));
  ASSERT_TRUE(outbox.push_answer(get_all(2, fake_pack(10, 1'000'000))));
  ASSERT_TRUE(outbox.grant(kPlenty));
  EXPECT_EQ(turns(outbox, 4), (std::vector<std::uint32_t>{1, 2, 1, 2}));
  outbox.reprioritise(2, 0);
  outbox.reprioritise(99, 0);
  EXPECT_EQ(turns(outbox, 4), (std::vector<std::uint32_t>{2}));
  outbox.reprioritise(2, kMaxUrgency);
  EXPECT_EQ(turns(outbox, 4), (std::vector<std::uint32_t>{1}));
}

TEST(Outbox, CancelActsAfterOneBatch) {
  Outbox outbox({});
  const auto pack = fake_pack(100, 100'000);
  ASSERT_TRUE(outbox.push_answer(get_all(1, pack)));
  ASSERT_TRUE(outbox.grant(kPlenty));
  Batch batch;
  outbox.take(batch, kQuantum);
  EXPECT_TRUE(outbox.cancel(1));
  EXPECT_FALSE(outbox.cancel(1));
  outbox.take(batch, kQuantum);
  EXPECT_TRUE(batch.empty());
  EXPECT_TRUE(outbox.idle());
}

TEST(Outbox, ABatchKeepsItsPackAlive) {
  Outbox outbox({});
  ASSERT_TRUE(outbox.push_answer(get_all(1, fake_pack(1, 10'000))));
  ASSERT_TRUE(outbox.grant(kPlenty));
  Batch batch;
  outbox.take(batch, kQuantum);
  EXPECT_TRUE(outbox.idle());  // the answer, and its hold on the pack, has gone
  EXPECT_EQ(headers(batch).size(), 3u);
}

TEST(Outbox, LimitsRequestsAndParts) {
  Outbox outbox({.requests = 2, .queued_parts = 30});
  const auto pack = fake_pack(8, 10);  // 15 parts
  ASSERT_TRUE(outbox.push_answer(get_all(1, pack)));
  EXPECT_EQ(outbox.push_answer(get_all(1, pack)).error().code, ErrorCode::InvalidArgument);
  EXPECT_EQ(outbox.push_answer(get_all(2, fake_pack(9, 10))).error().code, ErrorCode::LimitExceeded);
  ASSERT_TRUE(outbox.push_answer(get_all(2, pack)));
  EXPECT_EQ(outbox.push_answer(get_all(3, fake_pack(1, 10))).error().code, ErrorCode::LimitExceeded);
  // What is done or cancelled makes room.
  EXPECT_TRUE(outbox.cancel(2));
  ASSERT_TRUE(outbox.push_answer(get_all(3, pack)));
  ASSERT_TRUE(outbox.grant(kPlenty));
  drain(outbox);
  EXPECT_TRUE(outbox.push_answer(get_all(4, pack)));
  EXPECT_TRUE(outbox.push_answer(get_all(5, pack)));
}

TEST(Outbox, RefusesCreditThatOverflows) {
  Outbox outbox({});
  ASSERT_TRUE(outbox.grant(kMaxCredit));
  EXPECT_EQ(outbox.grant(1).error().code, ErrorCode::Protocol);
}

TEST(RequestHandler, ResumesWhatTheClientHasInPart) {
  const auto pack = fake_pack(3, 50'000);
  const PartRef& ref = pack->directory().regions[2].levels[0].part;
  GetParts request;
  request.model = "row";
  request.selection = {.kind = Selection::Kind::Ids, .ids = {2}};
  request.partial = {{ref.hash, 49'000}};
  const auto answer = answer_get(1, request, pack, {});
  ASSERT_TRUE(answer);
  ASSERT_EQ(answer->items.size(), 1u);
  EXPECT_EQ(answer->items[0].offset, 49'000u);
  Outbox outbox({});
  ASSERT_TRUE(outbox.push_answer(*answer));
  ASSERT_TRUE(outbox.grant(kPlenty));
  EXPECT_EQ(drain(outbox).data, 1000u);

  request.partial[0].offset = 50'000;  // no help
  EXPECT_EQ(answer_get(1, request, pack, {})->items[0].offset, 0u);
}

TEST(RequestHandler, OpensTheWholeDirectoryItsSummaryOrNothing) {
  const auto pack = fake_pack(1000, 10);
  const auto sent = [&](const OpenModel& request) {
    Outbox outbox({});
    EXPECT_TRUE(outbox.push_answer(answer_open(1, request, pack)));
    EXPECT_TRUE(outbox.grant(kPlenty));
    return drain(outbox).data;
  };
  EXPECT_EQ(sent({"row"}), pack->directory_bytes().size());
  EXPECT_EQ(sent({"row", true}), pack->header().summary_size);
  EXPECT_EQ(sent({"row", false, Hash{}}), pack->directory_bytes().size());
  EXPECT_EQ(sent({"row", true, pack->id()}), 0u);
}

TEST(RequestHandler, SendsTheDirectorysPagesThatAClientLacks) {
  const auto pack = fake_pack(1000, 10);
  GetParts request;
  request.model = "row";
  request.selection = {.kind = Selection::Kind::Ids, .ids = {70, 71}};
  request.pages = Pages::Needed;
  const auto first = answer_get(1, request, pack, {});
  ASSERT_TRUE(first);
  ASSERT_EQ(first->items.size(), 4u);
  EXPECT_EQ(first->items[0].id, (PartId{PartKind::Page, 1, 0}));
  const PartRef& page = pack->directory().pages[1].part;
  EXPECT_EQ(hash_of(pack->part(page)), page.hash);
  EXPECT_EQ(first->items[0].ref->hash, page.hash);

  request.have = {page.hash};
  EXPECT_EQ(answer_get(1, request, pack, {})->items.size(), 3u);
}

TEST(RequestHandler, RefusesOtherPacksUnknownRegionsAndTooManyIds) {
  const auto pack = fake_pack(3, 10);
  GetParts request;
  request.model = "row";
  request.selection = {.kind = Selection::Kind::Ids, .ids = {1, 2}};
  EXPECT_EQ(answer_get(1, request, pack, {.ids_per_request = 1}).error().code, ErrorCode::LimitExceeded);
  request.selection.ids = {4};
  EXPECT_EQ(answer_get(1, request, pack, {}).error().code, ErrorCode::NotFound);
  request.selection.ids = {3};
  request.pack_id = Hash{};
  EXPECT_EQ(answer_get(1, request, pack, {}).error().code, ErrorCode::ModelChanged);
}

TEST(RequestHandler, PagesAListWithinAFrame) {
  std::vector<PackStore::Model> models;
  for (int i = 1000; i < 2500; ++i) {
    const std::string name = std::string(124, 'n') + std::to_string(i);
    models.push_back({name, 1, fail(ErrorCode::BadStream, std::string(2000, 'x'))});
  }
  ListModels request;
  std::size_t seen = 0;
  for (bool more = true; more;) {
    const Models page = answer_list(request, models);
    EXPECT_LE(to_frame(page, 1).size(), kMaxPayload);
    seen += page.models.size();
    more = page.more;
    request.after = page.models.back().name;
  }
  EXPECT_EQ(seen, models.size());
}

}  // namespace
}  // namespace selvage
