// SPDX-License-Identifier: MIT
#include "bench/codec/two_cores.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <vector>

#include "bench/support/critical_path.h"
#include "client/stitch/part_collector.h"
#include "common/base/task_group.h"
#include "common/pack/pack.h"
#include "server/encode/model_encoder.h"

namespace selvage::bench {
namespace {

[[noreturn]] void give_up(const Error& error) {
  std::fprintf(stderr, "%s\n", error.message.c_str());
  std::exit(1);
}

struct Part {
  PartId id;
  std::span<const std::byte> bytes;
};

/// In the order in which they lie in the pack.
std::vector<Part> parts_of(const Pack& pack) {
  std::vector<Part> parts;
  const auto take = [&](const PartId& id, const PartRef& ref) {
    if (ref.size > 0) parts.push_back({id, pack.part(ref)});
  };
  const auto& regions = pack.directory().regions;
  for (RegionId region = 0; region < regions.size(); ++region) {
    if (!regions[region].levels.empty()) take({PartKind::Region, region, 0}, regions[region].levels[0].part);
    take({PartKind::Bundle, region, 0}, regions[region].bundle);
  }
  return parts;
}

void add(PartCollector& collector, const Part& part) {
  if (const auto ok = collector.add(part.id, part.bytes); !ok) give_up(ok.error());
}

double wall_seconds(const Directory& directory, const std::vector<Part>& parts, unsigned threads) {
  const auto begin = std::chrono::steady_clock::now();
  PartCollector collector(directory);
  TaskGroup tasks(threads);
  for (const Part& part : parts) tasks.run([&] { add(collector, part); });
  tasks.wait();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

}  // namespace

DecodingTimes decode_on_two_cores(const RepairedMesh& mesh, const Partition& partition, const Grid& grid,
                                  int repeats) {
  const ModelSource source{mesh.table, mesh.positions, mesh.source_of_vertex, mesh.is_turned, partition};
  const EncodedModel model = encode_model(source, grid, serial_for(), [] {}).value();
  const auto pack = Pack::from_bytes(assemble_pack(model.directory, model.parts));
  if (!pack) give_up(pack.error());
  const Directory& directory = (*pack)->directory();
  const std::vector<Part> parts = parts_of(**pack);
  std::vector<double> one, two, one_wall, two_wall;
  CriticalPath path;
  const ParallelFor parallel = path.parallel_for();
  for (int i = 0; i < repeats; ++i) {
    const double begin = thread_cpu_ms();
    PartCollector alone(directory);
    for (const Part& part : parts) add(alone, part);
    one.push_back(1e-3 * (thread_cpu_ms() - begin));
    two.push_back(1e-3 * path.measure([&] {
      PartCollector shared(directory);
      parallel(parts.size(), [&](std::size_t k) { add(shared, parts[k]); });
    }));
    one_wall.push_back(wall_seconds(directory, parts, 1));
    two_wall.push_back(wall_seconds(directory, parts, 2));
  }
  return {median(one), median(two), *std::min_element(one_wall.begin(), one_wall.end()),
          *std::min_element(two_wall.begin(), two_wall.end())};
}

}  // namespace selvage::bench
