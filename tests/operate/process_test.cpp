// SPDX-License-Identifier: MIT
//
// The server as a process: options and files, signals, and kill -9 in the middle of things.
#include <algorithm>
#include <fstream>
#include <set>
#include <thread>

#include <sys/resource.h>

#include <gtest/gtest.h>

#include "client/session/blocking_client.h"
#include "common/base/hash.h"
#include "tests/operate/process_fixture.h"
#include "tests/support/certificates.h"
#include "tests/support/fake_pack.h"
#include "tests/support/http_get.h"
#include "tests/support/mesh_text.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

using testing::quoted;
using testing::run_program;
using testing::ServerProcess;
using testing::TestAuthority;

/// printf %s secret | sha256sum
const std::string kViewer =
    "viewer read sha256:2bb80d537b1da3e38bd30361aa855686bde0eacd7162fef6a25fe97bf527a25b\n";

constexpr auto ignore_part = [](ReceivedPart) { return Result<void>(); };

class Process : public ProcessFixture {
 protected:
  static ClientOptions with_token(const std::string& token) {
    ClientOptions options;
    options.token = token;
    return options;
  }
};

TEST_F(Process, StopsInGoodOrder) {
  const auto server = start_on_store();
  auto client = BlockingClient::connect(server->address());
  ASSERT_TRUE(client) << client.error().message;
  EXPECT_EQ(server->end(SIGTERM), 0);
}

TEST_F(Process, DoesNotServeOtherMachinesInTheClear) {
  const auto said =
      run_program(quoted(SELVAGE_SERVER) + " --store " + store().string() + " --listen 0.0.0.0:0");
  EXPECT_EQ(said.code, 1);
  EXPECT_NE(said.text.find("--allow-plain"), std::string::npos) << said.text;
  ServerProcess allowed(SELVAGE_SERVER,
                        {"--store", store().string(), "--listen", "0.0.0.0:0", "--allow-plain"},
                        folder.path() / "log");
  EXPECT_TRUE(BlockingClient::connect({"127.0.0.1", allowed.address().port}));
}

TEST_F(Process, ReadsAConfigurationThatTheCommandLineOverrides) {
  const std::string config =
      file("server.toml", "store = \"" + store().string() +
                              "\"\nmax-connections = 1  # at a time\nidle-timeout = 2.5\nmax-upload = "
                              "\"1MiB\"\nallow-plain = false\n");
  {
    const auto server = start({"--config", config});
    auto first = BlockingClient::connect(server->address());
    ASSERT_TRUE(first) << first.error().message;
    EXPECT_FALSE(BlockingClient::connect(server->address()));
  }
  const auto server = start({"--config", config, "--max-connections", "2"});
  auto first = BlockingClient::connect(server->address());
  EXPECT_TRUE(BlockingClient::connect(server->address()));
}

TEST_F(Process, BadConfigurationsNameTheirLine) {
  for (const std::string bad :
       {"store = \"x\"\nmax-conections = 5\n", "# fine\nstore = [\n", "\nstore = [1, 2]\n"}) {
    const std::string config = file("bad.toml", bad);
    const auto said = run_program(quoted(SELVAGE_SERVER) + " --config " + config);
    EXPECT_NE(said.code, 0);
    EXPECT_TRUE(said.text.find("line 2") != std::string::npos ||
                said.text.find("line 3") != std::string::npos)
        << said.text;
  }
  const auto said = run_program(quoted(SELVAGE_SERVER) + " --store x --max-upload lots");
  EXPECT_NE(said.text.find("max-upload"), std::string::npos) << said.text;
}

TEST_F(Process, ChoosesTheCongestionControlThatThereIs) {
  EXPECT_TRUE(BlockingClient::connect(start_on_store({"--congestion-control", "reno"})->address()));
  const auto said = run_program(quoted(SELVAGE_SERVER) + " --store " + quoted(store().string()) +
                                " --listen 127.0.0.1:0 --congestion-control haste");
  EXPECT_NE(said.code, 0);
  EXPECT_NE(said.text.find("no congestion control 'haste'"), std::string::npos) << said.text;
}

