// SPDX-License-Identifier: MIT
//
// What a slow link makes of the server: how long a first region takes and a part of a model, what a cancel
// still costs, how late pings are. The link is emulated between two networks of the benchmark's own
// (slow_link.h).
//
//     apt-get install nginx-light iproute2
//     build/bench/bin/slow_link_bench --server build/bench/bin/selvage-server --mesh head.ply
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <optional>

#include <CLI/CLI.hpp>

#include "bench/codec/rivals.h"
#include "bench/serve/first_regions.h"
#include "bench/serve/peers.h"
#include "bench/serve/slow_link.h"
#include "bench/serve/steering.h"
#include "common/mesh_io/read_mesh.h"
#include "server/ingest/ingest.h"
#include "tests/support/certificates.h"

namespace {

using namespace selvage;
using namespace selvage::bench;

struct Options {
  std::string server = "build/bench/bin/selvage-server", mesh, congestion_control = "bbr";
  double megabits = 20, draco_seconds = 10, pings_for = 10;
  unsigned round_trip_ms = 50, queue_ms = 100, rounds = 9, fetches = 15;
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

std::vector<double> repeat(unsigned times, const std::function<double()>& measure) {
  std::vector<double> values;
  for (unsigned i = 0; i < times; ++i) values.push_back(measure());
  return values;
}

LinkShape shape_of(const Options& options, double bits_per_second) {
  LinkShape shape;
  shape.bits_per_second = bits_per_second;
  shape.round_trip = std::chrono::milliseconds(options.round_trip_ms);
  shape.queue = std::chrono::milliseconds(options.queue_ms);
  shape.congestion_control = options.congestion_control;
  return shape;
}

void introduce(const SlowLink& link) {
  std::printf("\nlink of %.2f Mbit/s, round trip %lld ms, queue %lld ms, %s\n",
              link.shape().bits_per_second / 1e6, static_cast<long long>(link.shape().round_trip.count()),
              static_cast<long long>(link.shape().queue.count()), link.shape().congestion_control.c_str());
}

/// Steering, on one link.
void steer(const Options& options, const BenchFolder& folder, double bits_per_second) {
  const SlowLink link(shape_of(options, bits_per_second));
  introduce(link);
  const std::string address = SlowLink::kServerAddress;
  const testing::TestAuthority authority(folder.path(), "slow");
  const TlsServerFiles files = authority.issue({.names = "IP:" + address});
  const Peer plain = start_selvage(options.server, folder.path(), {"--allow-plain"}, address);
  const Peer tls =
      start_selvage(options.server, folder.path(),
                    {"--cert", files.certificate.string(), "--key", files.key.string()}, address);
  link.enter_clients_side();
  const Destination to_plain{{address, plain.port}, {}};
  const Destination to_tls{{address, tls.port}, authority.certificate()};
  const double round_trip = std::chrono::duration<double>(link.shape().round_trip).count();
  for (const auto& [to, name] : {std::pair(to_plain, "plain"), std::pair(to_tls, "TLS 1.3")}) {
    const double first = median(repeat(options.rounds, [&] { return first_region_seconds(to, "p4"); }));
    std::printf("%-8s a first region of 4 KiB is there %.2f round trips after the connection\n", name,
                first / round_trip);

    std::vector<double> beyond, seconds;
    for (unsigned i = 0; i < options.rounds; ++i) {
      const CancelCost cost = cancel_cost(to, "p1m", 2 + 0.013 * i);
      beyond.push_back((static_cast<double>(cost.bytes) - link.bytes_per_round_trip()) / 1024);
      seconds.push_back(cost.seconds / round_trip);
    }
    std::printf(
        "%-8s cancel answered after %.2f round trips; beyond one round trip's worth came %.0f KiB "
        "(median; at most %.0f)\n",
        name, median(seconds), median(beyond), std::ranges::max(beyond));

    const LinkPings pings = pings_beside_bulk(to, "p1m", options.pings_for);
    const auto quantile = [&](double share) {
      const auto at = static_cast<std::size_t>(share * static_cast<double>(pings.seconds.size() - 1));
      return pings.seconds.at(at) * 1e3;
    };
    std::printf("%-8s %zu pings beside %.1f Mbit/s: median %.0f ms, p99 %.0f ms, worst %.0f ms\n", name,
                pings.seconds.size(), pings.bytes_per_second * 8e-6, quantile(0.5), quantile(0.99),
                quantile(1));
    std::fflush(stdout);
  }
}

struct PreparedModel {
  std::shared_ptr<const Pack> pack;
  std::size_t draco_bytes = 0;
};

/// NAME.selvage with the defaults of selvage-pack, and NAME.drc: Draco's smallest on the same grid.
PreparedModel prepare(const std::string& mesh, const std::filesystem::path& folder) {
  const auto file = read_mesh(mesh);
  if (!file) throw std::runtime_error(file.error().message);
  const auto done =
      ingest(file->soup, IngestOptions(), threaded_for(0), [](const auto&, double) { return true; });
  if (!done) throw std::runtime_error(done.error().message);
  std::ofstream(folder / "mesh.selvage", std::ios::binary)
      .write(reinterpret_cast<const char*>(done->pack.data()),
             static_cast<std::streamsize>(done->pack.size()));
  PreparedModel model{Pack::open(folder / "mesh.selvage").value()};
  const Grid& grid = model.pack->directory().grid;
  GridMesh rival;
  for (const Vec3& p : file->soup.positions) rival.positions.push_back(grid.quantise(p));
  rival.triangles = file->soup.triangles;
  const std::vector<char> draco = draco_encode(rival, 10, grid.bits);
  std::ofstream(folder / "mesh.drc", std::ios::binary)
      .write(draco.data(), static_cast<std::streamsize>(draco.size()));
  model.draco_bytes = draco.size();
  return model;
}

/// What of a model is there early, on a link that takes long for all of it.
void fetch_parts_of(const Options& options, const BenchFolder& folder) {
  const PreparedModel model = prepare(options.mesh, folder.path());
  const Directory& directory = model.pack->directory();
  const SlowLink link(shape_of(options, static_cast<double>(model.draco_bytes) * 8 / options.draco_seconds));
  introduce(link);
  const std::string address = SlowLink::kServerAddress;
  const Peer selvage = start_selvage(options.server, folder.path(), {"--allow-plain"}, address);
  const Peer nginx = start_nginx(folder.path(), address);
  link.enter_clients_side();
  const HostPort web{address, nginx.port};
  const std::string source = address + ":" + std::to_string(selvage.port) + "/mesh";
  std::printf("%u triangles in %u regions: a pack of %zu bytes, Draco's file of %zu\n", directory.triangles,
              directory.real_region_count(), model.pack->bytes().size(), model.draco_bytes);
  const double whole = median(repeat(3, [&] { return download_seconds(web, "mesh.drc"); }));
  std::printf("all of Draco's file from nginx: %.2f s\n", whole);
  std::mt19937 random(1);
  const auto report = [&](const char* what, const std::function<std::vector<RegionId>()>& choose) {
    const auto times = repeat(options.fetches, [&] { return fetch_seconds(source, choose()); });
    std::printf("%s: median %.2f s, worst %.2f s: %.1f and %.1f %% of it\n", what, median(times),
                std::ranges::max(times), 100 * median(times) / whole, 100 * std::ranges::max(times) / whole);
    std::fflush(stdout);
  };
  report("a random region", [&] { return std::vector<RegionId>(1, random_region(directory, random)); });
  report("a tenth of the triangles around one, stitched",
         [&] { return random_patch(folder.path() / "mesh.selvage", directory, 0.1, random); });
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Steering and first regions on a slow link.", "slow_link_bench");
  Options options;
  app.add_option("--server", options.server, "selvage-server to measure")->capture_default_str();
  app.add_option("--mesh", options.mesh,
                 "a large mesh, for the comparison with Draco; without it that is left out");
  app.add_option("--mbit", options.megabits, "rate of the link for steering")->capture_default_str();
  app.add_option("--rtt", options.round_trip_ms, "round trip, ms")->capture_default_str();
  app.add_option("--queue", options.queue_ms, "what the bottleneck holds at most, ms")->capture_default_str();
  app.add_option("--cc", options.congestion_control, "congestion control")->capture_default_str();
  app.add_option("--draco-seconds", options.draco_seconds, "that the other link takes for Draco's file")
      ->capture_default_str();
  app.add_option("--rounds", options.rounds, "of each measurement of steering")->capture_default_str();
  app.add_option("--fetches", options.fetches, "of each kind")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  BenchFolder folder;
  folder.add_pack("p4", 2048, 4 << 10);
  folder.add_pack("p1m", 128, 1 << 20);
  steer(options, folder, options.megabits * 1e6);
  if (!options.mesh.empty()) fetch_parts_of(options, folder);
  return 0;
} catch (const std::exception& exception) {
  std::fprintf(stderr, "slow_link_bench: %s\n", exception.what());
  return 1;
}
