// SPDX-License-Identifier: MIT
//
// Do levels that build on one another take fewer bytes than levels that stand alone, and how long do they
// take to decode?
//
//   layered_bench MODEL MODEL...                40 regions, levels of 50, 25, 12.5 and 6.25 % of the
//   triangles layered_bench --regions 20 MODEL MODEL... layered_bench --rounds 1 MODEL MODEL...     how often
//   to decode, 9 times otherwise
//
// On grids of 12 and 14 bits, with the layers' tables trained on the other models of the command line; what
// stands alone has the shipped tables. Bytes are those of packs; directory and joins are taken to be the
// same. Times are the thread's, medians: all regions at the finest level alone; at all levels alone; the
// coarsest level and then, layer by layer, up to the finest. Every layer is checked to give its level.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/simplify/layered/refinement_training.h"
#include "bench/support/critical_path.h"

namespace selvage::bench {
namespace {

struct Subject {
  std::string name;
  int bits;
  LayeredModel model;
};

/// Bits of all layers, and how often a vertex was asked.
struct LayerBits {
  double splits = 0, places = 0, boundary_runs = 0, positions = 0, low_bits = 0;
  double asked = 0;
};

void add_bits(const EntropyEncoder& coded, const RefinementTables& tables, LayerBits& sum) {
  using namespace refinement_model;
  SymbolModels models(tables.models);
  for (const Token& token : coded.tokens()) {
    const double cost = kProbabilityBits - std::log2(models.range(token.model, token.symbol).frequency);
    models.update(token.model, token.symbol);
    (token.model < kClosed        ? sum.positions
     : token.model < kRank        ? sum.splits
     : token.model < kBoundaryRun ? sum.places
     : token.model == kSpanExcess ? sum.splits
     : token.model == kRankExcess ? sum.places
                                  : sum.boundary_runs) += cost;
    sum.asked += token.model >= kClosed && token.model < kOpenSpan;
  }
  sum.positions += coded.plain_bits();
}

/// By region and level, finest first.
using LayerParts = std::vector<std::vector<Bytes>>;

LayerParts measure_bytes(const Subject& subject, const RefinementTables& tables) {
  const LayeredModel& model = subject.model;
  LayerParts parts;
  LayerBits bits;
  double alone = 0, layered = 0, splits = 0;
  for (const LayeredRegion& region : model.regions) {
    std::vector<EntropyEncoder> symbols;
    parts.push_back(encode_layers(region, tables, nullptr, &symbols));
    for (const EntropyEncoder& coded : symbols) add_bits(coded, tables, bits);
    for (std::size_t level = 0; level + 1 < kLevels; ++level) {
      const LayerSize &fine = region.sizes[level], &coarse = region.sizes[level + 1];
      bits.low_bits += 3.0 * (coarse.dropped_bits - fine.dropped_bits) * coarse.vertices;
      splits += fine.vertices - coarse.vertices;
    }
    for (const Bytes& part : region.alone) alone += static_cast<double>(part.size());
    // A byte for the version, as parts that stand alone have.
    for (const Bytes& part : parts.back()) layered += static_cast<double>(part.size() + !part.empty());
    layered += static_cast<double>(region.base.size());
  }
  const auto one = static_cast<double>(model.one_level_bytes), five = static_cast<double>(model.alone_bytes);
  const double now = five - alone + layered;
  std::printf(
      "%s, %d bits, %zu regions: five levels over one: alone %.3f, layered %.3f, which is %.3f of it\n",
      subject.name.c_str(), subject.bits, model.regions.size(), five / one, now / one, now / five);
  std::printf(
      "  bits a new vertex: splits %.2f, where %.2f, boundary %.2f, position %.2f, low bits of others %.2f; "
      "asked %.2f times\n",
      bits.splits / splits, bits.places / splits, bits.boundary_runs / splits,
      (bits.positions - bits.low_bits) / splits, bits.low_bits / splits, bits.asked / splits);
  return parts;
}

std::size_t decode_alone(RegionDecoder& decoder, const LayeredRegion& region, std::size_t level) {
  if (region.alone[level].empty()) return 0;
  return decoder.decode(region.alone[level], region.alone_limits[level]).value().positions.size();
}

std::size_t decode_layered(RegionDecoder& decoder, const LayeredRegion& region,
                           const std::vector<Bytes>& parts, const RefinementTables& tables) {
  const RegionMesh base = decoder.decode(region.base, region.base_limits).value();
  GrowingRegion growing = start_growing(base, region.loop_lengths, region.sizes.back(), region.sizes.front());
  for (std::size_t level = kLevels - 1; level-- > 0;) {
    if (!parts[level].empty())
      decode_layer(parts[level], region.sizes[level + 1], region.sizes[level], level == 0, tables, growing);
  }
  return grown(growing, region.loop_lengths, region.sizes.front()).positions.size();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void measure_time(const LayeredModel& model, const LayerParts& parts, const RefinementTables& tables,
                  int rounds) {
  RegionDecoder decoder;
  std::array<std::vector<double>, 3> ms;
  std::size_t vertices = 0;
  const auto timed = [&](std::vector<double>& times, auto work) {
    const double start = thread_cpu_ms();
    for (std::size_t i = 0; i < model.regions.size(); ++i) vertices += work(i);
    times.push_back(thread_cpu_ms() - start);
  };
  for (int round = 0; round < rounds; ++round) {
    timed(ms[0], [&](std::size_t i) { return decode_alone(decoder, model.regions[i], 0); });
    timed(ms[1], [&](std::size_t i) {
      std::size_t all = 0;
      for (std::size_t level = kLevels; level-- > 0;) all += decode_alone(decoder, model.regions[i], level);
      return all;
    });
    timed(ms[2], [&](std::size_t i) { return decode_layered(decoder, model.regions[i], parts[i], tables); });
  }
  const double finest = median(ms[0]), five = median(ms[1]), layered = median(ms[2]);
  std::printf(
      "  to decode, ms: the finest alone %.2f, five alone %.2f, layered %.2f: %.2f and %.2f times "
      "(%zu vertices)\n",
      finest, five, layered, layered / finest, layered / five, vertices);
  std::fflush(stdout);
}

}  // namespace
}  // namespace selvage::bench

int main(int argc, char** argv) {
  using namespace selvage::bench;
  std::uint32_t regions = 40;
  int rounds = 9;
  std::vector<Subject> subjects;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--regions" && i + 1 < argc) {
      regions = static_cast<std::uint32_t>(std::stoul(argv[++i]));
      continue;
    }
    if (argument == "--rounds" && i + 1 < argc) {
      rounds = std::max(1, std::stoi(argv[++i]));
      continue;
    }
    const auto mesh = load_labelled(argument, regions);
    if (!mesh) return 1;
    const std::string name = argument.substr(argument.find_last_of('/') + 1);
    for (const int bits : {12, 14}) subjects.push_back({name, bits, make_layered_model(*mesh, bits)});
  }
  for (const Subject& subject : subjects) {
    std::vector<const LayeredModel*> others;
    for (const Subject& other : subjects) {
      if (other.name != subject.name) others.push_back(&other.model);
    }
    if (others.empty()) return std::fprintf(stderr, "at least two models, to train on others\n"), 2;
    const RefinementTables tables = train_refinement(others);
    measure_time(subject.model, measure_bytes(subject, tables), tables, rounds);
  }
  return subjects.empty() ? (std::fprintf(stderr, "usage: layered_bench [--regions N] MODEL MODEL...\n"), 2)
                          : 0;
}
