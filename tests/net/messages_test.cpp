// SPDX-License-Identifier: MIT
#include "common/net/messages.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>

#include <gtest/gtest.h>

#include "tests/net/sample_messages.h"

namespace selvage {
namespace {

using Bytes = std::vector<std::byte>;

template <class Message>
Bytes payload_of(const Message& message) {
  const Bytes frame = to_frame(message, 1);
  return {frame.begin() + kFrameHeaderSize, frame.end()};
}

template <class Message>
Result<Message> round_trip(const Message& message) {
  return parse<Message>(payload_of(message));
}

template <class Message>
class EveryMessage : public ::testing::Test {};
using AllMessages =
    ::testing::Types<Hello, HelloAck, ListModels, Models, OpenModel, ManifestBegin, GetParts, Reprioritise,
                     PartBegin, RequestEnd, Credit, ErrorMessage, GoAway, Cancel, Ping, Pong, Publish,
                     PublishReady, PublishProgress, Published, Unpublish, Status, StatusReport>;
TYPED_TEST_SUITE(EveryMessage, AllMessages);

TYPED_TEST(EveryMessage, ComesBackAsItWent) {
  const auto message = sample<TypeParam>();
  const auto back = round_trip(message);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(payload_of(*back), payload_of(message));
}

TYPED_TEST(EveryMessage, IsFramedWithItsTypeAndLength) {
  const Bytes frame = to_frame(sample<TypeParam>(), 77, 5);
  const auto header = parse_header(ConstHeaderBytes(frame.data(), kFrameHeaderSize));
  ASSERT_TRUE(header);
  EXPECT_EQ(header->type, TypeParam::kType);
  EXPECT_EQ(header->length, frame.size() - kFrameHeaderSize);
  EXPECT_EQ(header->request_id, 77u);
  EXPECT_EQ(header->seq, 5u);
}

/// Truncated protobuf may still be a message; it must only never be anything worse than an error.
TYPED_TEST(EveryMessage, SurvivesTruncationAndBitFlips) {
  const Bytes payload = payload_of(sample<TypeParam>());
  for (std::size_t length = 0; length < payload.size(); ++length) {
    const Bytes fresh(payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(length));
    (void)parse<TypeParam>(fresh);
  }
  for (std::size_t bit = 0; bit < 8 * payload.size(); ++bit) {
    Bytes fresh = payload;
    fresh[bit / 8] ^= static_cast<std::byte>(1 << (bit % 8));
    const auto parsed = parse<TypeParam>(fresh);
    if (!parsed) {
      EXPECT_EQ(parsed.error().code, ErrorCode::Protocol);
    }
  }
}

/// SELVAGE_WRITE_GOLDEN=1 build/release/tests/net_test writes them anew.
TYPED_TEST(EveryMessage, IsASeedForTheFuzzer) {
  Bytes seed = to_frame(sample<TypeParam>(), 1);
  seed.insert(seed.begin(), std::byte{255});  // see fuzz_frames.cpp
  std::string name(to_string(TypeParam::kType));
  const std::string path = SELVAGE_FUZZ_CORPUS_DIR "/fuzz_frames/" + name;
  if (std::getenv("SELVAGE_WRITE_GOLDEN") != nullptr) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(seed.data()), static_cast<std::streamsize>(seed.size()));
  }
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> there(std::istreambuf_iterator<char>(file), {});
  EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(there)), seed)) << path;
}

TYPED_TEST(EveryMessage, RefusesGarbage) { EXPECT_FALSE(parse<TypeParam>(Bytes(40, std::byte{0xFF}))); }

TEST(Messages, GetPartsKeepsEverySelection) {
  GetParts get = sample<GetParts>();
  auto back = round_trip(get);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->model, get.model);
  EXPECT_EQ(back->pack_id, get.pack_id);
  EXPECT_EQ(back->selection.ids, get.selection.ids);
  EXPECT_EQ(back->selection.level, get.selection.level);
  EXPECT_EQ(back->selection.levels, get.selection.levels);
  EXPECT_EQ(back->selection.joins, get.selection.joins);
  EXPECT_EQ(back->have, get.have);
  ASSERT_EQ(back->partial.size(), 1u);
  EXPECT_EQ(back->partial[0].hash, get.partial[0].hash);
  EXPECT_EQ(back->partial[0].offset, 4096u);
  EXPECT_EQ(back->urgency, get.urgency);

  get.selection.kind = Selection::Kind::Box;
  get.selection.box = {{-1, 0, 0.25}, {1e300, 0, 7}};
  back = round_trip(get);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->selection.kind, Selection::Kind::Box);
  EXPECT_EQ(back->selection.box.min.x, -1);
  EXPECT_EQ(back->selection.box.max.x, 1e300);

  get.selection.kind = Selection::Kind::All;
  get.pack_id.reset();
  back = round_trip(get);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->selection.kind, Selection::Kind::All);
  EXPECT_FALSE(back->pack_id);
}

TEST(Messages, AGetForNoRegionsIsNotAGetForAll) {
  GetParts get = sample<GetParts>();
  get.selection.ids.clear();
  const auto back = round_trip(get);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->selection.kind, Selection::Kind::Ids);
  EXPECT_TRUE(back->selection.ids.empty());
}

