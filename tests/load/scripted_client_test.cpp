// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "client/load/run_load.h"
#include "common/net/frame.h"
#include "server/publish/publisher.h"
#include "tests/support/fake_pack.h"
#include "tests/support/labelled_pack.h"
#include "tests/support/mesh_text.h"
#include "tests/support/shapes.h"
#include "tests/support/test_server.h"

namespace selvage {
namespace {

using namespace std::chrono_literals;

KindReport run(const TestServer& server, const std::string& text, LoadOptions options = {}) {
  const LoadScript script = parse_load_script(text).value();
  options.server = server.address();
  options.duration = 60s;
  return run_load(script, options).total();
}

TEST(ScriptedClient, CountsWhatTheScriptAsksFor) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(10, 1000));
  const KindReport report =
      run(server, "client a 5\nlist\nopen row\nget all\nget 2-4\nloop 3", {.threads = 2});
  EXPECT_TRUE(report.errors.empty());
  EXPECT_EQ(report.requests, 5u * 3 * 4);
  EXPECT_EQ(report.parts, 5u * 3 * (10 + 9 + 3 + 2));
  EXPECT_EQ(report.useful_bytes, 5u * 3 * (10 * 1000 + 9 * 3 + 3 * 1000 + 2 * 3));
  EXPECT_GT(report.received_bytes, report.useful_bytes);
  EXPECT_EQ(report.latency.at("get all").count(), 15u);
  EXPECT_EQ(report.latency.at("get 2-4").count(), 15u);
  EXPECT_EQ(report.latency.at("connect").count(), 5u);
  EXPECT_EQ(report.first_region.count(), 30u);
}

TEST(ScriptedClient, KindsAreApart) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(3));
  LoadOptions options;
  options.server = server.address();
  const LoadReport report =
      run_load(parse_load_script("client a 2\nopen row\nget all\nclient b 3\nlist\ndisconnect\nlist").value(),
               options);
  EXPECT_EQ(report.kinds.at("a").requests, 4u);
  EXPECT_EQ(report.kinds.at("b").requests, 6u);
  EXPECT_EQ(report.kinds.at("b").latency.at("connect").count(), 6u) << "disconnect";
  EXPECT_FALSE(report.is_corrected);
}

TEST(ScriptedClient, StopsAtTheBoundOnRequests) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(3));
  const KindReport report =
      run(server, "client a 4\nopen row\nget random 50%\nloop forever", {.max_requests = 41});
  EXPECT_EQ(report.requests, 41u);
}

TEST(ScriptedClient, StopsWhenTold) {
  TestServer server;
  LoadOptions options;
  options.server = server.address();
  options.sample_every = 1ms;
  std::stop_source stop;
  int samples = 0;
  options.on_sample = [&](const LoadSample&) {
    if (++samples == 3) stop.request_stop();
  };
  const auto report =
      run_load(parse_load_script("duration 10min\nclient a 3\nlist\nthink 1h\nloop forever").value(), options,
               stop.get_token());
  EXPECT_GE(report.samples.size(), 3u);
  std::uint64_t listed = 0;
  for (const LoadSample& sample : report.samples) {
    for (const StepSample& step : sample.steps) {
      EXPECT_EQ(step.label, "list");
      listed += step.count;
    }
  }
  EXPECT_EQ(listed, report.total().requests) << "samples leave nothing out";
}

TEST(ScriptedClient, CountsErrorsByStepAndKind) {
  TestServer server;
  const KindReport report = run(server, "client a 3\nopen nothing\nget all");
  EXPECT_EQ(report.errors.at("open nothing: NotFound"), 3u);
  EXPECT_EQ(report.requests, 0u);
}

