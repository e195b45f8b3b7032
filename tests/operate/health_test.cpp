// SPDX-License-Identifier: MIT
//
// What those who look after a server see of it.
#include <thread>

#include <gtest/gtest.h>

#include "client/session/blocking_client.h"
#include "common/base/log.h"
#include "server/operate/health_server.h"
#include "server/operate/metrics.h"
#include "tests/support/fake_pack.h"
#include "tests/support/http_get.h"
#include "tests/support/test_server.h"

namespace selvage {
namespace {

using testing::http_exchange;
using testing::http_get;

std::unique_ptr<HealthServer> start(HealthPages pages) {
  return std::move(HealthServer::start({"127.0.0.1", 0}, std::move(pages)).value());
}

TEST(Health, AnswersThreePagesAndNoOthers) {
  const auto server = start({[] { return "a_metric 1\n"; }, [] { return Result<void>(); }});
  EXPECT_TRUE(http_get(server->address(), "/healthz").starts_with("HTTP/1.1 200 "));
  const std::string metrics = http_get(server->address(), "/metrics");
  EXPECT_TRUE(metrics.starts_with("HTTP/1.1 200 "));
  EXPECT_TRUE(metrics.ends_with("a_metric 1\n"));
  EXPECT_NE(metrics.find("version=0.0.4"), std::string::npos);
  EXPECT_TRUE(http_get(server->address(), "/readyz").starts_with("HTTP/1.1 200 "));
  EXPECT_TRUE(http_get(server->address(), "/").starts_with("HTTP/1.1 404 "));
  EXPECT_TRUE(
      http_exchange(server->address(), "POST /metrics HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n")
          .starts_with("HTTP/1.1 405 "));
  const std::string head =
      http_exchange(server->address(), "HEAD /healthz HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
  EXPECT_TRUE(head.ends_with("\r\n\r\n")) << head;
}

TEST(Health, SaysWhyItIsNotReady) {
  const auto server =
      start({[] { return ""; }, []() -> Result<void> { return fail(ErrorCode::Io, "the disk is gone"); }});
  const std::string answer = http_get(server->address(), "/readyz");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 503 "));
  EXPECT_NE(answer.find("the disk is gone"), std::string::npos);
}

TEST(Health, GarbageEndsItsConnectionOnly) {
  const auto server = start({[] { return ""; }, [] { return Result<void>(); }});
  EXPECT_EQ(http_exchange(server->address(), std::string(100, '\0') + "\r\n\r\n"), "");
  EXPECT_EQ(http_exchange(server->address(), "GET /" + std::string(20'000, 'x') + " HTTP/1.1\r\n\r\n"), "");
  EXPECT_TRUE(http_get(server->address(), "/healthz").starts_with("HTTP/1.1 200 "));
}

TEST(Health, BoundsItsConnections) {
  const auto server = start({[] { return ""; }, [] { return Result<void>(); }});
  const HostPort address = server->address();
  const auto answers = [&] {
    try {
      return http_get(address, "/healthz").starts_with("HTTP/1.1 200 ");
    } catch (const boost::system::system_error&) {
      return false;  // it has hung up on us
    }
  };
  asio::io_context io;
  std::vector<asio::ip::tcp::socket> silent;
  for (int i = 0; i < 32; ++i) {
    silent.emplace_back(io);
    silent.back().connect({asio::ip::make_address(address.host), address.port});
  }
  EXPECT_FALSE(answers());
  silent.clear();
  while (!answers()) std::this_thread::yield();  // until it has noticed
}

TEST(Metrics, CountWhatHappened) {
  TestServer server;
  server.folder().put("row.selvage", fake_pack_bytes(3));
  server.folder().put("torn.selvage", Bytes(10));
  auto client = BlockingClient::connect(server.address()).value();
  ASSERT_TRUE(client.list());
  EXPECT_FALSE(client.open("none"));
  const std::string text = metrics_text(server.services());
  for (const char* line :
       {"selvage_connections 1\n", "selvage_connections_total 1\n",
        "selvage_requests_total{kind=\"list\"} 1\n", "selvage_requests_total{kind=\"open\"} 1\n",
        "selvage_errors_total{code=\"NotFound\"} 1\n", "selvage_models 2\n", "selvage_models_damaged 1\n",
        "# TYPE selvage_sent_bytes_total counter\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
  }
}

TEST(Log, FieldsAreQuotedWhereTheyMustBe) {
  for (const LogFormat format : {LogFormat::Text, LogFormat::Json}) {
    set_log_format(format);
    ::testing::internal::CaptureStderr();
    log(LogLevel::Info, "model refused", {{"model", "a b"}, {"reason", "\"x\"\n\x1b[31m"}, {"n", "5"}});
    const std::string line = ::testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::ranges::count(line, '\n'), 1) << line;
    EXPECT_EQ(line.find('\x1b'), std::string::npos) << line;
    const char* expected =
        format == LogFormat::Text
            ? R"(info model refused model="a b" reason="\"x\"\u000a\u001b[31m" n=5)"
            : R"("message":"model refused","model":"a b","reason":"\"x\"\u000a\u001b[31m","n":"5"})";
    EXPECT_NE(line.find(expected), std::string::npos) << line;
  }
  set_log_format(LogFormat::Text);
}

}  // namespace
}  // namespace selvage
