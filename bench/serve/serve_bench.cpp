// SPDX-License-Identifier: MIT
//
// What serving costs, against nginx on the same packs in the same run: server CPU from the operating system's
// accounting, medians over interleaved rounds.
//
//     apt-get install nginx-light; ulimit -n 20000
//     build/release/bin/serve_bench --server build/release/bin/selvage-server
#include <algorithm>
#include <cstdio>
#include <random>

#include <CLI/CLI.hpp>

#include "bench/serve/bulk_pings.h"
#include "bench/serve/closed_loop.h"
#include "bench/serve/idle_clients.h"
#include "bench/serve/peers.h"
#include "bench/serve/private_network.h"
#include "tests/support/certificates.h"

namespace {

using namespace selvage;
using namespace selvage::bench;

struct Work {
  const char* model;
  std::uint32_t part_size;
  std::uint32_t regions;  ///< of its pack
  unsigned batch;         ///< parts in a request
  unsigned connections;
};

struct Sample {
  double cpu_us = 0;  ///< of the server, for a part
  double parts_per_second = 0;
  double p50 = 0, p99 = 0;
};

std::vector<RegionId> some_regions(std::mt19937& random, const Work& work) {
  std::vector<RegionId> ids;
  while (ids.size() < work.batch) {
    const RegionId id = 1 + static_cast<RegionId>(random() % work.regions);
    if (std::ranges::find(ids, id) == ids.end()) ids.push_back(id);
  }
  return ids;
}

Sample measure(const Peer& peer, LoopPlan plan, const Work& work, double seconds) {
  plan.port = peer.port;
  plan.connections = work.connections;
  plan.seconds = seconds;
  const double before = peer.process->cpu_seconds();
  const LoopResult result = run_closed_loop(plan);
  const double parts = static_cast<double>(result.answers) * work.batch;
  return {(peer.process->cpu_seconds() - before) / parts * 1e6, parts / result.seconds, result.quantile(0.5),
          result.quantile(0.99)};
}

double median(std::vector<Sample> samples, double Sample::*field) {
  std::ranges::sort(samples, {}, field);
  return samples[samples.size() / 2].*field;
}

void compare(const Peer& selvage, const Peer& nginx, const Pack& pack, const Work& work, unsigned rounds,
             double seconds) {
  LoopPlan ours, theirs;
  const std::string name = work.model;
  ours.speech = Speech::Selvage;
  ours.greeting = hello_bytes();
  ours.request = [&](std::mt19937& random) { return selvage_request(name, some_regions(random, work)); };
  theirs.request = [&](std::mt19937& random) { return http_request(name, pack, some_regions(random, work)); };
  std::vector<Sample> mine, peers;
  for (unsigned i = 0; i < rounds; ++i) {
    mine.push_back(measure(selvage, ours, work, seconds));
    peers.push_back(measure(nginx, theirs, work, seconds));
  }
  const double cpu = median(mine, &Sample::cpu_us), peer_cpu = median(peers, &Sample::cpu_us);
  const double p99 = median(mine, &Sample::p99), peer_p99 = median(peers, &Sample::p99);
  std::printf("%7u %6u %6u %10.2f %10.2f %7.2f %11.0f %11.0f %9.2f %9.2f %7.2f\n", work.part_size, work.batch,
              work.connections, cpu, peer_cpu, cpu / peer_cpu, median(mine, &Sample::parts_per_second),
              median(peers, &Sample::parts_per_second), p99 * 1e3, peer_p99 * 1e3, p99 / peer_p99);
  std::fflush(stdout);
}

/// Plain connections, and a tenth as many over TLS.
void hold_idle(const std::string& server, const std::filesystem::path& folder, unsigned connections) {
  const testing::TestAuthority authority(folder, "idle");
  const TlsServerFiles files = authority.issue({});
  const std::string most = std::to_string(connections + 200);
  const std::vector<std::string> limits{"--max-connections", most, "--max-connections-per-address", most};
  for (const bool is_encrypted : {false, true}) {
    std::vector<std::string> options = limits;
    Destination to{{"127.0.0.1", 0}, {}};
    if (is_encrypted) {
      options.insert(options.end(), {"--cert", files.certificate.string(), "--key", files.key.string()});
      to.ca = authority.certificate();
    }
    const Peer fresh = start_selvage(server, folder, options);
    to.address.port = fresh.port;
    const IdleCost cost = hold_idle(*fresh.process, to, is_encrypted ? connections / 10 : connections);
    std::printf("idle%s: %u connections held, %u answered a ping, %.0f bytes of the server's memory each\n",
                is_encrypted ? ", TLS 1.3" : "", cost.connections, cost.answered, cost.bytes_each);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Server CPU a part, idle connections, pings under load.", "serve_bench");
  std::string server = "build/release/bin/selvage-server", congestion_control = "cubic";
  unsigned rounds = 5, idle = 10'000;
  int only = -1;
  double seconds = 1.5;
  app.add_option("--server", server, "selvage-server to measure")->capture_default_str();
  app.add_option("--rounds", rounds, "of each comparison; medians are reported")->capture_default_str();
  app.add_option("--seconds", seconds, "of each measurement")->capture_default_str();
  app.add_option("--idle", idle, "connections to hold; 0 leaves that out")->capture_default_str();
  app.add_option("--only", only, "one of the comparisons, counted from 0")->capture_default_str();
  app.add_option("--cc", congestion_control, "congestion control; bbr paces every packet by a timer")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  enter_private_network();
  use_congestion_control(congestion_control);

  const std::vector<Work> works = {{"p4", 4 << 10, 4096, 64, 8},   {"p16", 16 << 10, 2048, 64, 8},
                                   {"p64", 64 << 10, 1024, 1, 16}, {"p64", 64 << 10, 1024, 1, 256},
                                   {"p1m", 1 << 20, 64, 1, 16},    {"p1m", 1 << 20, 64, 1, 256}};
  BenchFolder folder;
  std::map<std::string, std::shared_ptr<const Pack>> packs;
  for (const Work& work : works) {
    if (!packs.contains(work.model))
      packs[work.model] = folder.add_pack(work.model, work.regions, work.part_size);
  }
  const Peer nginx = start_nginx(folder.path());
  {
    const Peer selvage = start_selvage(server, folder.path());
    std::printf("loopback, %s\n", congestion_control.c_str());
    std::printf("%7s %6s %6s %10s %10s %7s %11s %11s %9s %9s %7s\n", "part", "batch", "conns", "cpu us",
                "nginx us", "ratio", "parts/s", "nginx", "p99 ms", "nginx", "ratio");
    for (const Work& work : works) {
      if (only < 0 || &work == &works[only])
        compare(selvage, nginx, *packs[work.model], work, rounds, seconds);
    }
    if (only >= 0) return 0;

    for (unsigned others : {0u, 4u}) {
      const PingTimes pings = ping_under_bulk(selvage, "p1m", others, 4 * seconds);
      std::printf(
          "ping while saturated, %u others: %zu pings, median %.2f ms, p99 %.2f ms, worst %.2f ms, "
          "beside %.0f MB/s\n",
          others, pings.pings, pings.median * 1e3, pings.p99 * 1e3, pings.worst * 1e3,
          pings.bulk_bytes_per_second / 1e6);
    }
  }
  if (idle == 0) return 0;
  hold_idle(server, folder.path(), idle);
  return 0;
} catch (const std::exception& exception) {
  std::fprintf(stderr, "serve_bench: %s\n", exception.what());
  return 1;
}