TEST(ScriptedClient, ResumesADroppedGetWithoutFetchingItAgain) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(5, 500'000));
  const KindReport report = run(server, "client a 4\nopen row\nget all drop after 1200KB");
  EXPECT_TRUE(report.errors.empty());
  EXPECT_EQ(report.dropped, 4u);
  EXPECT_EQ(report.parts, 4u * 9);
  EXPECT_EQ(report.useful_bytes, 4u * (5 * 500'000 + 4 * 3));
  // Of what was under way only the frame that the drop cut in two is lost.
  EXPECT_LT(report.received_bytes, report.useful_bytes + 4 * (kMaxDataPayload + 16'000));
}

TEST(ScriptedClient, CancelsAndGoesOn) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(50, 200'000));
  const KindReport report = run(server, "client a 2\nlink 8mbit\nopen row\nget all cancel after 20ms\nget 3");
  EXPECT_TRUE(report.errors.empty()) << report.errors.begin()->first;
  EXPECT_EQ(report.cancelled, 2u);
  EXPECT_EQ(report.useful_bytes, 2u * 200'000);
  EXPECT_LT(report.received_bytes, 2u * 9'000'000);
}

TEST(ScriptedClient, BehavesBadlyWithoutErrors) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(50, 100'000));
  const KindReport report = run(server,
                                "client a 4\nopen row\nstall 30ms\nlist\nopen row\nvanish 300KB\nlist\n"
                                "client b 8\ngarbage 2KB\nloop 3");
  EXPECT_TRUE(report.errors.empty()) << report.errors.begin()->first;
  EXPECT_EQ(report.cancelled, 8u);
  EXPECT_EQ(report.requests, 4u * 6 + 24);
  EXPECT_EQ(report.parts, 0u);
}

TEST(ScriptedClient, PublishesAModelEach) {
  // printf %s hunter2 | sha256sum
  const auto access = AccessTable::parse(
      "modeller read,publish sha256:f52fbd32b2b3b86ff88ef6c490628285f482af15ddcb29541f94bcf526a3f6c7\n");
  TestServer server({}, access.value(), nullptr, [](PackStore& store, ServerCounters& counters) {
    return std::make_unique<Publisher>(store, counters, PublishLimits());
  });
  const TempFolder files;
  const std::string text = obj_text(shapes::torus(10, 8));
  files.put("ring.obj", std::as_bytes(std::span(text)));
  LoadOptions options;
  options.connection.token = "hunter2";
  const KindReport report =
      run(server, "client a 3\npublish " + (files.path() / "ring.obj").string() + " ring\nlist", options);
  EXPECT_TRUE(report.errors.empty()) << report.errors.begin()->first;
  for (const char* name : {"ring-0.selvage", "ring-1.selvage", "ring-2.selvage"})
    EXPECT_TRUE(std::filesystem::exists(server.folder().path() / name)) << name;
}

TEST(ScriptedClient, VerifiesWhatItDecodes) {
  TestServer server;
  const TriangleSoup torus = shapes::torus(40, 30);
  server.folder().put("torus.selvage", labelled_pack(torus, cube_labels(torus, 0.7), 14));
  const KindReport report = run(server, "client a 3\nverify\nopen torus\nget all\nget random 50%\nloop 4");
  EXPECT_TRUE(report.errors.empty()) << report.errors.begin()->first;
  EXPECT_EQ(report.verified, 24u);
}

TEST(ScriptedClient, FindsWhatDoesNotDecode) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(3));
  const KindReport report = run(server, "client a 1\ndecode\nopen row\nget all");
  ASSERT_EQ(report.errors.size(), 1u);
  // Whichever part is decoded first decides: some of them look like those of a later version.
  const std::string& what = report.errors.begin()->first;
  EXPECT_TRUE(what == "get all: BadStream" || what == "get all: Unsupported") << what;
  EXPECT_EQ(report.errors.begin()->second, 1u);
}

/// Rounds every 5 ms of steps that take 20: each is later than the one before, and its latency says so.
TEST(ScriptedClient, MeasuresFromWhenARoundWasDue) {
  TestServer server;
  const char* text = "client a 1\nlink 20ms\n%s\nlist\nloop 6";
  char paced[100], closed[100];
  std::snprintf(paced, sizeof paced, text, "every 5ms");
  std::snprintf(closed, sizeof closed, text, "");
  const KindReport due = run(server, paced), sent = run(server, closed);
  EXPECT_GE(due.latency.at("list").max(), 5 * 15ms);
  EXPECT_GE(due.late_rounds, 5u);
  EXPECT_EQ(sent.late_rounds, 0u);
  EXPECT_LT(sent.latency.at("list").percentile(0.2), due.latency.at("list").max());
}

}  // namespace
}  // namespace selvage
