// SPDX-License-Identifier: MIT
#include "client/load/expectation.h"

#include <iterator>
#include <sstream>

#include <gtest/gtest.h>

#include "client/load/load_report.h"

namespace selvage {
namespace {

Result<Expectation> parse(const std::string& text) {
  std::istringstream in(text);
  return parse_expectation({std::istream_iterator<std::string>(in), {}});
}

LoadReport report() {
  LoadReport made;
  made.elapsed = std::chrono::seconds(10);
  KindReport& kind = made.kinds["viewer"];
  for (int i = 1; i <= 100; ++i) kind.latency["get all"].add(std::chrono::milliseconds(i));
  kind.latency["get 3"].add(std::chrono::milliseconds(500));
  kind.latency["getter"].add(std::chrono::hours(1));
  kind.first_region.add(std::chrono::milliseconds(7));
  kind.requests = 101;
  kind.useful_bytes = 900;
  kind.received_bytes = 1000;
  kind.errors["get all: Io"] = 2;
  return made;
}

TEST(Expectation, IsMetOrNot) {
  const std::pair<const char*, bool> cases[] = {
      {"get all p50 < 52ms", true},   {"get all p50 < 49ms", false},
      {"get all p99 <= 100ms", true}, {"get all max < 100.5ms", true},
      {"get all max > 101ms", false}, {"get max >= 500ms", true},
      {"get max < 501ms", true},      {"first region p99.9 < 8ms", true},
      {"errors = 0", false},          {"errors < 3", true},
      {"requests/s > 10", true},      {"bytes/s >= 90B", true},
      {"bytes/s > 1MB", false},       {"useful > 89%", true},
      {"useful > 90.1%", false},      {"open p50 < 1h", false}};
  for (const auto& [text, is_met] : cases) {
    const auto expectation = parse(text);
    ASSERT_TRUE(expectation) << text;
    EXPECT_EQ(judge(*expectation, report()).is_met, is_met) << text;
  }
}

TEST(Expectation, SaysWhatIsWrongWithIt) {
  const std::pair<const char*, const char*> cases[] = {{"", "is no expectation"},
                                                       {"get p99", "is no expectation"},
                                                       {"get p98 < 1s", "is no expectation"},
                                                       {"get p99 << 1s", "is no expectation"},
                                                       {"p99 < 1s", "of which step"},
                                                       {"get errors = 0", "of the whole test"},
                                                       {"get p99 < 5", "'5' is no bound"},
                                                       {"useful > 0.9", "'0.9' is no bound"},
                                                       {"errors < 1%", "'1%' is no bound"}};
  for (const auto& [text, message] : cases) {
    const auto expectation = parse(text);
    ASSERT_FALSE(expectation) << text;
    EXPECT_NE(expectation.error().message.find(message), std::string::npos) << expectation.error().message;
  }
}

}  // namespace
}  // namespace selvage
