// SPDX-License-Identifier: MIT
//
// TLS and tokens over real sockets: who gets in, who does not, and what they are told.
#include <fstream>

#include <gtest/gtest.h>

#include "client/session/blocking_client.h"
#include "tests/support/certificates.h"
#include "tests/support/fake_pack.h"
#include "tests/support/test_server.h"

namespace selvage {
namespace {

using testing::TestAuthority;

constexpr auto ignore_part = [](ReceivedPart) { return Result<void>(); };

/// printf %s secret | sha256sum; and of "hunter2".
const std::string kTokens =
    "viewer read sha256:2bb80d537b1da3e38bd30361aa855686bde0eacd7162fef6a25fe97bf527a25b\n"
    "robot publish sha256:f52fbd32b2b3b86ff88ef6c490628285f482af15ddcb29541f94bcf526a3f6c7\n";

class Secure : public ::testing::Test {
 protected:
  std::shared_ptr<TlsContext> server_context(const TestAuthority::Request& request = {}) {
    return tls_server_context(authority.issue(request)).value();
  }
  ClientOptions trusting(const std::filesystem::path& ca, std::string token = {}) const {
    ClientOptions options;
    options.tls = TlsTrust{ca};
    options.token = std::move(token);
    return options;
  }
  ClientOptions trusting() const { return trusting(authority.certificate()); }
  ClientOptions with_token(std::string token) const {
    return trusting(authority.certificate(), std::move(token));
  }
  /// Why nobody gets in.
  static Error refusal(const TestServer& server, const ClientOptions& options) {
    auto client = BlockingClient::connect(server.address(), options);
    if (client) throw std::runtime_error("the client got in");
    return client.error();
  }

