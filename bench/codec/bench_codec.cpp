// SPDX-License-Identifier: MIT
//
// How many bytes and how much time, beside Draco on the same integers:
//   cmake --preset release -DSELVAGE_BENCH=ON && cmake --build --preset release --target bench_codec
//   build/release/bin/bench_codec MODELS... --train TRAINING... --folds 4
//
// With --train no model is coded with tables that saw it: models are dealt into folds, and each fold is coded
// with tables trained on TRAINING without the models of that fold and whatever shares a family name with
// them. Without, the shipped tables are used, which may have seen the model. Times are thread CPU time, the
// median of --repeats runs in which all contenders take turns.
#include <algorithm>
#include <cstdio>
#include <cmath>
#include <functional>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "bench/codec/joins.h"
#include "bench/codec/lossless.h"
#include "bench/codec/rivals.h"
#include "bench/codec/stages.h"
#include "bench/codec/two_cores.h"
#include "bench/support/corpus.h"
#include "bench/train/trainer.h"
#include "client/decode/bundle_decoder.h"
#include "client/decode/region_decoder.h"
#include "common/pack/pack.h"
#include "server/encode/model_encoder.h"
#include "server/encode/region_encoder.h"
#include "server/segment/segment.h"

namespace selvage::bench {
namespace {

struct Options {
  std::vector<std::filesystem::path> models, training;
  std::string excluded;
  std::vector<int> bits = {11, 12, 14, 16};
  unsigned folds = 4;
  int repeats = 3;
  bool per_region = true, is_lossless = false;
};

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// Every contender once a round, so that a noisy machine is noisy for all.
std::vector<double> median_times(int repeats, const std::vector<std::function<void()>>& contenders) {
  std::vector<std::vector<double>> times(contenders.size());
  for (int round = 0; round < repeats; ++round) {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      const double begin = thread_seconds();
      contenders[i]();
      times[i].push_back(thread_seconds() - begin);
    }
  }
  std::vector<double> medians;
  for (auto& t : times) medians.push_back(median(t));
  return medians;
}

GridMesh whole_grid_mesh(const RepairedMesh& mesh, const Grid& grid) {
  GridMesh result;
  for (const Vec3& p : mesh.positions) result.positions.push_back(grid.quantise(p));
  for (TriangleId t = 0; t < mesh.table.triangle_count(); ++t)
    result.triangles.push_back(mesh.table.triangle(t));
  return result;
}

GridMesh region_grid_mesh(const RegionMesh& region) { return {region.positions, region.triangles}; }

/// Sums over models; printed as ratios at the end.
struct Totals {
  std::map<std::string, double> sum;
  void add(const std::string& what, double value) { sum[what] += value; }
  double ratio(const std::string& a, const std::string& b) const {
    return sum.contains(a) && sum.at(b) > 0 ? sum.at(a) / sum.at(b) : 0;
  }
};

/// Where symbols' bits go, by adaptive cost.
struct Costs {
  std::map<std::string, double> bits;

  static const char* class_of(PartKind kind, unsigned model) {
    if (kind == PartKind::Bundle) {
      if (model < bundle_model::kStart) return "join steps";
      if (model == bundle_model::kSlot1 || model == bundle_model::kTipGap) return "join tips";
      return "join starts";
    }
    if (model < region_model::kMagnitude) return "clers";
    if (model < region_model::kMagnitude + 2 * region_model::kMagnitudes) return "first axis";
    if (model < region_model::kMagnitude + 4 * region_model::kMagnitudes) return "second axis";
    if (model < region_model::kFields) return "normal axis";
    if (model == region_model::kExcess) return "escapes";
    if (model >= region_model::kListCount) return "value lists";
    if (model == region_model::kIsListed) return "region headers";
    return model >= region_model::kTurned ? "turned, anchors" : "region headers";
  }

