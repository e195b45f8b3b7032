// SPDX-License-Identifier: MIT
//
// The publisher by itself: what it keeps, what it refuses, and in which order it works.
#include "server/publish/publisher.h"

#include <future>
#include <latch>

#include <gtest/gtest.h>

#include "common/base/hash.h"
#include "tests/support/fake_pack.h"
#include "tests/support/mesh_text.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace selvage {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

Publish request_for(const std::string& text, const std::string& name, const std::string& file = "mesh.obj") {
  Publish request;
  request.name = name;
  request.file = file;
  request.size_bytes = text.size();
  request.hash = hash_of(bytes_of(text));
  return request;
}

/// Waits for the end of one upload; may hold up the worker at its first step.
class Outcome {
 public:
  PublishEvents events() {
    return {[this](const PublishProgress& progress) {
              if (progress.stage == "wait") return;
              if (!std::exchange(begun_, true)) has_begun_.set_value();
              if (held_up_) go_on_.get_future().wait(), held_up_ = false;
            },
            [this](Result<Published> outcome) { ended_.set_value(std::move(outcome)); }};
  }
  void hold_up() { held_up_ = true; }
  void go_on() { go_on_.set_value(); }
  void wait_until_begun() { has_begun_.get_future().wait(); }
  Result<Published> wait() { return ended_.get_future().get(); }

 private:
  bool begun_ = false;
  std::atomic<bool> held_up_ = false;
  std::promise<void> has_begun_, go_on_;
  std::promise<Result<Published>> ended_;
};

class PublisherTest : public ::testing::Test {
 protected:
  void start(const PublishLimits& limits = {}) {
    publisher.reset();
    publisher = std::make_unique<Publisher>(*store, counters, limits);
  }
  /// All of it, and submitted.
  Result<std::shared_ptr<Upload>> upload(const std::string& text, const std::string& name, Outcome& outcome) {
    auto begun = publisher->begin(request_for(text, name), "tester");
    if (!begun) return begun;
    if (auto ok = (*begun)->append(bytes_of(text).subspan((*begun)->held())); !ok) return forward_error(ok);
    if (auto ok = (*begun)->submit(outcome.events()); !ok) return forward_error(ok);
    return begun;
  }
  std::size_t staged_files() const {
    std::error_code none;
    std::filesystem::directory_iterator at(folder.path() / ".uploads", none), end;
    return static_cast<std::size_t>(std::distance(at, end));
  }

  TempFolder folder;
  std::unique_ptr<PackStore> store = std::move(PackStore::open_folder(folder.path()).value());
  ServerCounters counters;
  std::unique_ptr<Publisher> publisher;
  const std::string torus = obj_text(shapes::torus(20, 30));
};

TEST_F(PublisherTest, MakesAModelAndCleansUp) {
  start();
  Outcome outcome;
  ASSERT_TRUE(upload(torus, "torus", outcome));
  const auto published = outcome.wait();
  ASSERT_TRUE(published) << published.error().message;
  EXPECT_EQ(published->triangles, 1200u);
  const auto pack = store->open("torus");
  ASSERT_TRUE(pack) << pack.error().message;
  EXPECT_EQ((*pack)->id(), published->pack_id);
  EXPECT_EQ(staged_files(), 0u);
}

TEST_F(PublisherTest, GoesOnAfterTheServerHasGone) {
  start();
  {
    auto begun = publisher->begin(request_for(torus, "torus"), "tester").value();
    ASSERT_TRUE(begun->append(bytes_of(torus).first(1000)));
  }
  start();
  EXPECT_EQ(publisher->begin(request_for(torus, "torus"), "other").value()->held(), 0u) << "another's";
  EXPECT_EQ(publisher->begin(request_for(torus, "torus"), "tester").value()->held(), 1000u);
  Outcome outcome;
  ASSERT_TRUE(upload(torus, "torus", outcome));
  EXPECT_TRUE(outcome.wait());
}

TEST_F(PublisherTest, TheSameAgainIsDoneAlready) {
  start();
  Outcome first, second;
  ASSERT_TRUE(upload(torus, "torus", first));
  const auto published = first.wait();
  ASSERT_TRUE(published);
  auto again = publisher->begin(request_for(torus, "torus"), "tester");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ((*again)->held(), torus.size());
  ASSERT_TRUE((*again)->submit(second.events()));
  EXPECT_EQ(second.wait()->pack_id, published->pack_id);
  // Other options make another model.
  Publish finer = request_for(torus, "torus");
  finer.bits = 16;
  EXPECT_FALSE(publisher->begin(finer, "tester"));
  Publish in_more_levels = request_for(torus, "torus");
  in_more_levels.cut.levels = 3;
  EXPECT_FALSE(publisher->begin(in_more_levels, "tester"));
}