  TempFolder folder;
  TestAuthority authority{folder.path(), "good"};
};

TEST_F(Secure, ServesLargePartsOverTls) {
  TestServer server({}, {}, server_context());
  server.folder().put("row.selvage", fake_pack_bytes(40, 300'000));
  auto client = BlockingClient::connect(server.address(), trusting());
  ASSERT_TRUE(client) << client.error().message;
  const auto manifest = client->open("row").value();
  const auto stats = client->get({manifest, {.kind = Selection::Kind::All}}, ignore_part);
  ASSERT_TRUE(stats) << stats.error().message;
  EXPECT_EQ(stats->bytes, 40u * 300'000 + 39 * 3);
}

TEST_F(Secure, AnUnknownAuthorityIsRefusedWithARemedy) {
  TestServer server({}, {}, server_context());
  const TestAuthority other(folder.path(), "other");
  const Error error = refusal(server, trusting(other.certificate()));
  EXPECT_EQ(error.code, ErrorCode::Unauthorised);
  EXPECT_NE(error.message.find("--ca"), std::string::npos) << error.message;
  EXPECT_NE(error.message.find("127.0.0.1"), std::string::npos) << error.message;
}

TEST_F(Secure, AnExpiredCertificateIsRefusedAsSuch) {
  TestServer server({}, {}, server_context({.valid_days = -2}));
  const Error error = refusal(server, trusting());
  EXPECT_EQ(error.code, ErrorCode::Unauthorised);
  EXPECT_NE(error.message.find("expired"), std::string::npos) << error.message;
}

TEST_F(Secure, ACertificateForAnotherAddressIsRefusedAsSuch) {
  TestServer server({}, {}, server_context({.names = "DNS:example.org,IP:192.0.2.1"}));
  const Error error = refusal(server, trusting());
  EXPECT_EQ(error.code, ErrorCode::Unauthorised);
  EXPECT_NE(error.message.find("another name"), std::string::npos) << error.message;
}

TEST_F(Secure, PlainClientsAndTlsServersDoNotMeet) {
  TestServer secure({}, {}, server_context());
  EXPECT_NE(refusal(secure, {}).message.find("TLS"), std::string::npos);
  TestServer plain;
  EXPECT_NE(refusal(plain, trusting()).message.find("TLS"), std::string::npos);
}

TEST_F(Secure, ASilentHandshakeTimesOut) {
  ServerLimits limits;
  limits.session.handshake_timeout = std::chrono::milliseconds(50);
  TestServer server(limits, {}, server_context());
  asio::io_context io;
  asio::ip::tcp::socket socket(io);
  socket.connect({asio::ip::make_address("127.0.0.1"), server.address().port});
  char byte;
  boost::system::error_code error;
  socket.read_some(asio::buffer(&byte, 1), error);  // returns once the server has had enough
  EXPECT_EQ(error, asio::error::eof);
}

TEST_F(Secure, NewCertificatesServeNewConnectionsOnly) {
  TestServer server({}, {}, server_context());
  auto early = BlockingClient::connect(server.address(), trusting());
  ASSERT_TRUE(early);
  const TestAuthority fresh(folder.path(), "fresh");
  server.listener().set_tls(tls_server_context(fresh.issue({.file = "new"})).value());
  auto late = BlockingClient::connect(server.address(), trusting(fresh.certificate()));
  ASSERT_TRUE(late) << late.error().message;
  EXPECT_TRUE(early->ping());
  refusal(server, trusting());
}

TEST_F(Secure, FilesThatAreNoneAreNamed) {
  const TlsServerFiles good = authority.issue({});
  const auto other = authority.issue({.file = "other"});
  folder.put("junk.pem", {});
  const auto junk = folder.path() / "junk.pem";
  EXPECT_EQ(tls_server_context({good.certificate, other.key}).error().code, ErrorCode::InvalidArgument);
  EXPECT_EQ(tls_server_context({folder.path() / "none", good.key}).error().code, ErrorCode::NotFound);
  for (const auto& files : {TlsServerFiles{junk, good.key}, TlsServerFiles{good.certificate, junk}}) {
    const auto context = tls_server_context(files);
    ASSERT_FALSE(context);
    EXPECT_EQ(context.error().code, ErrorCode::BadFile);
    EXPECT_NE(context.error().message.find("junk.pem"), std::string::npos) << context.error().message;
  }
  EXPECT_EQ(tls_client_context(junk).error().code, ErrorCode::BadFile);
}

TEST_F(Secure, ATokenOpensItsScopesOnly) {
  TestServer server({}, AccessTable::parse(kTokens).value(), server_context());
  server.folder().put("row.selvage", fake_pack_bytes(3));
  auto viewer = BlockingClient::connect(server.address(), with_token("secret"));
  ASSERT_TRUE(viewer) << viewer.error().message;
  EXPECT_TRUE(viewer->list());
  EXPECT_TRUE(viewer->open("row"));

  auto robot = BlockingClient::connect(server.address(), with_token("hunter2"));
  ASSERT_TRUE(robot) << robot.error().message;
  const auto list = robot->list();
  ASSERT_FALSE(list);
  EXPECT_EQ(list.error().code, ErrorCode::Unauthorised);
  EXPECT_NE(list.error().message.find("'read'"), std::string::npos) << list.error().message;
  EXPECT_NE(list.error().message.find("robot"), std::string::npos) << list.error().message;
  EXPECT_TRUE(robot->ping()) << "the connection goes on";
}

TEST_F(Secure, WrongTokensAndNoneEndTheConnection) {
  TestServer server({}, AccessTable::parse(kTokens).value(), server_context());
  for (const char* token : {"", "Secret"}) {
    const Error error = refusal(server, with_token(token));
    EXPECT_EQ(error.code, ErrorCode::Unauthorised) << token;
    EXPECT_NE(error.message.find("token"), std::string::npos) << error.message;
  }
}

TEST_F(Secure, NewTokensCountForNewConnectionsOnly) {
  TestServer server({}, AccessTable::parse(kTokens).value(), server_context());
  auto early = BlockingClient::connect(server.address(), with_token("secret"));
  ASSERT_TRUE(early);
  server.access().replace(AccessTable::parse("").value());
  refusal(server, with_token("secret"));
  EXPECT_TRUE(early->list());
}

TEST_F(Secure, TurnsAwayBeyondTheLimitOfOneAddress) {
  ServerLimits limits;
  limits.connections_per_address = 2;
  TestServer server(limits);
  auto first = BlockingClient::connect(server.address());
  {
    auto second = BlockingClient::connect(server.address());
    ASSERT_TRUE(first && second);
    EXPECT_EQ(refusal(server, {}).code, ErrorCode::Unavailable);
    EXPECT_EQ(server.counters().connections_refused, 1u);
  }
  // Once one has left there is room; the server notices in its own time.
  Result<BlockingClient> next = BlockingClient::connect(server.address());
  while (!next) next = BlockingClient::connect(server.address());
  EXPECT_TRUE(next->ping());
}

}  // namespace
}  // namespace selvage
