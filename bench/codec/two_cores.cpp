// SPDX-License-Identifier: MIT
#include "bench/codec/two_cores.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

#include "bench/support/critical_path.h"
#include "client/stitch/part_collector.h"
#include "common/base/task_group.h"
#include "server/encode/model_encoder.h"

namespace selvage::bench {
namespace {

struct Part {
  PartId id;
  const Bytes* bytes;
};

std::vector<Part> parts_of(const EncodedModel& model) {
  std::vector<Part> parts;
  auto bytes = model.parts.begin();
  for (RegionId region = 0; region < model.directory.regions.size(); ++region) {
    const RegionEntry& entry = model.directory.regions[region];
    for (std::size_t level = 0; level < entry.levels.size(); ++level)
      parts.push_back({{PartKind::Region, region, static_cast<std::uint8_t>(level)}, &*bytes++});
    if (entry.bundle_triangles > 0) parts.push_back({{PartKind::Bundle, region, 0}, &*bytes++});
  }
  return parts;
}

void add(PartCollector& collector, const Part& part) {
  if (const auto ok = collector.add(part.id, *part.bytes); !ok) {
    std::fprintf(stderr, "%s\n", ok.error().message.c_str());
    std::exit(1);
  }
}

double wall_seconds(const EncodedModel& model, const std::vector<Part>& parts, unsigned threads) {
  const auto begin = std::chrono::steady_clock::now();
  PartCollector collector(model.directory);
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
  EncodedModel model = encode_model(source, grid, serial_for(), [] {});
  const std::vector<Part> parts = parts_of(model);
  std::vector<double> one, two, one_wall, two_wall;
  CriticalPath path;
  const ParallelFor parallel = path.parallel_for();
  for (int i = 0; i < repeats; ++i) {
    const double begin = thread_cpu_ms();
    PartCollector alone(model.directory);
    for (const Part& part : parts) add(alone, part);
    one.push_back(1e-3 * (thread_cpu_ms() - begin));
    two.push_back(1e-3 * path.measure([&] {
      PartCollector shared(model.directory);
      parallel(parts.size(), [&](std::size_t k) { add(shared, parts[k]); });
    }));
    one_wall.push_back(wall_seconds(model, parts, 1));
    two_wall.push_back(wall_seconds(model, parts, 2));
  }
  return {median(one), median(two), *std::min_element(one_wall.begin(), one_wall.end()),
          *std::min_element(two_wall.begin(), two_wall.end())};
}

}  // namespace selvage::bench