  void add(const PartId& id, std::span<const Token> tokens, double plain_bits, const CodecTables& tables) {
    SymbolModels models(id.kind == PartKind::Region ? tables.region : tables.bundle);
    for (const Token& token : tokens) {
      bits[class_of(id.kind, token.model)] +=
          kProbabilityBits - std::log2(models.range(token.model, token.symbol).frequency);
      models.update(token.model, token.symbol);
    }
    bits[id.kind == PartKind::Region ? "signs, low bits" : "join indices"] += plain_bits;
    if (id.kind == PartKind::Region) bits["region flush"] += 40;
  }
};

void bench_whole(const Model& model, const Grid& grid, const CodecTables& tables, const Options& options,
                 Totals& totals, Costs& costs) {
  const GridMesh mesh = whole_grid_mesh(model.mesh, grid);
  const RegionSource source{model.mesh.table, mesh.positions, {}, {}};
  EntropyEncoder symbols;
  const EncodedRegion ours = encode_region(source, tables, &symbols);
  costs.add({PartKind::Region, 1}, symbols.tokens(), symbols.plain_bits(), tables);
  const DecodeLimits limits{source.table.vertex_count(), source.table.triangle_count(), ours.box.low,
                            ours.box.high};
  const auto cl7 = draco_encode(mesh, 7, grid.bits), cl10 = draco_encode(mesh, 10, grid.bits);
  if (const auto decoded = decode_region(ours.bytes, limits, tables); !decoded) {
    std::fprintf(stderr, "%s: %s\n", model.name.c_str(), decoded.error().message.c_str());
    std::exit(1);
  }
  const double triangles = 1e-9 * source.table.triangle_count();
  const auto times = median_times(
      options.repeats, {[&] { (void)decode_region(ours.bytes, limits, tables); }, [&] { draco_decode(cl7); },
                        [&] { draco_decode(cl10); }, [&] { (void)encode_region(source, tables); },
                        [&] { draco_encode(mesh, 10, grid.bits); }});
  const EncodeStages encode = encode_stages(source.table, source.positions, tables);
  totals.add("encode connectivity", encode.connectivity);
  totals.add("encode all", encode.all);
  const std::size_t rest = grid.bits <= 16 ? meshoptimizer_size(mesh) : 0;
  const std::string tag = std::to_string(grid.bits);
  totals.add("whole " + tag, static_cast<double>(ours.bytes.size()));
  totals.add("cl10 " + tag, static_cast<double>(cl10.size()));
  totals.add("cl7 " + tag, static_cast<double>(cl7.size()));
  totals.add("meshopt+zstd " + tag, static_cast<double>(rest));
  const char* names[] = {"decode", "decode cl7", "decode cl10", "encode", "encode cl10"};
  for (int i = 0; i < 5; ++i)
    totals.add(std::string(names[i]) + " " + tag, times[static_cast<std::size_t>(i)]);
  std::printf(
      "%-30s %2d whole   %8zu cl7 %8zu cl10 %8zu  %.3f  connectivity %.3f bpv | ns/tri decode %.0f cl7 %.0f "
      "cl10 %.0f encode %.0f cl10 %.0f\n",
      model.name.c_str(), grid.bits, ours.bytes.size(), cl7.size(), cl10.size(),
      static_cast<double>(ours.bytes.size()) / static_cast<double>(cl10.size()),
      8.0 * static_cast<double>(ours.connectivity_size) / source.table.vertex_count(), times[0] / triangles,
      times[1] / triangles, times[2] / triangles, times[3] / triangles, times[4] / triangles);
}

void bench_regions(const Model& model, const Grid& grid, const CodecTables& tables, std::uint32_t size,
                   Totals& totals) {
  const RepairedMesh& mesh = model.mesh;
  const std::string tag = std::to_string(size) + " at " + std::to_string(grid.bits);
  if (mesh.table.vertex_count() < 2 * size) return;
  const Partition partition = voronoi_partition(mesh, size);
  const ModelSource source{mesh.table, mesh.positions, mesh.source_of_vertex, mesh.is_turned, partition};
  const EncodedModel encoded = encode_model(source, grid, serial_for(), [] {}, {tables}).value();
  std::size_t ours = 0, joins = 0, draco = 0;
  auto part = encoded.parts.begin();
  for (const RegionEntry& entry : encoded.directory.regions) {
    for (const LevelEntry& level : entry.levels) {
      ours += part->size();
      const auto region =
          decode_region(*part++, {level.vertices, level.triangles, entry.box_min, entry.box_max}, tables);
      if (level.triangles > 0) draco += draco_encode(region_grid_mesh(*region), 10, grid.bits).size();
    }
    if (entry.bundle_triangles > 0) joins += (part++)->size();
  }
  const double boundary = encoded.directory.boundary_triangles;
  const double bits_each = boundary > 0 ? 8.0 * static_cast<double>(joins) / boundary : 0;
  totals.add("regions " + tag, static_cast<double>(ours));
  totals.add("cl10 regions " + tag, static_cast<double>(draco));
  totals.add("joins " + tag, 8.0 * static_cast<double>(joins));
  totals.add("boundary " + tag, boundary);
  std::size_t parts = 0;
  for (const Bytes& bytes : encoded.parts) parts += bytes.size();
  const std::size_t pack = assemble_pack(encoded.directory, encoded.parts).size();
  totals.add("pack " + tag, static_cast<double>(pack));
  totals.add("directory " + tag, static_cast<double>(pack - parts + partition.region_count));
  totals.add("cl10 for " + tag,
             static_cast<double>(draco_encode(whole_grid_mesh(mesh, grid), 10, grid.bits).size()));
  std::printf(
      "%-30s %2d %5u   %8zu          cl10 %8zu  %.3f  regions %u joins %.2f bits a boundary triangle\n",
      model.name.c_str(), grid.bits, size, ours, draco,
      static_cast<double>(ours) / static_cast<double>(draco), partition.region_count, bits_each);
}

void bench_default(const Model& model, const Grid& grid, const CodecTables& tables, Totals& totals,
                   Costs& costs) {
  const RepairedMesh& mesh = model.mesh;
  const Segmentation segmentation = segment(mesh.table, mesh.positions, {}, serial_for());
  const Partition partition =
      make_partition(mesh.table, segmentation.region_of_vertex, segmentation.region_count);
  const ModelSource source{mesh.table, mesh.positions, mesh.source_of_vertex, mesh.is_turned, partition};
  const EncodeHooks hooks{tables, [&](const PartId& id, std::span<const Token> tokens, double plain_bits) {
                            costs.add(id, tokens, plain_bits, tables);
                          }};
  EncodedModel encoded = encode_model(
                             source, grid, serial_for(), [] {}, hooks)
                             .value();
  encoded.directory.vertices = mesh.table.vertex_count();
  encoded.directory.triangles = mesh.table.triangle_count();
  std::size_t parts = 0, joins = 0;
  std::uint32_t most_boundary = 0;
  auto part = encoded.parts.begin();
  for (const RegionEntry& entry : encoded.directory.regions) {
    most_boundary = std::max(most_boundary, entry.boundary_vertices());
    for (std::size_t i = 0; i < entry.levels.size(); ++i) ++part;
    if (entry.bundle_triangles > 0) joins += (part++)->size();
  }
  for (const Bytes& bytes : encoded.parts) parts += bytes.size();
  const Bytes packed = assemble_pack(encoded.directory, encoded.parts);
  const DecodeStages stages = decode_stages(packed, tables);
  totals.add("decode directory", stages.directory);
  totals.add("decode connectivity", stages.connectivity);
  totals.add("decode positions", stages.regions - stages.connectivity);
  totals.add("decode joins", stages.joins);
  totals.add("decode all", stages.directory + stages.regions + stages.joins);
  const std::size_t pack = packed.size();
  const auto cl10 = draco_encode(whole_grid_mesh(mesh, grid), 10, grid.bits).size();
  const double vertices = mesh.table.vertex_count(), boundary = encoded.directory.boundary_triangles;
  const std::string tag = std::to_string(grid.bits);
  totals.add("pack " + tag, static_cast<double>(pack));
  totals.add("directory " + tag, static_cast<double>(pack - parts + partition.region_count));
  totals.add("cl10 for pack " + tag, static_cast<double>(cl10));
  totals.add("default joins " + tag, 8.0 * static_cast<double>(joins));
  totals.add("default boundary " + tag, boundary);
  totals.add("default connectivity " + tag,
             8.0 * static_cast<double>(encoded.directory.connectivity_bytes + joins));
  totals.add("default vertices " + tag, vertices);
  const Welding welding = weld_by_position(mesh, partition, grid);
  std::printf(
      "%-30s %2d default %8zu          cl10 %8zu  %.3f  regions %u connectivity with joins %.3f bpv, joins "
      "%.2f bits a boundary "
      "triangle (Table 5.4: %.1f), directory %.1f %%; welding: %u vertices twice, %u wrong, %.1f ms\n",
      model.name.c_str(), grid.bits, pack, cl10, static_cast<double>(pack) / static_cast<double>(cl10),
      partition.region_count,
      8.0 * static_cast<double>(encoded.directory.connectivity_bytes + joins) / vertices,
      boundary > 0 ? 8.0 * static_cast<double>(joins) / boundary : 0,
      boundary > 0
          ? 8.0 * static_cast<double>(raw_strip_bytes(mesh.table, partition, most_boundary)) / boundary
          : 0,
      100.0 * static_cast<double>(pack - parts) / static_cast<double>(pack), welding.repeated_vertices,
      welding.wrong_welds, 1e3 * welding.seconds);
}

/// In default segmentation, at 12 bits.
void bench_two_cores(const Model& model, const Options& options, Totals& totals) {
  const RepairedMesh& mesh = model.mesh;
  const Segmentation segmentation = segment(mesh.table, mesh.positions, {}, serial_for());
  const Partition partition =
      make_partition(mesh.table, segmentation.region_of_vertex, segmentation.region_count);
  const DecodingTimes times =
      decode_on_two_cores(mesh, partition, make_grid(mesh.positions, 12), 3 * options.repeats);
  totals.add("decode on one core", times.one_core);
  totals.add("decode on two cores", times.two_cores);
  std::printf(
      "%-30s 12 decode and stitch %u regions: one core %.2f ms, two %.2f ms, %.2f times as fast; by the "
      "clock %.2f and %.2f ms, %.2f times\n",
      model.name.c_str(), partition.region_count, 1e3 * times.one_core, 1e3 * times.two_cores,
      times.one_core / times.two_cores, 1e3 * times.one_thread_wall, 1e3 * times.two_threads_wall,
      times.one_thread_wall / times.two_threads_wall);
}

void bench_lossless(const Model& model, const CodecTables& tables, Totals& totals) {
  const LosslessSizes sizes = lossless_sizes(model, tables);
  const auto ours = static_cast<double>(sizes.ours), xz = static_cast<double>(sizes.xz),
             zstd = static_cast<double>(sizes.zstd);
  totals.add("lossless", ours);
  totals.add("xz", xz);
  totals.add("zstd", zstd);
  std::printf("%-30s lossless positions %8zu  xz -9 %8zu  %.3f  zstd -19 %8zu  %.3f\n", model.name.c_str(),
              sizes.ours, sizes.xz, ours / xz, sizes.zstd, ours / zstd);
}

void bench_model(const Model& model, const CodecTables& tables, const Options& options, Totals& totals,
                 Costs& whole, Costs& segmented) {
  if (options.is_lossless) return bench_lossless(model, tables, totals);
  for (int bits : options.bits) {
    const Grid grid = make_grid(model.mesh.positions, bits);
    bench_whole(model, grid, tables, options, totals, whole);
    if (options.per_region) {
      for (std::uint32_t size : {2000u, 500u}) bench_regions(model, grid, tables, size, totals);
    }
    bench_default(model, grid, tables, totals, segmented);
  }
  bench_two_cores(model, options, totals);
}

/// Names that mean the same shape in different files.
std::string family_pattern(const std::string& name) {
  static const std::vector<std::pair<std::string, std::string>> families = {{"bunny", "bunny|bun_zipper"},
                                                                            {"armadillo", "armadillo"},
                                                                            {"horse", "horse|fourleg"},
                                                                            {"cow", "cow|fourleg"},
                                                                            {"hand", "hand"},
                                                                            {"igea", "igea|bust"},
                                                                            {"dragon", "dragon"},
                                                                            {"teapot", "teapot|cup"},
                                                                            {"rockerarm", "rocker"},
                                                                            {"skull", "skull"},
                                                                            {"lucy", "lucy"},
                                                                            {"brain", "brain|colin"}};
  for (const auto& [part, pattern] : families) {
    if (name.find(part) != std::string::npos) return pattern;
  }
  return std::filesystem::path(name).stem().string();
}

int run(const Options& options) {
  const std::vector<Model> models = read_models(options.models, options.excluded);
  const std::vector<Model> training =
      options.training.empty() ? std::vector<Model>{} : read_models(options.training, "");
  Totals totals;
  Costs whole, segmented;
  const unsigned folds = training.empty() ? 1 : options.folds;
  for (unsigned fold = 0; fold < folds; ++fold) {
    std::string left_out = "^$";
    for (std::size_t i = fold; i < models.size(); i += folds)
      left_out += "|" + family_pattern(models[i].name);
    TrainedTables trained;
    if (!training.empty()) {
      std::vector<const Model*> seen;
      for (const Model& model : training) {
        if (!std::regex_search(model.name, std::regex(left_out))) seen.push_back(&model);
      }
      trained = train(seen);
    }
    const CodecTables tables = training.empty() ? shipped_tables() : trained.view();
    for (std::size_t i = fold; i < models.size(); i += folds)
      bench_model(models[i], tables, options, totals, whole, segmented);
  }

  std::printf("\nsums over %zu models%s\n", models.size(),
              training.empty() ? ", shipped tables" : ", tables trained without them");
  if (options.is_lossless) {
    std::printf("lossless positions: %.3f of xz -9, %.3f of zstd -19\n", totals.ratio("lossless", "xz"),
                totals.ratio("lossless", "zstd"));
    return 0;
  }
  for (int bits : options.bits) {
    const std::string tag = std::to_string(bits);
    std::printf(
        "%2d bits: whole/cl10 %.3f whole/cl7 %.3f meshopt+zstd/cl10 %.3f pack/cl10 %.3f directory %.2f %% "
        "joins %.3f bits a boundary triangle, connectivity with joins %.3f bpv\n",
        bits, totals.ratio("whole " + tag, "cl10 " + tag), totals.ratio("whole " + tag, "cl7 " + tag),
        totals.ratio("meshopt+zstd " + tag, "cl10 " + tag),
        totals.ratio("pack " + tag, "cl10 for pack " + tag),
        100 * totals.ratio("directory " + tag, "pack " + tag),
        totals.ratio("default joins " + tag, "default boundary " + tag),
        totals.ratio("default connectivity " + tag, "default vertices " + tag));
    for (const char* size : {"2000", "500"}) {
      const std::string at = std::string(size) + " at " + tag;
      if (!totals.sum.contains("regions " + at)) continue;
      std::printf(
          "         regions of %s: /cl10 one by one %.3f, pack with joins and directory / cl10 whole %.3f, "
          "directory %.2f %%, joins %.3f bits a boundary triangle\n",
          size, totals.ratio("regions " + at, "cl10 regions " + at),
          totals.ratio("pack " + at, "cl10 for " + at), 100 * totals.ratio("directory " + at, "pack " + at),
          totals.ratio("joins " + at, "boundary " + at));
    }
    std::printf("         decode: %.2f x cl10, %.2f x cl7; encode %.2f x cl10\n",
                totals.ratio("decode cl10 " + tag, "decode " + tag),
                totals.ratio("decode cl7 " + tag, "decode " + tag),
                totals.ratio("encode cl10 " + tag, "encode " + tag));
  }
  std::printf("decoding and stitching on two cores: %.2f times as fast as on one\n",
              totals.ratio("decode on one core", "decode on two cores"));
  std::printf("time to decode packs in default segmentation:");
  for (const char* stage : {"directory", "connectivity", "positions", "joins"})
    std::printf("  %s %.1f %%", stage, 100 * totals.ratio(std::string("decode ") + stage, "decode all"));
  std::printf("\ntime to encode whole meshes:  connectivity %.1f %%\n",
              100 * totals.ratio("encode connectivity", "encode all"));
  for (const auto& [name, costs] :
       {std::pair{"whole", &whole}, std::pair{"default segmentation", &segmented}}) {
    double all = 0;
    for (const auto& [what, bits] : costs->bits) all += bits;
    std::printf("bits by purpose, %s:", name);
    for (const auto& [what, bits] : costs->bits) std::printf("  %s %.2f %%", what.c_str(), 100 * bits / all);
    std::printf("\n");
  }
  return 0;
}

}  // namespace
}  // namespace selvage::bench

int main(int argc, char** argv) {
  selvage::bench::Options options;
  CLI::App app{"Compares the codec with Draco and meshoptimizer"};
  app.add_option("models", options.models, "folders or files")->required();
  app.add_option("--train", options.training, "folders to train tables on");
  app.add_option("--folds", options.folds, "into how many groups the models are dealt for training");
  app.add_option("--exclude", options.excluded, "regular expression of models to leave out");
  app.add_option("--bits", options.bits, "grid bits");
  app.add_option("--repeats", options.repeats, "runs a time is the median of");
  app.add_flag("!--no-regions", options.per_region, "skip the regions of 2000 and 500 vertices");
  app.add_flag("--lossless", options.is_lossless,
               "positions bit for bit, against xz and zstd, and nothing else");
  CLI11_PARSE(app, argc, argv);
  return selvage::bench::run(options);
}
