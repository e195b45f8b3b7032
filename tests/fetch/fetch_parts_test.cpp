// SPDX-License-Identifier: MIT
#include "client/fetch/fetch_parts.h"

#include <map>
#include <thread>

#include <gtest/gtest.h>

#include "client/fetch/missing_parts.h"
#include "client/fetch/server_source.h"
#include "tests/support/fake_pack.h"
#include "tests/support/flaky_proxy.h"
#include "tests/support/temp_folder.h"
#include "tests/support/test_server.h"

namespace selvage {
namespace {

using namespace std::chrono_literals;
using std::chrono::milliseconds;

/// Gives the parts of a pack, and fails after so many of them.
class FailingSource final : public PartSource {
 public:
  FailingSource(const Bytes& pack, int parts_a_try, ErrorCode code)
      : pack_(Pack::from_bytes(pack).value()), parts_a_try_(parts_a_try), code_(code) {}

  Result<std::shared_ptr<const Manifest>> open(std::stop_token) override {
    if (++opens < 3) return fail(code_, "not yet");
    return std::make_shared<const Manifest>(Manifest{"row", pack_->id(), pack_->directory(), 0});
  }

  Result<GetStats> get(GetRequest request, const OnPart& on_part, std::stop_token) override {
    ++tries;
    const std::vector<PartId> ids = select_parts(pack_->directory(), request.selection).value();
    int given = 0;
    for (const PartId& id : ids) {
      const PartRef& ref = *pack_->directory().find(id);
      if (std::ranges::count(request.have, ref.hash) > 0) continue;
      if (given++ == parts_a_try_) return fail(code_, "broken");
      const auto bytes = pack_->part(ref);
      if (auto ok = on_part({id, {bytes.begin(), bytes.end()}, {}}); !ok) return forward_error(ok);
    }
    return GetStats{};
  }

  int tries = 0, opens = 2;