TEST_F(PublisherTest, CutsAsThePublisherWants) {
  start();
  const auto publish = [&](const std::string& name, const PublishCut& cut) {
    Publish request = request_for(torus, name);
    request.cut = cut;
    Outcome outcome;
    auto begun = publisher->begin(request, "tester").value();
    EXPECT_TRUE(begun->append(bytes_of(torus)));
    EXPECT_TRUE(begun->submit(outcome.events()));
    return outcome.wait();
  };
  PublishCut cut;
  cut.max_region = 150;
  cut.level_ratios = {0.5, 0.25};
  ASSERT_TRUE(publish("cut", cut));
  const Directory directory = store->open("cut").value()->directory();
  EXPECT_EQ(directory.level_count(), 3u);
  EXPECT_GE(directory.real_region_count(), 4u);
  // The same again is known, cut and all.
  Publish again = request_for(torus, "cut");
  again.cut = cut;
  EXPECT_EQ(publisher->begin(again, "tester").value()->held(), torus.size());

  PublishCut by_components;
  by_components.by = PublishCut::By::Components;
  ASSERT_TRUE(publish("piece", by_components));
  EXPECT_EQ(store->open("piece").value()->directory().names.at(0).name, "component_1");

  PublishCut impossible;
  impossible.level_ratios = {0.25, 0.5};
  EXPECT_EQ(publish("impossible", impossible).error().code, ErrorCode::InvalidArgument);
  PublishCut by_groups;
  by_groups.by = PublishCut::By::Groups;
  const auto nameless = publish("nameless", by_groups);
  ASSERT_FALSE(nameless);
  EXPECT_EQ(nameless.error().code, ErrorCode::BadFile);
  EXPECT_NE(nameless.error().message.find("mesh.obj"), std::string::npos) << nameless.error().message;
}

TEST_F(PublisherTest, ANameInUseIsRefusedUnlessReplaced) {
  folder.put("row.selvage", fake_pack_bytes(5));
  folder.put("torn.selvage", Bytes(10));
  start();
  for (const char* name : {"row", "torn"}) {
    Publish request = request_for(torus, name);
    const auto refused = publisher->begin(request, "tester");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::InvalidArgument);
    EXPECT_NE(refused.error().message.find(name), std::string::npos);
    request.replace = true;
    EXPECT_TRUE(publisher->begin(request, "tester"));
  }
}

TEST_F(PublisherTest, ANameThatIsTakenMeanwhileIsRefusedAndStaysWhatItIs) {
  start();
  Outcome outcome;
  outcome.hold_up();
  ASSERT_TRUE(upload(torus, "row", outcome));
  outcome.wait_until_begun();
  folder.put("row.selvage", fake_pack_bytes(5));
  outcome.go_on();
  const auto refused = outcome.wait();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::InvalidArgument);
  EXPECT_EQ(store->open("row").value()->directory().real_region_count(), 5u);
  EXPECT_EQ(staged_files(), 0u);
}

TEST_F(PublisherTest, NamesAndFormatsAreChecked) {
  start();
  for (const char* name : {"../up", ".hidden", "a/b"})
    EXPECT_FALSE(publisher->begin(request_for(torus, name), "t"));
  EXPECT_NE(publisher->begin(request_for(torus, "x", "mesh.doc"), "t").error().message.find(".ply"),
            std::string::npos);
}

TEST_F(PublisherTest, BytesMustBeThoseThatWereAnnounced) {
  start();
  Publish request = request_for(torus, "torus");
  request.hash = hash_of(bytes_of("something else"));
  auto begun = publisher->begin(request, "tester").value();
  Outcome early, outcome;
  ASSERT_TRUE(begun->append(bytes_of(torus).first(10)));
  EXPECT_EQ(begun->submit(early.events()).error().code, ErrorCode::InvalidArgument) << "too few";
  ASSERT_TRUE(begun->append(bytes_of(torus).subspan(10)));
  EXPECT_EQ(begun->append(bytes_of("x")).error().code, ErrorCode::InvalidArgument) << "too many";
  ASSERT_TRUE(begun->submit(outcome.events()));
  EXPECT_EQ(outcome.wait().error().code, ErrorCode::BadStream);
  EXPECT_EQ(staged_files(), 0u);
}

TEST_F(PublisherTest, LargeFilesAreRefusedAtOnce) {
  start({.upload_bytes = 100});
  const auto refused = publisher->begin(request_for(torus, "torus"), "tester");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::LimitExceeded);
  EXPECT_NE(refused.error().message.find("100 bytes"), std::string::npos);
}

TEST_F(PublisherTest, StagedBytesAreBounded) {
  start({.staged_bytes = torus.size() + 500});
  auto first = publisher->begin(request_for(torus, "a"), "tester").value();
  ASSERT_TRUE(first->append(bytes_of(torus).first(1000)));
  const auto refused = publisher->begin(request_for(torus, "b"), "tester");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::Unavailable);
  first->cancel();
  EXPECT_TRUE(publisher->begin(request_for(torus, "b"), "tester"));
}