template <class Message, class Spoil>
void expect_refused(Spoil spoil, const char* field) {
  Message message = sample<Message>();
  spoil(message);
  const auto back = round_trip(message);
  ASSERT_FALSE(back) << field;
  EXPECT_EQ(back.error().code, ErrorCode::Protocol);
  EXPECT_NE(back.error().message.find(field), std::string::npos) << back.error().message;
}

TEST(Messages, RefusesFieldsThatCannotBe) {
  expect_refused<Hello>([](Hello& m) { m.min_version = 9; }, "versions");
  expect_refused<Hello>([](Hello& m) { m.initial_credit = kMinInitialCredit - 1; }, "initial_credit");
  expect_refused<Hello>([](Hello& m) { m.initial_credit = kMaxCredit + 1; }, "initial_credit");
  expect_refused<Hello>([](Hello& m) { m.token.assign(kMaxTokenLength + 1, 'x'); }, "token");
  expect_refused<ListModels>([](ListModels& m) { m.after.assign(kMaxNameLength + 1, 'x'); }, "after");
  expect_refused<Models>([](Models& m) { std::swap(m.models[0], m.models[1]); }, "order");
  expect_refused<Models>([](Models& m) { m.models.clear(), m.more = true; }, "more");
  expect_refused<OpenModel>([](OpenModel& m) { m.name.clear(); }, "name");
  expect_refused<OpenModel>([](OpenModel& m) { m.name.assign(kMaxNameLength + 1, 'x'); }, "name");
  expect_refused<OpenModel>([](OpenModel& m) { m.name = "two\nlines"; }, "name");
  expect_refused<OpenModel>([](OpenModel& m) { m.name = "\xC0\xAF"; }, "name");
  expect_refused<ManifestBegin>([](ManifestBegin& m) { m.summary_size = 100'000; }, "sizes");
  expect_refused<ManifestBegin>([](ManifestBegin& m) { m.directory_size = m.summary_size = 0; }, "sizes");
  expect_refused<GetParts>([](GetParts& m) { m.selection.joins = static_cast<Joins>(3); }, "joins");
  expect_refused<GetParts>([](GetParts& m) { m.urgency = kMaxUrgency + 1; }, "urgency");
  expect_refused<PartBegin>([](PartBegin& m) { m.id.kind = static_cast<PartKind>(3); }, "kind");
  expect_refused<GetParts>([](GetParts& m) { m.pages = static_cast<Pages>(3); }, "pages");
  expect_refused<ManifestBegin>([](ManifestBegin& m) { m.data_size = 401; }, "data_size");
  expect_refused<Reprioritise>([](Reprioritise& m) { m.urgency = kMaxUrgency + 1; }, "urgency");
  expect_refused<PartBegin>([](PartBegin& m) { m.offset = m.size; }, "size");
  expect_refused<Credit>([](Credit& m) { m.bytes = 0; }, "bytes");
}

TEST(Messages, RefusesBoxesThatAreInsideOutOrNotFinite) {
  const auto with_box = [](Box box) {
    return [box](GetParts& get) {
      get.selection.kind = Selection::Kind::Box;
      get.selection.box = box;
    };
  };
  const double infinity = std::numeric_limits<double>::infinity();
  expect_refused<GetParts>(with_box({{0, 0, 1}, {1, 1, 0}}), "box");
  expect_refused<GetParts>(with_box({{0, 0, 0}, {1, infinity, 1}}), "box");
  expect_refused<GetParts>(with_box({{std::nan(""), 0, 0}, {1, 1, 1}}), "box");
}

TEST(Messages, RefusesAGetWithoutASelection) {
  EXPECT_FALSE(parse<GetParts>(payload_of(OpenModel{"bunny"})));  // field 1 is the name in both
}

TEST(Messages, MessagesWithoutPayloadHaveNone) {
  EXPECT_TRUE(parse<Ping>({}));
  EXPECT_FALSE(parse<Ping>(Bytes(1)));
}

TEST(Messages, TextOnItsWayToATerminalIsHarmless) {
  const ErrorMessage hostile{Error{ErrorCode::NotFound, "a\x1b[2Jb\xFF" + std::string(5000, 'x')}, false};
  const auto back = round_trip(hostile);
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->error.message.starts_with("a?[2Jb?xxx"));
  EXPECT_EQ(back->error.message.size(), kMaxTextLength);
}

TEST(Messages, AnErrorCodeOfANewerPeerStaysAnError) {
  const ErrorMessage newer{Error{static_cast<ErrorCode>(999), "what is new"}, true};
  const auto back = round_trip(newer);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->error.code, ErrorCode::Unsupported);
  EXPECT_TRUE(back->retryable);
}

TEST(Messages, IgnoresUnknownFields) {
  Bytes payload = payload_of(OpenModel{"bunny"});
  for (int byte : {0xF8, 0x06, 0x2A})
    payload.push_back(static_cast<std::byte>(byte));  // field 111, varint 42
  const auto back = parse<OpenModel>(payload);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->name, "bunny");
}

}  // namespace
}  // namespace selvage
