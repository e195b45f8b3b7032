// SPDX-License-Identifier: MIT
//
// Programs that are told to stop in the middle of their work: they end soon, say so, leave nothing half done
// behind, and harm nobody else.
#include <csignal>
#include <functional>

#include "client/session/blocking_client.h"
#include "tests/operate/process_fixture.h"
#include "tests/support/gated_proxy.h"
#include "tests/support/mesh_text.h"

namespace selvage {
namespace {

using testing::ChildProcess;
using testing::ServerProcess;

constexpr int kInterrupted = 130;

/// By Ctrl-C, or by whoever supervises processes.
class Interrupt : public ProcessFixture, public ::testing::WithParamInterface<int> {
 protected:
  Interrupt() { std::filesystem::create_directory(output()); }

  /// Where programs write to, and nobody else.
  std::filesystem::path output() const { return folder.path() / "output"; }

  std::unique_ptr<ChildProcess> run(const std::string& program, std::vector<std::string> arguments) const {
    return std::make_unique<ChildProcess>(program, std::move(arguments), folder.path() / "said");
  }

  /// Begins something that takes longer from one time to the next, and interrupts it once it `is_under_way`;
  /// until it was not over before.
  void interrupt_in_time(const std::function<std::unique_ptr<ChildProcess>(int rings)>& begin,
                         const std::function<bool(ChildProcess&)>& is_under_way) const {
    for (int rings = 150;; rings *= 2) {
      const auto program = begin(rings);
      if (!is_under_way(*program)) continue;
      const int code = program->end(GetParam());
      if (code == 0) continue;
      EXPECT_EQ(code, kInterrupted) << program->log();
      EXPECT_NE(program->log().find("cancelled"), std::string::npos) << program->log();
      return;
    }
  }

  std::string torus(int rings) const {
    return file("ring.obj", obj_text(shapes::torus(static_cast<std::uint32_t>(rings), 400)));
  }

  void expect_nothing_written() const { EXPECT_TRUE(std::filesystem::is_empty(output())); }

