// SPDX-License-Identifier: MIT
#include "bench/train/trainer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "bench/train/least_squares.h"
#include "bench/train/model_fit.h"
#include "client/decode/connectivity_decoder.h"
#include "client/decode/region_decoder.h"
#include "common/codec/geometry_walk.h"
#include "common/codec/region_format.h"
#include "server/encode/attribute_encoder.h"
#include "server/encode/model_encoder.h"

namespace selvage::bench {
namespace {

using Sequence = std::vector<Token>;

/// A region as the decoder sees it, and what is taken as the shipped tables had it coded.
struct TrainingRegion {
  RegionMesh mesh;
  FanTable table;
  std::vector<GridPoint> positions;  ///< by vertex of `table`
  GridBox box;
  Sequence symbols;
};

struct TrainingSet {
  std::vector<TrainingRegion> regions;
  std::vector<Sequence> exact;  ///< of the same regions in bit-exact models, what others lack
  std::vector<Sequence> bundles;
};

bool is_of_lists(const Token& token) { return token.model >= region_model::kIsListed; }

/// Connectivity, and lists of values where they were the shorter way.
bool is_taken_as_coded(const Token& token) {
  return token.model < region_model::kMagnitude ||
         (token.model >= region_model::kExtraSymbols && token.model <= region_model::kIsClosed) ||
         is_of_lists(token);
}

bool is_of_floats(const Token& token) {
  return is_of_lists(token) ||
         (token.model >= region_model::kDigits && token.model <= region_model::kAfterExact);
}

/// By way of memory: g++ 12 loses the rounding of neighbouring values when it vectorises.
double as_float(double value) {
  volatile float rounded = static_cast<float>(value);
  return rounded;
}

/// The symbols of one partition's floats, region by region.
void add_exact_parts(const RepairedMesh& mesh, const Partition& partition, TrainingSet& set) {
  std::vector<Vec3> positions = mesh.positions;
  for (Vec3& p : positions) p = {as_float(p.x), as_float(p.y), as_float(p.z)};
  const ModelSource source{mesh.table, positions, mesh.source_of_vertex, mesh.is_turned, partition, true};
  const EncodeHooks hooks{shipped_tables(), [&](const PartId& id, std::span<const Token> tokens, double) {
                            if (id.kind == PartKind::Bundle) return;
                            set.exact.emplace_back();
                            std::copy_if(tokens.begin(), tokens.end(), std::back_inserter(set.exact.back()),
                                         is_of_floats);
                          }};
  (void)encode_model(
      source, make_grid(positions, 14), serial_for(), [] {}, hooks);
}

/// What vertices of `table` are in the mesh that it became.
std::vector<GridPoint> positions_in(const FanTable& table, const RegionMesh& mesh) {
  std::vector<GridPoint> positions(table.vertex_count());
  FanWalk::Memory memory;
  FanWalk walk(table, table.vertex_count(), memory);
  for (Fan fan; walk.turn();) {
    walk.offer();
    walk.gather(fan);
    positions[fan.old_number] = mesh.positions[walk.count() - 1];
  }
  return positions;
}

TrainingRegion training_region(std::span<const std::byte> part, const DecodeLimits& limits,
                               const CodecTables& tables, Sequence symbols) {
  auto mesh = decode_region(part, limits, tables);
  if (!mesh) {
    std::fprintf(stderr, "%s\n", mesh.error().message.c_str());
    std::abort();
  }
  TrainingRegion region{std::move(*mesh), {}, {}, {limits.box_min, limits.box_max}, std::move(symbols)};
  if (limits.triangles > 0) {
    EntropyDecoder in(part.subspan(1), tables.region);
    (void)decode_connectivity(in, limits.triangles, region.table);
    region.positions = positions_in(region.table, region.mesh);
  }
  return region;
}

/// Every model at two of the four usual numbers of bits and three of five sizes of region, in turn, and in
/// one of them bit for bit.
TrainingSet make_training_set(const std::vector<const Model*>& models) {
  constexpr int kBits[] = {12, 14, 11, 16};
  constexpr std::uint32_t kSizes[] = {2000, 500, 5000, 1000, 20000};
  TrainingSet set;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const RepairedMesh& mesh = models[i]->mesh;
    for (std::size_t k = 0; k < 3; ++k) {
      const Partition partition = voronoi_partition(mesh, kSizes[(i + k) % 5]);
      const Grid grid = make_grid(mesh.positions, kBits[(i + k) % 4]);
      const ModelSource source{mesh.table, mesh.positions, mesh.source_of_vertex, mesh.is_turned, partition};
      if (k == 0) add_exact_parts(mesh, partition, set);
      std::vector<Sequence> symbols(partition.region_count + 1);
      const CodecTables& tables = shipped_tables();
      const EncodeHooks hooks{tables, [&](const PartId& id, std::span<const Token> tokens, double) {
                                if (id.kind == PartKind::Bundle) {
                                  set.bundles.emplace_back(tokens.begin(), tokens.end());
                                } else {
                                  std::copy_if(tokens.begin(), tokens.end(),
                                               std::back_inserter(symbols[id.region]), is_taken_as_coded);
                                }
                              }};
      const EncodedModel encoded = encode_model(
                                       source, grid, serial_for(), [] {}, hooks)
                                       .value();
      auto part = encoded.parts.begin();
      for (RegionId id = 0; id <= partition.region_count; ++id) {
        const RegionEntry& entry = encoded.directory.regions[id];
        for (const LevelEntry& level : entry.levels) {
          const DecodeLimits limits{level.vertices, level.triangles, entry.box_min, entry.box_max};
          set.regions.push_back(training_region(*part++, limits, tables, std::move(symbols[id])));
        }
        if (entry.bundle_triangles > 0) ++part;
      }
    }
  }
  return set;
}

std::int16_t fixed(double value, double scale, double most = 16000) {
  return static_cast<std::int16_t>(std::lround(std::clamp(value * scale, -most, most)));
}

/// Calls visit(walk, surroundings, position) for every vertex that something predicts; `visit` places it.
void for_each_vertex(const TrainingRegion& region,
                     const std::function<void(GeometryWalk&, const Surroundings&, IntLanes)>& visit) {
  if (region.mesh.triangles.empty()) return;
  GeometryWalk::Memory memory;
  GeometryWalk walk(region.table, region.table.vertex_count(), region.box.extent(), memory);
  for (Surroundings around{}; walk.next_vertex(around);) {
    const GridPoint& position = region.positions[walk.old_number()];
    if (!around.has_neighbours) {
      walk.place_first(position);
    } else {
      visit(walk, around, IntLanes{position.x, position.y, position.z, 0});
    }
  }
}

/// Errors count in units of what is to be expected there (the errors nearby), else coarse meshes decide all.
std::array<ShapeWeights, kShapeClasses> fit_shape(const TrainingSet& set) {
  std::array<LeastSquares<3>, kShapeClasses> fits;
  {
    for (const TrainingRegion& region : set.regions) {
      for_each_vertex(region, [&](GeometryWalk& walk, const Surroundings& around, IntLanes position) {
        double error = 0;
        if (around.parallelograms > 0) {
          // At least a 32nd of the reach: where all is flat and regular, one outlier would decide
          // everything.
          const FloatLanes logs = around.logs * (1 / kLogUnit);
          const double expected = std::exp2(std::max({logs[0], logs[2], logs[3] - 40}) / 8.0) / 4;
          for (int axis = 0; axis < 3; ++axis) {
            const double y = position[axis] - double{around.mean[axis]};
            error += std::abs(y);
            fits[around.shape_class].add({around.beyond[axis], around.ring[axis], around.trend[axis]}, y,
                                         1 / ((expected + 1) * (expected + std::abs(y) + 1)));
          }
        }
        walk.place(around, position, static_cast<std::uint32_t>(error),
                   static_cast<std::uint32_t>(error / 2));
      });
    }
  }
  std::array<ShapeWeights, kShapeClasses> weights;
  for (unsigned i = 0; i < kShapeClasses; ++i) {
    const auto w = fits[i].solve(300);
    const auto weight = [&](std::size_t feature) { return fixed(w[feature], 1024, kMostShapeWeight); };
    weights[i] = {weight(0), weight(1), weight(2)};
  }
  return weights;
}

std::array<std::array<SizeWeights, 3>, kSizeClasses> fit_size(const TrainingSet& set,
                                                              const CodecTables& start) {
  const Predictor predictor(start, {});
  std::array<std::array<LeastSquares<kSizeFeatures>, 3>, kSizeClasses> fits;
  const auto learn = [&](unsigned size_class, unsigned axis, const std::array<double, kSizeFeatures>& x,
                         std::uint32_t magnitude) {
    fits[size_class][axis].add(x, 8 * std::log2(4.0 * magnitude + 2), 1);
  };
  for (const TrainingRegion& region : set.regions) {
    for_each_vertex(region, [&](GeometryWalk& walk, const Surroundings& around, IntLanes position) {
      const CodedResidual residual = residual_of(predictor, around, position);
      const std::uint32_t u = magnitude_of(residual.u), w = magnitude_of(residual.w),
                          last = magnitude_of(residual.last);
      auto features = Predictor::size_features(around, log_of_magnitude(u), log_of_magnitude(w));
      learn(around.size_class, 2, features, last);
      features[8] = 0;
      learn(around.size_class, 1, features, w);
      features[7] = 0;
      learn(around.size_class, 0, features, u);
      walk.place(around, position, u + w, last);
    });
  }
  std::array<std::array<SizeWeights, 3>, kSizeClasses> weights;
  for (unsigned c = 0; c < kSizeClasses; ++c) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const auto w = fits[c][axis].solve(100);
      for (unsigned i = 0; i < kSizeFeatures; ++i) weights[c][axis][i] = fixed(w[i], 256);
    }
  }
  return weights;
}

