// SPDX-License-Identifier: MIT
#include "client/load/load_script.h"

#include <fstream>

#include <gtest/gtest.h>

namespace selvage {
namespace {

using namespace std::chrono_literals;

TEST(LoadScript, ReadsKindsOfClients) {
  const auto script = parse_load_script(
      "duration 30s   # of the test\n"
      "ramp 5s\n"
      "\n"
      "client viewer 200\n"
      "  link 20mbit 50ms\n"
      "  every 500ms\n"
      "  open bunny\n"
      "  get 3,5-7,ear level 2 joins none urgency 1\n"
      "  get random 20%\n"
      "  think 20ms-200ms\n"
      "  get box 0,0,0,1,1,1\n"
      "  get all cancel after 300ms\n"
      "  disconnect\n"
      "  loop forever\n"
      "client keeper 3\n"
      "  verify\n"
      "  list\n"
      "  open bunny\n"
      "  get all drop after 64KB\n"
      "  loop 10\n"
      "expect get p99 < 200ms\n"
      "expect errors = 0\n");
  ASSERT_TRUE(script) << script.error().message;
  EXPECT_EQ(script->duration, 30s);
  EXPECT_EQ(script->ramp, 5s);
  ASSERT_EQ(script->kinds.size(), 2u);
  const ClientKind& viewer = script->kinds[0];
  EXPECT_EQ(viewer.name, "viewer");
  EXPECT_EQ(viewer.count, 200u);
  EXPECT_EQ(viewer.link.bytes_per_second, 2'500'000u);
  EXPECT_EQ(viewer.link.round_trip, 50ms);
  EXPECT_EQ(viewer.every, 500ms);
  EXPECT_FALSE(viewer.rounds);
  EXPECT_FALSE(viewer.decodes);
  ASSERT_EQ(viewer.steps.size(), 7u);
  EXPECT_EQ(viewer.steps[0].model, "bunny");
  EXPECT_EQ(viewer.steps[1].selection.ids, (std::vector<RegionId>{3, 5, 6, 7}));
  EXPECT_EQ(viewer.steps[1].selection.names, std::vector<std::string>{"ear"});
  EXPECT_EQ(viewer.steps[1].selection.level, 2);
  EXPECT_EQ(viewer.steps[1].selection.joins, Joins::None);
  EXPECT_EQ(viewer.steps[1].urgency, 1);
  EXPECT_EQ(viewer.steps[2].random_percent, 20);
  EXPECT_EQ(viewer.steps[3].think_least, 20ms);
  EXPECT_EQ(viewer.steps[3].think_most, 200ms);
  EXPECT_EQ(viewer.steps[4].selection.kind, Selection::Kind::Box);
  EXPECT_EQ(viewer.steps[5].cancel_after, 300ms);
  EXPECT_EQ(viewer.steps[5].label, "get all cancel after 300ms");
  EXPECT_EQ(viewer.steps[6].kind, LoadStep::Kind::Disconnect);
  const ClientKind& keeper = script->kinds[1];
  EXPECT_TRUE(keeper.decodes && keeper.verifies);
  EXPECT_EQ(keeper.rounds, 10u);
  EXPECT_EQ(keeper.steps[2].drop_after_bytes, 64'000u);
  EXPECT_EQ(script->expectations.size(), 2u);
}

TEST(LoadScript, WithoutKindsIsOneClient) {
  const auto script = parse_load_script("open bunny\nget all\nwait 2s\nrepeat 3");
  ASSERT_TRUE(script) << script.error().message;
  ASSERT_EQ(script->kinds.size(), 1u);
  EXPECT_EQ(script->kinds[0].count, 1u);
  EXPECT_EQ(script->kinds[0].rounds, 3u);
  EXPECT_EQ(script->kinds[0].steps.size(), 3u);
}

TEST(LoadScript, NamesTheLineThatIsWrong) {
  const std::pair<const char*, const char*> cases[] = {
      {"list\nfetch 3\n", "line 2: unknown step 'fetch 3'"},
      {"open a\nget 7-3", "line 2: "},
      {"get all", "line 1: open a model"},
      {"client a 1\nopen x\nclient b 1\nget all", "line 4: open a model"},
      {"open a\nwait 5", "line 2: '5' is no time"},
      {"open a\nthink 5s-2s", "line 2: '5s-2s' is no time"},
      {"open a\nthink 25h", "line 2: "},
      {"open a\nget random 0%", "line 2: '0%' is no share"},
      {"open a\nget random", "line 2: write: get all"},
      {"open a\nget box 1,2,3", "line 2: "},
      {"open a\nget all level 300", "line 2: '300' is no level"},
      {"open a\nget all urgency 8", "line 2: '8' is no urgency"},
      {"open a\nget all cancel 3ms", "line 2: 'cancel 3ms' is nothing"},
      {"open a\nget all drop after x", "line 2: 'drop x' is nothing"},
      {"list\nrepeat 2\nlist", "line 3: nothing may follow"},
      {"list\nloop -1", "line 2: write: loop"},
      {"client a", "line 1: write for instance: client"},
      {"client a 0", "line 1: write for instance: client"},
      {"client a 1\nclient b 1\nlist", "line 2: client a, before this line, has no step"},
      {"client a 1\nlist\nclient a 1\nlist", "line 3: there is a client a already"},
      {"client a 1\nlist\nclient b 1", "client b has no step"},
      {"link fast", "line 1: 'fast' is neither"},
      {"every 0ms", "line 1: write for instance: every"},
      {"verify all", "line 1: write verify alone"},
      {"duration forever", "line 1: write for instance: duration"},
      {"list\nexpect get", "line 2: 'get' is no expectation"},
      {"publish /nowhere.ply a", "line 1: no such file: /nowhere.ply"},
      {"vanish 3KB", "line 1: open a model before vanish"},
      {"garbage", "line 1: unknown step"},
      {"# nothing\n", "no step"},
      {"open", "line 1: unknown step"}};
  for (const auto& [text, message] : cases) {
    const auto script = parse_load_script(text);
    ASSERT_FALSE(script) << text;
    EXPECT_EQ(script.error().code, ErrorCode::BadFile);
    EXPECT_NE(script.error().message.find(message), std::string::npos) << script.error().message;
  }
}

TEST(LoadScript, NamesTheFileThatIsNotThere) {
  const auto script = read_load_script("/nowhere/visit.load");
  ASSERT_FALSE(script);
  EXPECT_NE(script.error().message.find("/nowhere/visit.load"), std::string::npos);
}

}  // namespace
}  // namespace selvage
