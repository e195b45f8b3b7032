// SPDX-License-Identifier: MIT
#include "bench/codec/stages.h"

#include <cstdio>
#include <cstdlib>

#include "bench/codec/joins.h"
#include "client/decode/bundle_decoder.h"
#include "client/decode/connectivity_decoder.h"
#include "client/decode/region_decoder.h"
#include "common/coding/entropy_decoder.h"
#include "common/pack/pack.h"
#include "server/encode/connectivity_encoder.h"
#include "server/encode/region_encoder.h"

namespace selvage::bench {
namespace {

template <class Work>
double seconds_of(Work work) {
  const double begin = thread_seconds();
  if (!work()) {
    std::fprintf(stderr, "a part does not decode\n");
    std::exit(1);
  }
  return thread_seconds() - begin;
}

bool decode_only_connectivity(std::span<const std::byte> part, std::uint32_t triangles,
                              const CodecTables& tables) {
  EntropyDecoder in(part.subspan(1), tables.region);
  FanTable table;
  return triangles == 0 || decode_connectivity(in, triangles, table).has_value();
}

void add_region(const Pack& pack, const RegionEntry& entry, const CodecTables& tables, DecodeStages& stages) {
  if (entry.levels.empty()) return;
  const LevelEntry& level = entry.levels[0];
  const auto part = pack.part(level.part);
  stages.connectivity += seconds_of([&] { return decode_only_connectivity(part, level.triangles, tables); });
  const DecodeLimits limits{level.vertices, level.triangles, entry.box_min, entry.box_max};
  stages.regions += seconds_of([&] { return decode_region(part, limits, tables).has_value(); });
}

void add_bundle(const Pack& pack, RegionId region, const CodecTables& tables, DecodeStages& stages) {
  const auto& entries = pack.directory().regions;
  const RegionEntry& entry = entries[region];
  if (entry.bundle.size == 0) return;
  stages.joins += seconds_of([&] {
    std::vector<BundleTopology::Region> loops;
    for (const RegionId lower : entry.lower_neighbours) loops.push_back({lower, entries[lower].loop_lengths});
    loops.push_back({region, entry.loop_lengths});
    const BundleTopology topology(std::move(loops));
    return decode_bundle(pack.part(entry.bundle), topology, entry.bundle_triangles, tables).has_value();
  });
}

}  // namespace

DecodeStages decode_stages(const Bytes& bytes, const CodecTables& tables) {
  DecodeStages stages;
  std::shared_ptr<const Pack> pack;
  stages.directory = seconds_of([&] {
    auto read = Pack::from_bytes(bytes);
    if (read) pack = *read;
    return read.has_value();
  });
  const auto& entries = pack->directory().regions;
  for (RegionId region = 0; region < entries.size(); ++region) {
    add_region(*pack, entries[region], tables, stages);
    add_bundle(*pack, region, tables, stages);
  }
  return stages;
}

EncodeStages encode_stages(const CornerTable& table, std::span<const GridPoint> positions,
                           const CodecTables& tables) {
  EncodeStages stages;
  stages.connectivity = seconds_of([&] {
    EntropyEncoder out;
    (void)encode_connectivity(table, out);
    return true;
  });
  const RegionSource source{table, {positions.begin(), positions.end()}, {}, {}};
  stages.all = seconds_of([&] { return !encode_region(source, tables).bytes.empty(); });
  return stages;
}

}  // namespace selvage::bench
