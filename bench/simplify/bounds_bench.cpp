// SPDX-License-Identifier: MIT
//
// Is a mix of levels as near to the model as its pack promises?
//
//   bounds_bench MODEL...               20 random mixes of each, of five levels that halve the triangles
//   bounds_bench --mixes 50 MODEL...
//
// Each model is packed with default options, and every mix stitched as a client does. A fifth of the mixes
// has one coarse region among fine ones, a fifth the finest and the coarsest level only, a fifth levels of
// neighbours that would be chosen for an error; the rest any. Printed is the two-sided Hausdorff distance to
// the file's own surface, from samples, over the largest of the errors stated for the chosen levels. Above 1
// a promise is broken.
#include <algorithm>
#include <cstdio>
#include <optional>
#include <random>
#include <string>

#include "bench/simplify/metro.h"
#include "client/stitch/part_collector.h"
#include "common/base/parallel.h"
#include "common/mesh_io/read_mesh.h"
#include "common/pack/level_choice.h"
#include "common/pack/pack.h"
#include "server/ingest/ingest.h"

namespace selvage::bench {
namespace {

constexpr std::uint32_t kLevels = 5;

/// A level for every region, by the kinds of mixes that the first comment lists.
Selection random_mix(const Directory& directory, int round, std::mt19937& random) {
  const RegionId regions = directory.real_region_count();
  Selection mix{.kind = Selection::Kind::All, .joins = Joins::All};
  if (round % 5 == 2) {
    double least = 0, largest = 0;
    for (RegionId region = 1; region <= regions; ++region) {
      least = std::max(least, level_error(directory, region, 0));
      largest = std::max(largest, level_error(directory, region, directory.level_count() - 1));
    }
    const double share = static_cast<double>(random() % 100) / 100;
    return choose_by_error(directory, mix, least + (largest - least) * share).value();
  }
  const RegionId lonely = 1 + static_cast<RegionId>(random() % regions);
  for (RegionId region = 1; region <= regions; ++region) {
    std::uint32_t level = random() % directory.level_count();
    if (round % 5 == 0) level = region == lonely ? std::max(level, 1u) : 0;
    if (round % 5 == 1) level = level % 2 * (directory.level_count() - 1);
    mix.levels.push_back({region, static_cast<std::uint8_t>(level)});
  }
  return mix;
}

std::optional<TriangleSoup> stitched(const Pack& pack, const Selection& mix) {
  PartCollector collector(pack.directory());
  const auto parts = select_parts(pack.directory(), mix);
  if (!parts) return std::nullopt;
  for (const PartId& id : *parts) {
    if (!collector.add(id, pack.part(*pack.directory().find(id)))) return std::nullopt;
  }
  return collector.mesh().soup;
}

double promised(const Directory& directory, const Selection& mix) {
  double largest = 0;
  for (RegionId region = 1; region <= directory.real_region_count(); ++region) {
    const auto at = std::find_if(mix.levels.begin(), mix.levels.end(),
                                 [&](const auto& choice) { return choice.what == region; });
    largest = std::max(largest, level_error(directory, region, at == mix.levels.end() ? 0 : at->level));
  }
  return largest;
}

bool measure(const std::string& path, int mixes) {
  const auto file = read_mesh(path);
  if (!file) return std::fprintf(stderr, "%s\n", file.error().to_string().c_str()), false;
  IngestOptions options;
  options.levels = usual_levels(kLevels);
  auto model = ingest(file->soup, options, serial_for(), [](const std::string&, double) { return true; });
  if (!model) return std::fprintf(stderr, "%s\n", model.error().to_string().c_str()), false;
  const auto pack = Pack::from_bytes(std::move(model->pack)).value();
  std::mt19937 random(1);
  double least = 1e300, sum = 0, most = 0;
  for (int round = 0; round < mixes; ++round) {
    const Selection mix = random_mix(pack->directory(), round, random);
    const auto soup = stitched(*pack, mix);
    if (!soup) return std::fprintf(stderr, "%s: a mix cannot be stitched\n", path.c_str()), false;
    const double share = surface_distance(file->soup, *soup).largest / promised(pack->directory(), mix);
    least = std::min(least, share), sum += share, most = std::max(most, share);
  }
  std::printf("%-28s %4u regions, %d mixes: distance over promise %.3f to %.3f, mean %.3f\n",
              path.substr(path.find_last_of('/') + 1).c_str(), pack->directory().real_region_count(), mixes,
              least, most, sum / mixes);
  std::fflush(stdout);
  return most <= 1;
}

}  // namespace
}  // namespace selvage::bench

int main(int argc, char** argv) {
  int mixes = 20, models = 0;
  bool is_kept = true;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--mixes" && i + 1 < argc) {
      mixes = std::stoi(argv[++i]);
      continue;
    }
    is_kept = selvage::bench::measure(argv[i], mixes) && is_kept;
    ++models;
  }
  if (models == 0) return std::fprintf(stderr, "usage: bounds_bench [--mixes N] MODEL...\n"), 2;
  return is_kept ? 0 : 1;
}