TEST_F(Process, ToolsTalkToItOverTls) {
  const TestAuthority authority(folder.path(), "test");
  const auto files = authority.issue({});
  std::ofstream(store() / "row.selvage", std::ios::binary).write("torn", 4);
  const auto server = start_on_store({"--cert", files.certificate.string(), "--key", files.key.string(),
                                      "--tokens", file("tokens", kViewer)});
  const std::string client = quoted(SELVAGE_CLIENT);
  const std::string at = server->address().to_string();
  const std::string ca = " --ca " + authority.certificate().string();
  const std::string token = " --token-file " + file("token", "secret\n");
  const auto status = run_program(client + " status " + at + ca + token);
  EXPECT_EQ(status.code, 0) << status.text;
  EXPECT_NE(status.text.find("encrypted"), std::string::npos) << status.text;
  EXPECT_EQ(run_program("SELVAGE_TOKEN=secret " + client + " list " + at + ca).code, 0);
  const auto json = run_program(client + " status --json " + at + ca + token);
  EXPECT_NE(json.text.find("\"encrypted\": true"), std::string::npos) << json.text;

  const auto unknown = run_program(client + " list " + at + " --tls" + token);
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.text.find("--ca"), std::string::npos) << unknown.text;
  const auto tokenless = run_program(client + " list " + at + ca);
  EXPECT_NE(tokenless.text.find("token"), std::string::npos) << tokenless.text;
  const auto scopeless = run_program(client + " unpublish " + at + " row" + ca + token);
  EXPECT_NE(scopeless.text.find("'publish'"), std::string::npos) << scopeless.text;
}

TEST_F(Process, HangupReadsTokensAndCertificatesAgain) {
  const TestAuthority authority(folder.path(), "old");
  const auto files = authority.issue({});
  const std::string tokens = file("tokens", kViewer);
  const auto server =
      start_on_store({"--cert", files.certificate.string(), "--key", files.key.string(), "--tokens", tokens});
  ClientOptions viewer = with_token("secret"), modeller = with_token("hunter2");
  viewer.tls = modeller.tls = TlsTrust{authority.certificate()};
  auto early = BlockingClient::connect(server->address(), viewer);
  ASSERT_TRUE(early) << early.error().message;
  EXPECT_FALSE(BlockingClient::connect(server->address(), modeller));

  const TestAuthority fresh(folder.path(), "new");
  fresh.issue({});  // over the old files
  file("tokens", kModeller);
  server->signal(SIGHUP);
  modeller.tls = TlsTrust{fresh.certificate()};
  auto late = BlockingClient::connect(server->address(), modeller);
  while (!late) late = BlockingClient::connect(server->address(), modeller);  // until the signal has arrived
  viewer.tls = TlsTrust{fresh.certificate()};
  EXPECT_FALSE(BlockingClient::connect(server->address(), viewer));
  EXPECT_TRUE(early->list()) << "who is connected stays";

  file("tokens", "nonsense");
  server->signal(SIGHUP);
  while (server->log().find("the tokens stay as they were") == std::string::npos) std::this_thread::yield();
  EXPECT_TRUE(BlockingClient::connect(server->address(), modeller));
}

TEST_F(Process, HealthAndLogTellOfTheStore) {
  const auto server = start_on_store({"--health", "127.0.0.1:0", "--log-format", "json"});
  server->address();
  const std::string log = server->log();
  const std::size_t at = log.find("\"address\":\"");
  ASSERT_NE(at, std::string::npos) << log;
  const std::string text = log.substr(at + 11, log.find('"', at + 11) - at - 11);
  const HostPort health = parse_host_port(text).value();
  EXPECT_TRUE(testing::http_get(health, "/readyz").starts_with("HTTP/1.1 200 "));
  std::ofstream(store() / "torn.selvage") << "torn";
  while (server->log().find("model refused") == std::string::npos) std::this_thread::yield();
  EXPECT_NE(testing::http_get(health, "/metrics").find("selvage_models_damaged 1\n"), std::string::npos);
  std::filesystem::remove_all(store());
  EXPECT_TRUE(testing::http_get(health, "/readyz").starts_with("HTTP/1.1 503 "));
}

