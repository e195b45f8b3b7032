// SPDX-License-Identifier: MIT
#include "client/load/load_script.h"

#include <gtest/gtest.h>

namespace selvage {
namespace {

TEST(LoadScript, ReadsEveryKindOfStep) {
  const auto script = parse_load_script(
      "# a visit\nlist\nopen bunny  # the model\nget 3,5-7\nwait 50ms\nget random 20%\nget all\nwait "
      "2s\nrepeat 10\n");
  ASSERT_TRUE(script) << script.error().message;
  ASSERT_EQ(script->steps.size(), 7u);
  EXPECT_EQ(script->steps[1].model, "bunny");
  EXPECT_EQ(script->steps[2].selection.ids, (std::vector<RegionId>{3, 5, 6, 7}));
  EXPECT_EQ(script->steps[3].pause, std::chrono::milliseconds(50));
  EXPECT_EQ(script->steps[4].random_percent, 20);
  EXPECT_EQ(script->steps[5].selection.kind, Selection::Kind::All);
  EXPECT_EQ(script->steps[6].pause, std::chrono::seconds(2));
  EXPECT_EQ(script->rounds, 10u);
  EXPECT_FALSE(parse_load_script("list\nrepeat forever")->rounds);
}

TEST(LoadScript, NamesTheLineThatIsWrong) {
  const std::pair<const char*, const char*> cases[] = {{"list\nfetch 3\n", "line 2: unknown step 'fetch'"},
                                                       {"open a\nget 7-3", "line 2: "},
                                                       {"get all", "line 1: open a model"},
                                                       {"open a\nwait 5", "line 2: '5' is no time"},
                                                       {"open a\nget random 0%", "line 2: "},
                                                       {"list\nrepeat 2\nlist", "line 3: nothing may follow"},
                                                       {"list\nrepeat -1", "line 2: write: repeat"},
                                                       {"# nothing\n", "no step"},
                                                       {"open", "line 1: unknown step"}};
  for (const auto& [text, message] : cases) {
    const auto script = parse_load_script(text);
    ASSERT_FALSE(script) << text;
    EXPECT_NE(script.error().message.find(message), std::string::npos) << script.error().message;
  }
}

}  // namespace
}  // namespace selvage