unsigned region_symbols(unsigned model) {
  if (model < region_model::kMagnitude) return 5;
  if (model == region_model::kIsClosed || model == region_model::kTurned || model == region_model::kTurned1 ||
      model == region_model::kIsListed)
    return 2;
  if (model >= region_model::kListSigns && model < region_model::kListPick) return 4;
  return kSymbols;
}

unsigned bundle_symbols(unsigned model) { return model < bundle_model::kStart ? 4 : kSymbols; }

}  // namespace

TrainedTables train(const std::vector<const Model*>& models) {
  const TrainingSet set = make_training_set(models);
  TrainedTables tables;
  tables.region.assign(region_model::kCount, fresh_model());
  tables.shape = {};
  tables.size = shipped_tables().size;
  tables.shape = fit_shape(set);
  tables.size = fit_size(set, tables.view());

  std::vector<Sequence> parts;
  for (const TrainingRegion& region : set.regions) {
    EntropyEncoder out;
    if (region.mesh.triangles.empty()) continue;
    encode_positions(region.table, region.positions, region.box, tables.view(), out);
    encode_turned_and_anchors(region.mesh, out);
    Sequence sequence = region.symbols;
    sequence.insert(sequence.end(), out.tokens().begin(), out.tokens().end());
    parts.push_back(std::move(sequence));
  }
  parts.insert(parts.end(), set.exact.begin(), set.exact.end());
  FittedBank region = fit_bank(parts, region_model::kCount, region_symbols);
  FittedBank bundle = fit_bank(set.bundles, bundle_model::kCount, bundle_symbols);
  tables.packed_region = std::move(region.packed), tables.region_is_seen = std::move(region.is_seen);
  tables.region = std::move(region.start);
  for (unsigned m = 0; m < region_model::kCount; ++m) {
    if (!tables.region_is_seen[m]) tables.region[m] = shipped_tables().region[m];
  }
  tables.packed_bundle = std::move(bundle.packed), tables.bundle_is_seen = std::move(bundle.is_seen);
  tables.bundle = std::move(bundle.start);
  return tables;
}