TEST_F(PublisherTest, WhatNobodyResumesIsRemoved) {
  start({.staged_age = std::chrono::hours(1)});
  { ASSERT_TRUE(publisher->begin(request_for(torus, "a"), "tester").value()->append(bytes_of(torus))); }
  ASSERT_EQ(staged_files(), 1u);
  for (const auto& file : std::filesystem::directory_iterator(folder.path() / ".uploads")) {
    std::filesystem::last_write_time(file,
                                     std::filesystem::file_time_type::clock::now() - std::chrono::hours(2));
  }
  auto other = publisher->begin(request_for(torus, "b"), "tester");
  EXPECT_EQ(staged_files(), 1u);
  EXPECT_EQ(publisher->begin(request_for(torus, "a"), "tester").value()->held(), 0u);
}

TEST_F(PublisherTest, ALaterConnectionTakesOver) {
  start();
  const auto request = request_for(torus, "torus");
  auto first = publisher->begin(request, "tester").value();
  ASSERT_TRUE(first->append(bytes_of(torus).first(100)));
  auto second = publisher->begin(request, "tester").value();
  EXPECT_EQ(second->held(), 100u);
  Outcome outcome;
  EXPECT_EQ(first->append(bytes_of(torus).subspan(100)).error().code, ErrorCode::Cancelled);
  EXPECT_FALSE(first->submit(outcome.events()));
  EXPECT_TRUE(second->append(bytes_of(torus).subspan(100)));
}

TEST_F(PublisherTest, TheQueueIsBoundedAndWhatFindsNoRoomCanComeAgain) {
  start({.queue = 1});
  Outcome working, waiting, refused, later;
  working.hold_up();
  ASSERT_TRUE(upload(torus, "a", working));
  working.wait_until_begun();
  ASSERT_TRUE(upload(torus, "b", waiting));
  const auto third = upload(torus, "c", refused);
  ASSERT_FALSE(third);
  EXPECT_EQ(third.error().code, ErrorCode::Unavailable);
  const auto jobs = publisher->jobs();
  ASSERT_EQ(jobs.size(), 2u);
  EXPECT_EQ(jobs[0].name, "a");
  EXPECT_EQ(jobs[1].stage, "wait");
  working.go_on();
  EXPECT_TRUE(working.wait());
  EXPECT_TRUE(waiting.wait());
  EXPECT_EQ(publisher->begin(request_for(torus, "c"), "tester").value()->held(), torus.size());
  ASSERT_TRUE(upload(torus, "c", later));
  EXPECT_TRUE(later.wait());
}

TEST_F(PublisherTest, CancelEndsWhatWaitsAndWhatIsWorkedOn) {
  start();
  Outcome working, waiting;
  working.hold_up();
  auto first = upload(torus, "a", working).value();
  working.wait_until_begun();
  auto second = upload(torus, "b", waiting).value();
  second->cancel();
  EXPECT_EQ(waiting.wait().error().code, ErrorCode::Cancelled);
  first->cancel();
  working.go_on();
  EXPECT_EQ(working.wait().error().code, ErrorCode::Cancelled);
  EXPECT_TRUE(store->list()->empty());
  EXPECT_EQ(staged_files(), 0u);
}

TEST_F(PublisherTest, WorkGoesOnWhenTheConnectionIsGoneAndCanBeAskedFor) {
  start();
  Outcome lost, found;
  lost.hold_up();
  upload(torus, "torus", lost).value().reset();
  lost.wait_until_begun();
  auto again = publisher->begin(request_for(torus, "torus"), "tester").value();
  EXPECT_EQ(again->held(), torus.size());
  ASSERT_TRUE(again->submit(found.events()));
  EXPECT_EQ(lost.wait().error().code, ErrorCode::Cancelled) << "only one is told";
  lost.go_on();
  EXPECT_TRUE(found.wait());
}

TEST_F(PublisherTest, ItsEndCancelsTheWorkAndKeepsTheUpload) {
  start();
  Outcome outcome;
  outcome.hold_up();
  ASSERT_TRUE(upload(torus, "torus", outcome));
  outcome.wait_until_begun();
  std::jthread ends([&] { publisher.reset(); });
  outcome.go_on();
  ends.join();
  start();
  EXPECT_EQ(publisher->begin(request_for(torus, "torus"), "tester").value()->held(), torus.size());
}

TEST_F(PublisherTest, HalfWrittenPacksOfAKilledServerAreRemoved) {
  start();
  { ASSERT_TRUE(publisher->begin(request_for(torus, "a"), "tester").value()->append(bytes_of(torus))); }
  std::ofstream(folder.path() / ".uploads" / "0123.unfinished") << "half";
  ASSERT_EQ(staged_files(), 2u);
  start();
  EXPECT_EQ(staged_files(), 1u);
}

TEST_F(PublisherTest, UnpublishesAndLeavesReadersAlone) {
  folder.put("row.selvage", fake_pack_bytes(5));
  start();
  const auto open = store->open("row").value();
  ASSERT_TRUE(publisher->unpublish("row"));
  EXPECT_EQ(store->open("row").error().code, ErrorCode::NotFound);
  EXPECT_EQ(open->part(*open->directory().find({PartKind::Region, 1, 0})).size(), 100u);
  EXPECT_EQ(publisher->unpublish("row").error().code, ErrorCode::NotFound);
  EXPECT_EQ(publisher->unpublish("../row").error().code, ErrorCode::NotFound);
}

}  // namespace
}  // namespace selvage
