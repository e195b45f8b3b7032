// SPDX-License-Identifier: MIT
#include "client/load/scripted_client.h"

#include <gtest/gtest.h>

#include "tests/support/fake_pack.h"
#include "tests/support/test_server.h"

namespace selvage {
namespace {

LoadReport run(const TestServer& server, const char* text, std::uint32_t clients,
               std::uint64_t max_requests = 1000) {
  const LoadScript script = parse_load_script(text).value();
  return run_load(script, {.server = server.address(),
                           .clients = clients,
                           .duration = std::chrono::seconds(60),
                           .max_requests = max_requests});
}

TEST(ScriptedClient, CountsWhatTheScriptAsksFor) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(10, 1000));
  const LoadReport report = run(server, "list\nopen row\nget all\nget 2-4\nrepeat 3", 5);
  EXPECT_TRUE(report.errors.empty());
  EXPECT_EQ(report.requests, 5u * 3 * 4);
  EXPECT_EQ(report.parts, 5u * 3 * (10 + 9 + 3 + 2));
  EXPECT_EQ(report.bytes, 5u * 3 * (10 * 1000 + 9 * 3 + 3 * 1000 + 2 * 3));
  EXPECT_EQ(report.latency.at("get").count(), 30u);
  EXPECT_EQ(report.latency.at("connect").count(), 5u);
  EXPECT_EQ(report.first_region.count(), 30u);
}

TEST(ScriptedClient, StopsAtTheBoundOnRequests) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(3));
  EXPECT_EQ(run(server, "open row\nget random 50%\nrepeat forever", 4, 41).requests, 41u);
}

TEST(ScriptedClient, CountsErrorsByKind) {
  TestServer server;
  const LoadReport report = run(server, "open nothing\nget all", 3);
  EXPECT_EQ(report.errors.at("NotFound"), 3u);
  EXPECT_EQ(report.requests, 0u);
}

}  // namespace
}  // namespace selvage