/// Publishes again and again while the server is killed at one point after the other. What a server has said
/// that it holds, the next one must hold; a model that was acknowledged must be there, whole.
TEST_F(Process, KillDuringPublishLosesNothingThatWasAcknowledged) {
  const std::string text = obj_text(shapes::torus(150, 200));
  PublishRequest request;
  request.what.name = "ring";
  request.what.file = "ring.obj";
  request.what.size_bytes = text.size();
  request.what.hash = hash_of(std::as_bytes(std::span(text)));
  std::uint64_t last_start = 0;
  bool is_first_read = true;
  request.read = [&](std::uint64_t offset, std::span<std::byte> into) -> Result<std::size_t> {
    if (std::exchange(is_first_read, false)) {
      EXPECT_GE(offset, last_start) << "the server lost what it held";
      last_start = offset;
    }
    const auto rest = std::as_bytes(std::span(text)).subspan(offset);
    const auto count = std::min(rest.size(), into.size());
    std::ranges::copy(rest.first(count), into.begin());
    return count;
  };
  const auto staged_bytes = [&] {
    std::uintmax_t sum = 0;
    std::error_code error;
    for (std::filesystem::directory_iterator at(store() / ".uploads", error), end; !error && at != end;
         at.increment(error)) {
      std::error_code gone;
      const auto size = at->file_size(gone);
      if (!gone) sum += size;
    }
    return sum;
  };
  const std::vector<std::string> arguments = {"--tokens", file("tokens", kModeller)};
  const std::vector<std::string> stages = {"", "", "", "wait", "check", "read", "segment", "encode", "write"};
  bool is_published = false;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const auto server = start_on_store(arguments);
    auto client = BlockingClient::connect(server->address(), with_token("hunter2"));
    ASSERT_TRUE(client) << client.error().message;
    const auto models = client->list();
    ASSERT_TRUE(models) << models.error().message;
    for (const ModelInfo& model : *models) EXPECT_EQ(model.problem, "");
    if (is_published) {
      EXPECT_EQ(models->size(), 1u);
    }
    is_first_read = true;
    const auto kill = [&](const PublishState& state) {
      const bool is_there = state.server.stage == stages[i];
      if (!is_there || (stages[i].empty() && state.sent_bytes <= (i + 1) * text.size() / 5)) return;
      // Of several frames the first has been written: the server is about to hold it.
      while (stages[i].empty() && i > 0 && staged_bytes() == 0) std::this_thread::yield();
      server->signal(SIGKILL);
    };
    is_published |= client->publish(request, kill).has_value();
  }
  const auto server = start_on_store(arguments);
  auto client = BlockingClient::connect(server->address(), with_token("hunter2"));
  ASSERT_TRUE(client) << client.error().message;
  is_first_read = true;
  const auto published = client->publish(request, [](const PublishState&) {});
  ASSERT_TRUE(published) << published.error().message;
  EXPECT_GT(last_start, 0u) << "nothing was resumed";
  const auto pack = Pack::open(store() / "ring.selvage");
  ASSERT_TRUE(pack) << pack.error().message;
  EXPECT_EQ((*pack)->id(), published->pack_id);
  const std::filesystem::directory_iterator staged(store() / ".uploads"), end;
  EXPECT_EQ(std::distance(staged, end), 0);
}

/// cp over a served pack cuts it short and writes it anew.
TEST_F(Process, SurvivesAPackThatIsOverwrittenInPlace) {
  const auto bytes = fake_pack_bytes(200, 60'000);
  const auto path = store() / "row.selvage";
  const auto write = [&](std::size_t size) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(size));
  };
  write(bytes.size());
  const auto server = start_on_store();
  auto client = BlockingClient::connect(server->address()).value();
  const auto manifest = client.open("row").value();
  const GetRequest request{manifest, {.kind = Selection::Kind::All}};
  bool is_first = true;
  const auto cut = client.get(request, [&](ReceivedPart) -> Result<void> {
    if (std::exchange(is_first, false)) write(20'000);
    return {};
  });
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().code, ErrorCode::BadStream) << cut.error().message;

  auto other = BlockingClient::connect(server->address()).value();
  const auto models = other.list();
  ASSERT_TRUE(models) << models.error().message;
  EXPECT_NE(models->at(0).problem, "");
  write(bytes.size());
  const auto whole = other.open("row");
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_TRUE(other.get({*whole, {.kind = Selection::Kind::All}}, ignore_part));
  EXPECT_EQ(server->end(SIGTERM), 0);
}

