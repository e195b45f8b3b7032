// SPDX-License-Identifier: MIT
#include "client/app/load_output.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace selvage {
namespace {

LoadReport report() {
  LoadReport made;
  made.elapsed = std::chrono::seconds(2);
  KindReport& kind = made.kinds["viewer <1>"];
  for (int i = 1; i <= 1000; ++i) kind.latency["get all"].add(std::chrono::microseconds(i));
  kind.requests = 1000;
  kind.useful_bytes = 4'000'000;
  kind.received_bytes = 5'000'000;
  kind.errors["get all: Io"] = 3;
  made.samples = {{1, 10, 400, 2e6, 0, 0.4}, {2, 10, 600, 3e6, 1.5, 0.6}};
  return made;
}

const std::vector<Expectation> kExpected = {parse_expectation({"get", "p99", "<", "2ms"}).value(),
                                            parse_expectation({"errors", "=", "0"}).value()};

TEST(LoadOutput, JsonHasWhatAProgramWants) {
  const auto json = nlohmann::json::parse(load_json(report(), kExpected));
  EXPECT_DOUBLE_EQ(json["total"]["requests_per_second"], 500);
  EXPECT_DOUBLE_EQ(json["total"]["useful_share"], 0.8);
  const auto& kind = json["kinds"]["viewer <1>"];
  EXPECT_EQ(kind["latency"]["get all"]["count"], 1000);
  EXPECT_NEAR(kind["latency"]["get all"]["p99_ms"], 0.99, 0.01);
  EXPECT_EQ(kind["errors"]["get all: Io"], 3);
  EXPECT_EQ(json["expectations"][0]["met"], true);
  EXPECT_EQ(json["expectations"][1]["met"], false);
}

TEST(LoadOutput, TextSaysWhetherItIsCorrected) {
  LoadReport closed = report();
  EXPECT_NE(load_text(closed, kExpected).find("not corrected"), std::string::npos);
  closed.is_corrected = true;
  const std::string text = load_text(closed, kExpected);
  EXPECT_EQ(text.find("not corrected"), std::string::npos);
  EXPECT_NE(text.find("NOT MET: errors = 0"), std::string::npos);
  EXPECT_NE(text.find("\nmet: get p99 < 2ms"), std::string::npos);
}

TEST(LoadOutput, CsvHasALineASampleAndOneAStep) {
  using namespace std::chrono_literals;
  LoadReport made = report();
  made.samples[1].steps = {{"get 3,5", 7, 1ms, 2ms, 3ms, 4ms}};
  EXPECT_EQ(
      load_csv(made),
      "seconds,clients,requests_per_second,bytes_per_second,errors_per_second,mean_latency_ms,step,count,"
      "p50_ms,p90_ms,p99_ms,max_ms\n"
      "1.000,10,400.0,2000000,0.0,0.400,,,,,,\n2.000,10,600.0,3000000,1.5,0.600,,,,,,\n"
      "2.000,10,,,,,\"get 3,5\",7,1.000,2.000,3.000,4.000\n");
}

TEST(LoadOutput, TableHasALineAStep) {
  using namespace std::chrono_literals;
  LoadSample sample = report().samples[1];
  sample.steps = {{"get all", 7, 1ms, 2ms, 3ms, 4ms}, {"open bunny", 1, 5ms, 5ms, 5ms, 5ms}};
  const std::string table = load_table(sample);
  EXPECT_EQ(std::ranges::count(table, '\n'), 4);
  EXPECT_NE(table.find("10 clients, 600 requests/s, 3.0 MB/s, 1.5 errors/s"), std::string::npos) << table;
  EXPECT_LT(table.find("p99"), table.find("get all"));
  EXPECT_LT(table.find("3.000"), table.find("open bunny"));
}

TEST(LoadOutput, ChartEscapesWhatScriptsSay) {
  const std::string html = load_chart(report(), "a & b");
  EXPECT_NE(html.find("a &amp; b"), std::string::npos);
  EXPECT_EQ(html.find("viewer <1>"), std::string::npos);
  EXPECT_NE(html.find("viewer &lt;1&gt;, get all: latency"), std::string::npos);
  EXPECT_EQ(html.find("nan"), std::string::npos);
  EXPECT_EQ(load_chart({}, "empty").find("nan"), std::string::npos);
}

}  // namespace
}  // namespace selvage