namespace {

void append_models(std::string& out, const char* name, const char* count,
                   const std::vector<PackedModel>& models, const std::vector<bool>& is_seen,
                   const std::function<std::string_view(unsigned)>& unseen) {
  char text[64];
  out += std::string("constexpr std::array<std::string_view, ") + count + "> " + name + "{\n";
  for (std::size_t m = 0; m < models.size(); ++m) {
    out += m % 3 == 0 ? "    \"" : " \"";
    if (is_seen[m]) {
      for (std::uint8_t level : models[m].levels)
        std::snprintf(text, sizeof text, "%02x", level), out += text;
      std::snprintf(text, sizeof text, "%02x%02x", models[m].uses, models[m].uses_limit), out += text;
    } else {
      out += unseen(static_cast<unsigned>(m));
    }
    out += m % 3 == 2 ? "\",\n" : "\",";
  }
  out += "};\n";
}

}  // namespace

std::string to_source(const TrainedTables& tables) {
  std::string out =
      "// Made by bench/train; see docs/FORMAT.md, \"Tables\". Do not edit: a change of any number is a "
      "change of format.\n";
  append_models(out, "kRegionModels", "region_model::kCount", tables.packed_region, tables.region_is_seen,
                shipped_region_text);
  append_models(out, "kBundleModels", "bundle_model::kCount", tables.packed_bundle, tables.bundle_is_seen,
                [](unsigned) { return std::string_view(); });
  char text[64];
  out += "constexpr std::array<ShapeWeights, kShapeClasses> kShapeWeights{{\n";
  for (const ShapeWeights& w : tables.shape)
    std::snprintf(text, sizeof text, "    {%d, %d, %d},\n", w.beyond, w.ring, w.trend), out += text;
  out += "}};\nconstexpr std::array<std::array<SizeWeights, 3>, kSizeClasses> kSizeWeights{{\n";
  for (const auto& axes : tables.size) {
    out += "    {{";
    for (const SizeWeights& weights : axes) {
      out += "{";
      for (std::int16_t w : weights) std::snprintf(text, sizeof text, "%d, ", w), out += text;
      out += "},";
    }
    out += "}},\n";
  }
  out += "}};\n";
  return out;
}

}  // namespace selvage::bench