  static void expect_unharmed(ServerProcess& server) {
    auto client = BlockingClient::connect(server.address());
    ASSERT_TRUE(client) << client.error().message;
    EXPECT_TRUE(client->ping());
  }
};

TEST_P(Interrupt, BuildWritesNoPack) {
  const auto begin = [&](int rings) {
    auto build = run(SELVAGE_PACK, {"build", torus(rings), "--store", output().string()});
    build->wait_until_it_handles(GetParam());
    return build;
  };
  interrupt_in_time(begin, [](ChildProcess&) { return true; });
  expect_nothing_written();
}

TEST_P(Interrupt, GetFromASlowServerWritesNoMesh) {
  put_ring(store(), true);
  const auto server = start_on_store({"--max-rate", "10KiB"});
  const auto get = run(SELVAGE_CLIENT, {"get", server->address().to_string() + "/ring", "--cache", "off",
                                        "-o", (output() / "ring.ply").string()});
  get->wait_until_it_handles(GetParam());
  EXPECT_EQ(get->end(GetParam()), kInterrupted) << get->log();
  EXPECT_NE(get->log().find("cancelled"), std::string::npos) << get->log();
  expect_nothing_written();
  expect_unharmed(*server);
}

TEST_P(Interrupt, GetDoesNotWaitForAServerThatFellSilent) {
  put_ring(store(), true);
  const auto server = start_on_store();
  GatedProxy link(server->address(), {.from_client = GatedProxy::kAll, .from_server = 20'000});
  const auto get = run(SELVAGE_CLIENT, {"get", link.address().to_string() + "/ring", "--cache", "off", "-o",
                                        (output() / "ring.ply").string()});
  link.wait_until_silent();
  EXPECT_EQ(get->end(GetParam()), kInterrupted) << get->log();
  expect_nothing_written();
}

class InterruptPublish : public Interrupt {
 protected:
  /// ThreadSanitizer delivers signals when it likes.
#ifdef __SANITIZE_THREAD__
  static constexpr bool kSignalsComeInTime = false;
#else
  static constexpr bool kSignalsComeInTime = true;
#endif

  std::unique_ptr<ChildProcess> publish(const HostPort& to, const std::string& model) const {
    return run(SELVAGE_CLIENT, {"publish", to.to_string(), model, "--token", "hunter2"});
  }
  std::vector<std::string> with_tokens() const {
    return {"--tokens", file("tokens", std::string(kModeller) + "anonymous read\n")};
  }
  bool is_anything_staged() const {
    std::error_code error;
    const std::filesystem::directory_iterator staged(store() / ".uploads", error);
    return !error && staged != std::filesystem::directory_iterator();
  }
  /// Until the server has dealt with what the client said last.
  void wait_until_nothing_is_staged() const {
    while (is_anything_staged()) std::this_thread::yield();
  }
};

TEST_P(InterruptPublish, RemovesWhatWasSent) {
  if (!kSignalsComeInTime) GTEST_SKIP() << "the upload would be over";
  const auto server = start_on_store(with_tokens());
  GatedProxy link(server->address(), {.from_client = 100'000, .from_server = GatedProxy::kAll});
  const auto client = publish(link.address(), torus(300));
  link.wait_until_silent();
  client->signal(GetParam());
  link.open();
  EXPECT_EQ(client->end(0), kInterrupted) << client->log();
  EXPECT_NE(client->log().find("cancelled"), std::string::npos) << client->log();
  wait_until_nothing_is_staged();
  expect_unharmed(*server);
}

TEST_P(InterruptPublish, DoesNotWaitForAServerThatFellSilent) {
  const auto server = start_on_store(with_tokens());
  GatedProxy link(server->address(), {.from_client = 100'000, .from_server = GatedProxy::kAll});
  const auto client = publish(link.address(), torus(300));
  link.wait_until_silent();
  EXPECT_EQ(client->end(GetParam()), kInterrupted) << client->log();
}

TEST_P(InterruptPublish, EndsTheIngest) {
  if (!kSignalsComeInTime) GTEST_SKIP() << "the ingest would be over";
  const auto server = start_on_store(with_tokens());
  auto observer = BlockingClient::connect(server->address()).value();
  const auto is_ingesting = [&](ChildProcess&) {
    for (;;) {
      const auto status = observer.status().value();
      if (!status.jobs.empty() && status.jobs.front().stage != "wait") return true;
      if (status.published > 0) return false;
    }
  };
  const auto begin = [&](int rings) {
    std::filesystem::remove(store() / "ring.selvage");
    return publish(server->address(), torus(rings));
  };
  interrupt_in_time(begin, is_ingesting);
  wait_until_nothing_is_staged();
  EXPECT_TRUE(observer.list().value().empty());
  EXPECT_EQ(server->end(SIGTERM), 0);
}

TEST_P(Interrupt, LoadReportsWhatItSaw) {
  put_ring(store());
  const auto server = start_on_store();
  const std::string script = file("visit.load",
                                  "duration 10000s\n"
                                  "client viewer 3\n"
                                  "  open ring\n"
                                  "  get all\n"
                                  "  think 1000s\n"
                                  "  loop forever\n");
  const auto load = run(SELVAGE_LOAD, {server->address().to_string(), "--script", script, "--csv",
                                       (output() / "load.csv").string()});
  auto observer = BlockingClient::connect(server->address()).value();
  // Each viewer's open and get, besides these.
  for (std::uint64_t asked = 1; observer.status().value().requests < asked + 3 * 2; ++asked) {
  }
  load->signal(GetParam());
  const std::string report = load->read_all();
  EXPECT_EQ(load->end(0), kInterrupted) << load->log();
  EXPECT_NE(load->log().find("interrupted"), std::string::npos) << load->log();
  EXPECT_NE(report.find("get"), std::string::npos) << report;
  EXPECT_TRUE(std::filesystem::exists(output() / "load.csv"));
  EXPECT_TRUE(observer.ping());
}

const auto kSignals = ::testing::Values(SIGINT, SIGTERM);
std::string name_of_signal(const ::testing::TestParamInfo<int>& info) {
  return info.param == SIGINT ? "SIGINT" : "SIGTERM";
}
INSTANTIATE_TEST_SUITE_P(By, Interrupt, kSignals, name_of_signal);
INSTANTIATE_TEST_SUITE_P(By, InterruptPublish, kSignals, name_of_signal);

}  // namespace
}  // namespace selvage