 private:
  std::shared_ptr<const Pack> pack_;
  int parts_a_try_;
  ErrorCode code_;
};

/// Counts how often each part came.
struct Counts {
  std::map<PartId, int> of_part;
  PartSource::OnPart on_part() {
    return [this](ReceivedPart part) -> Result<void> {
      ++of_part[part.id];
      return {};
    };
  }
  bool each_once(std::size_t parts) const {
    return of_part.size() == parts &&
           std::ranges::all_of(of_part, [](const auto& p) { return p.second == 1; });
  }
};

GetRequest everything(PartSource& source) { return {source.open().value(), {}}; }

FetchPartsOptions patient(milliseconds give_up_after = 60s) {
  FetchPartsOptions options;
  options.retry = {.first_delay = 1ms, .longest_delay = 2ms, .give_up_after = give_up_after};
  return options;
}

TEST(FetchParts, EachPartOnceHoweverOftenTheSourceFails) {
  FailingSource source(fake_pack_bytes(10), 3, ErrorCode::Io);
  Counts counts;
  const auto stats = fetch_parts(source, everything(source), counts.on_part(), patient());
  ASSERT_TRUE(stats) << stats.error().message;
  EXPECT_TRUE(counts.each_once(19));
  EXPECT_EQ(stats->parts, 19u);
  EXPECT_EQ(stats->retries, 6u);
}

/// All parts have the same bytes, so a request cannot say which of them it holds.
TEST(FetchParts, TellsPartsWithTheSameBytesApart) {
  Directory directory = Pack::from_bytes(fake_pack_bytes(6, 100)).value()->directory();
  const std::vector<Bytes> parts(11, Bytes(100, std::byte{7}));
  const Bytes pack = assemble_pack(directory, parts);
  FailingSource source(pack, 20, ErrorCode::Io), failing(pack, 4, ErrorCode::Io);
  Counts counts;
  ASSERT_TRUE(fetch_parts(source, everything(source), counts.on_part(), patient()));
  EXPECT_TRUE(counts.each_once(11));
  EXPECT_FALSE(fetch_parts(failing, everything(failing), Counts().on_part(), patient(20ms)))
      << "never gets past the fourth";

  auto missing = MissingParts::of(directory, {});
  ASSERT_TRUE(missing);
  const std::vector<PartId> ids(missing->ids().begin(), missing->ids().end());
  for (const PartId& id : ids) {
    EXPECT_TRUE(missing->held().size() < ids.size());
    EXPECT_TRUE(missing->take(id));
    EXPECT_FALSE(missing->take(id));
  }
  EXPECT_TRUE(missing->empty());
}

TEST(FetchParts, GivesUpWhenNothingComesForTooLong) {
  FailingSource source(fake_pack_bytes(10), 0, ErrorCode::Unavailable);
  int told = 0;
  FetchPartsOptions options = patient(30ms);
  options.on_retry = [&](const Error& error, milliseconds) { told += error.code == ErrorCode::Unavailable; };
  const auto stats = fetch_parts(source, everything(source), Counts().on_part(), options);
  ASSERT_FALSE(stats);
  EXPECT_EQ(stats.error().code, ErrorCode::Unavailable);
  EXPECT_GT(told, 3);
  EXPECT_EQ(source.tries, told + 1);
}

TEST(FetchParts, DoesNotRepeatWhatWillNotPass) {
  FailingSource source(fake_pack_bytes(10), 3, ErrorCode::ModelChanged);
  const auto stats = fetch_parts(source, everything(source), Counts().on_part(), patient());
  EXPECT_EQ(stats.error().code, ErrorCode::ModelChanged);
  EXPECT_EQ(source.tries, 1);
}

TEST(FetchParts, DoesNotRepeatWhatTheConsumerRefused) {
  FailingSource source(fake_pack_bytes(10), 30, ErrorCode::Io);
  const auto stats = fetch_parts(
      source, everything(source), [](ReceivedPart) { return fail(ErrorCode::Io, "full"); }, patient());
  EXPECT_EQ(stats.error().message, "full");
  EXPECT_EQ(source.tries, 1);
}

TEST(FetchParts, StopsWhileItWaits) {
  FailingSource source(fake_pack_bytes(10), 0, ErrorCode::Io);
  std::stop_source stop;
  FetchPartsOptions options;
  options.retry = {.first_delay = 1h, .longest_delay = 1h, .give_up_after = 24h};
  options.on_retry = [&](const Error&, milliseconds) { stop.request_stop(); };
  EXPECT_FALSE(fetch_parts(source, everything(source), Counts().on_part(), options, stop.get_token()));
}

TEST(FetchParts, OpensAgainIfToldTo) {
  FailingSource source(fake_pack_bytes(3), 3, ErrorCode::Unavailable);
  source.opens = 0;
  EXPECT_FALSE(open_with_retries(source, patient(0ms)));
  source.opens = 0;
  EXPECT_TRUE(open_with_retries(source, patient()));
}

TEST(FetchParts, FetchesOnlyWhatTheCacheLacks) {
  const TempFolder folder;
  PartCache cache = PartCache::open(folder.path()).value();
  FetchPartsOptions options = patient();
  options.cache = &cache;
  FailingSource source(fake_pack_bytes(10, 1000), 100, ErrorCode::Io);
  GetRequest some = everything(source);
  some.selection.kind = Selection::Kind::Ids;
  some.selection.ids = {2, 3, 4};
  EXPECT_EQ(fetch_parts(source, some, Counts().on_part(), options)->parts, 3u + 2u);

  Counts counts;
  const auto all = fetch_parts(source, everything(source), counts.on_part(), options);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->cached_parts, 5u);
  EXPECT_EQ(all->parts, 14u);
  EXPECT_TRUE(counts.each_once(19));

  const int tries = source.tries;
  const auto again = fetch_parts(source, everything(source), Counts().on_part(), options);
  EXPECT_EQ(again->cached_parts, 19u);
  EXPECT_EQ(again->bytes, 0u);
  EXPECT_EQ(source.tries, tries) << "asks although it has everything";
}

TEST(FetchParts, SurvivesConnectionsThatBreakInTheMiddleOfAPart) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(6, 1'000'000));
  FlakyProxy proxy(server.address(), 450'000);  // less than a part: starting one over would never end
  ServerSource source(proxy.address(), "row", {});
  Counts counts;
  const auto stats = fetch_parts(source, everything(source), counts.on_part(), patient());
  ASSERT_TRUE(stats) << stats.error().message;
  EXPECT_TRUE(counts.each_once(11));
  EXPECT_GE(stats->retries, 6u);
  EXPECT_EQ(proxy.connections(), static_cast<int>(stats->retries) + 1);
}

}  // namespace
}  // namespace selvage