TEST_F(Process, HasAsManyDescriptorsAsItMay) {
  rlimit before{}, few{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  few = {40, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
  const auto server = start_on_store();
  server->address();
  ::setrlimit(RLIMIT_NOFILE, &before);
  std::vector<BlockingClient> clients;
  for (int i = 0; i < 60; ++i) {
    auto client = BlockingClient::connect(server->address());
    ASSERT_TRUE(client) << client.error().message;
    clients.push_back(std::move(*client));
  }
}

/// What a client got before the server was killed need not be fetched again.
TEST_F(Process, KillDuringGetLosesNothingThatArrived) {
  {
    const auto bytes = fake_pack_bytes(200, 60'000);
    std::ofstream(store() / "row.selvage", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  std::vector<Hash> have;
  std::uint32_t received = 0;
  for (int round = 0; round < 4; ++round) {
    const auto server = start_on_store();
    ClientOptions options;
    options.window_bytes = 1 << 20;
    auto client = BlockingClient::connect(server->address(), options);
    ASSERT_TRUE(client) << client.error().message;
    const auto manifest = client->open("row");
    ASSERT_TRUE(manifest) << manifest.error().message;
    std::uint32_t in_round = 0;
    GetRequest request{*manifest, {.kind = Selection::Kind::All}};
    request.have = have;
    const auto stats = client->get(request, [&](ReceivedPart part) -> Result<void> {
      have.push_back(hash_of(part.bytes));
      ++received;
      if (++in_round == 40 && round < 3) server->signal(SIGKILL);
      return {};
    });
    EXPECT_EQ(stats.has_value(), round == 3);
    if (round == 3) {
      EXPECT_GE(stats->held, 120u);
    }
  }
  EXPECT_EQ(received, 399u) << "each part came once";
  EXPECT_EQ(std::set<Hash>(have.begin(), have.end()).size(), have.size());
}

/// Ctrl-C ends a get at once; the next one fetches what the first did not.
TEST_F(Process, AnInterruptedGetGoesOnFromItsCache) {
  put_ring(store(), true);
  ASSERT_GT(std::filesystem::file_size(store() / "ring.selvage"), 96u << 10)
      << "the server's limit to rates lets a burst pass";
  const std::string output = (folder.path() / "ring.ply").string();
  const std::string cache = (folder.path() / "cache").string();
  const auto has_parts = [&] {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             cache, std::filesystem::directory_options::skip_permission_denied)) {
      if (entry.path().string().find("/parts/") != std::string::npos && entry.is_regular_file()) return true;
    }
    return false;
  };
  std::filesystem::create_directory(cache);
  std::string address;
  {
    const auto slow = start_on_store({"--max-rate", "10KiB"});
    address = slow->address().to_string();
    ServerProcess client(SELVAGE_CLIENT, {"get", address + "/ring", "-o", output, "--cache", cache},
                         folder.path() / "client");
    while (!has_parts()) std::this_thread::yield();
    EXPECT_EQ(client.end(SIGINT), 130) << client.log();
    EXPECT_NE(client.log().find("cancelled"), std::string::npos) << client.log();
  }
  EXPECT_FALSE(std::filesystem::exists(output));

  ServerProcess server(SELVAGE_SERVER, {"--store", store().string(), "--listen", address},
                       folder.path() / "log");
  EXPECT_EQ(server.address().to_string(), address);
  const auto again = run_program(quoted(SELVAGE_CLIENT) + " get " + address + "/ring -o " + output +
                                 " --json --cache " + cache);
  EXPECT_EQ(again.code, 0) << again.text;
  EXPECT_EQ(again.text.find("\"cached_parts\": 0,"), std::string::npos) << again.text;
  EXPECT_NE(again.text.find("\"cached_parts\": "), std::string::npos) << again.text;
  EXPECT_TRUE(std::filesystem::exists(output));
}

}  // namespace
}  // namespace selvage
