// SPDX-License-Identifier: MIT
//
// Each of the server's options sets its own limit and no other, on the command line and in a file.
#include "server/app/server_options.h"

#include <fstream>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace selvage {
namespace {

using namespace std::chrono_literals;

struct Setting {
  const char* option;
  const char* value;
};

constexpr Setting kSettings[] = {
    {"max-connections", "11"},      {"max-connections-per-address", "12"},
    {"max-requests", "13"},         {"max-ids", "14"},
    {"max-queued-parts", "15"},     {"max-opened-models", "16"},
    {"max-message", "200KiB"},      {"max-queued", "18KiB"},
    {"max-rate", "19KiB"},          {"handshake-timeout", "20.5"},
    {"idle-timeout", "21.5"},       {"write-timeout", "22.5"},
    {"shutdown-grace", "23.5"},     {"max-upload", "24KiB"},
    {"max-staged", "25KiB"},        {"staged-age", "26"},
    {"publish-queue", "27"},        {"publish-threads", "28"},
    {"store-poll", "29.5"},         {"threads", "30"},
    {"congestion-control", "reno"},
};

ServerOptions parsed(std::vector<std::string> arguments) {
  ServerOptions options;
  CLI::App app;
  add_options(app, options);
  std::ranges::reverse(arguments);  // as CLI11 wants them
  app.parse(arguments);
  return options;
}

void expect_settings(const ServerOptions& options) {
  const ServerLimits& server = options.limits;
  EXPECT_EQ(server.connections, 11u);
  EXPECT_EQ(server.connections_per_address, 12u);
  EXPECT_EQ(server.session.requests, 13u);
  EXPECT_EQ(server.session.ids_per_request, 14u);
  EXPECT_EQ(server.session.queued_parts, 15u);
  EXPECT_EQ(server.session.opened_models, 16u);
  EXPECT_EQ(server.session.message_bytes, 200u << 10);
  EXPECT_EQ(server.session.queued_bytes, 18u << 10);
  EXPECT_EQ(server.session.bytes_per_second, 19u << 10);
  EXPECT_EQ(server.session.handshake_timeout, 20'500ms);
  EXPECT_EQ(server.session.idle_timeout, 21'500ms);
  EXPECT_EQ(server.session.write_timeout, 22'500ms);
  EXPECT_EQ(server.shutdown_grace, 23'500ms);
  EXPECT_EQ(options.publish.upload_bytes, 24u << 10);
  EXPECT_EQ(options.publish.staged_bytes, 25u << 10);
  EXPECT_EQ(options.publish.staged_age, 26s);
  EXPECT_EQ(options.publish.queue, 27u);
  EXPECT_EQ(options.publish.threads, 28u);
  EXPECT_EQ(options.store_poll, 29'500ms);
  EXPECT_EQ(options.threads, 30u);
  EXPECT_EQ(options.congestion_control, "reno");
}

TEST(ServerOptions, EachSetsItsOwnLimit) {
  std::vector<std::string> arguments{"--store", "."};
  for (const Setting& setting : kSettings) {
    arguments.push_back(std::string("--") + setting.option);
    arguments.push_back(setting.value);
  }
  expect_settings(parsed(arguments));
}

TEST(ServerOptions, EachSetsItsOwnLimitInAFile) {
  const TempFolder folder;
  const auto file = folder.path() / "server.toml";
  {
    std::ofstream text(file);
    text << "store = \".\"\n";
    for (const Setting& setting : kSettings) text << setting.option << " = \"" << setting.value << "\"\n";
  }
  expect_settings(parsed({"--config", file.string()}));
}

}  // namespace
}  // namespace selvage
