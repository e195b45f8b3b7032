// SPDX-License-Identifier: MIT
//
// Do levels that build on one another take fewer bytes than levels that stand alone, and how long do they
// take to decode?
//
//   layered_bench MODEL MODEL...          40 regions, levels of 50, 25, 12.5 and 6.25 % of the triangles
//   layered_bench --regions 20 MODEL MODEL...
//
// On grids of 12 and 14 bits, with tables trained on the other models of the command line.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
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

struct Sum {
  double closed = 0, open = 0, rank = 0, run = 0, position = 0, plain = 0, low_bits = 0;
  double splits = 0, asks = 0;
};

void add_bits(const EntropyEncoder& coded, const RefinementTables& tables, Sum& sum) {
  using namespace refinement_model;
  SymbolModels models(tables.models);
  for (const Token& token : coded.tokens()) {
    const double cost = kProbabilityBits - std::log2(models.range(token.model, token.symbol).frequency);
    models.update(token.model, token.symbol);
    (token.model < kClosed      ? sum.position
     : token.model < kOpen      ? sum.closed
     : token.model < kRank      ? sum.open
     : token.model < kBoundaryRun ? sum.rank
                                  : sum.run) += cost;
    sum.asks += token.model >= kClosed && token.model < kOpenSpan;
  }
  sum.plain += coded.plain_bits();
}

void measure(const Subject& subject, const RefinementTables& tables) {
  const LayeredModel& model = subject.model;
  std::size_t alone = 0, layered = 0, base = 0;
  std::vector<std::vector<Bytes>> parts;
  Sum sum;
  for (const LayeredRegion& region : model.regions) {
    std::vector<EntropyEncoder> symbols;
    parts.push_back(encode_layers(region, tables, nullptr, &symbols));
    for (const EntropyEncoder& coded : symbols) add_bits(coded, tables, sum);
    for (const Layer& layer : region.layers) sum.splits += static_cast<double>(layer.splits.size());
    for (std::size_t level = 0; level + 1 < kLevels; ++level)
      sum.low_bits += 3.0 * (region.sizes[level + 1].dropped_bits - region.sizes[level].dropped_bits) * region.sizes[level + 1].vertices;
    for (const Bytes& part : region.alone) alone += part.size();
    for (const Bytes& part : parts.back()) layered += part.size() + !part.empty();
    base += region.base.size();
  }
  const double one = static_cast<double>(model.one_level_bytes), five = static_cast<double>(model.alone_bytes);
  const double now = five - static_cast<double>(alone) + static_cast<double>(layered + base);
  std::printf("%s, %d bits, %zu regions: pack over one level: alone %.3f, layered %.3f, ratio %.3f (%d levels refined)\n",
              subject.name.c_str(), subject.bits, model.regions.size(), five / one, now / one, now / five, model.refined_precisions);
  std::printf("  bits a split: closed %.2f open %.2f rank %.2f run %.2f positions %.2f + plain %.2f; low bits %.2f; asks %.2f; base part %.3f\n",
              sum.closed / sum.splits, sum.open / sum.splits, sum.rank / sum.splits, sum.run / sum.splits,
              sum.position / sum.splits, (sum.plain - sum.low_bits) / sum.splits, sum.low_bits / sum.splits, sum.asks / sum.splits, static_cast<double>(base) / one);

  // Decoding.
  RegionDecoder decoder;
  double best_finest = 1e9, best_all = 1e9, best_layered = 1e9;
  std::size_t check = 0;
  for (int round = 0; round < (std::getenv("LAYERED_ROUNDS") ? std::atoi(std::getenv("LAYERED_ROUNDS")) : 7); ++round) {
    double start = thread_cpu_ms();
    for (const LayeredRegion& region : model.regions)
      check += decoder.decode(region.alone[0], region.alone_limits[0]).value().positions.size();
    best_finest = std::min(best_finest, thread_cpu_ms() - start);
    start = thread_cpu_ms();
    for (const LayeredRegion& region : model.regions) {
      for (std::size_t level = kLevels; level-- > 0;) {
        if (!region.alone[level].empty())
          check += decoder.decode(region.alone[level], region.alone_limits[level]).value().positions.size();
      }
    }
    best_all = std::min(best_all, thread_cpu_ms() - start);
    start = thread_cpu_ms();
    for (std::size_t i = 0; i < model.regions.size(); ++i) {
      const LayeredRegion& region = model.regions[i];
      const RegionMesh base_mesh = decoder.decode(region.base, region.base_limits).value();
      GrowingRegion growing = start_growing(base_mesh, region.loop_lengths, region.sizes.back(), region.sizes.front());
      for (std::size_t level = kLevels - 1; level-- > 0;) {
        if (parts[i][level].empty()) continue;
        if (!decode_layer(parts[i][level], region.sizes[level + 1], region.sizes[level], level == 0, tables, growing))
          std::fprintf(stderr, "does not decode\n"), std::abort();
      }
      check += grown(growing, region.loop_lengths, region.sizes[0]).positions.size();
    }
    best_layered = std::min(best_layered, thread_cpu_ms() - start);
  }
  std::printf("  decode ms: finest alone %.2f, five alone %.2f, layered %.2f: %.2f, %.2f times (%zu)\n", best_finest, best_all, best_layered,
              best_layered / best_finest, best_layered / best_all, check);
  std::fflush(stdout);
}

}  // namespace
}  // namespace selvage::bench

int main(int argc, char** argv) {
  using namespace selvage::bench;
  std::uint32_t regions = 40;
  std::vector<Subject> subjects;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--regions" && i + 1 < argc) {
      regions = static_cast<std::uint32_t>(std::stoul(argv[++i]));
      continue;
    }
    const auto mesh = load_labelled(argument, regions);
    if (!mesh) return 1;
    for (const int bits : {12, 14})
      subjects.push_back({argument.substr(argument.find_last_of('/') + 1), bits, make_layered_model(*mesh, bits)});
  }
  for (const Subject& subject : subjects) {
    std::vector<const LayeredModel*> others;
    for (const Subject& other : subjects) {
      if (other.name != subject.name) others.push_back(&other.model);
    }
    if (others.empty()) others.push_back(&subject.model);
    measure(subject, train_refinement(others));
  }
  return subjects.empty() ? 2 : 0;
}
