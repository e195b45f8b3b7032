// SPDX-License-Identifier: MIT
#include "bench/simplify/layered/refinement_training.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bench/train/least_squares.h"
#include "bench/train/model_fit.h"
#include "common/mesh/check_corner_table.h"

namespace selvage::bench {
namespace {

std::int16_t fixed(double value, double scale) {
  return static_cast<std::int16_t>(std::lround(std::clamp(value * scale, -16000.0, 16000.0)));
}

void check(bool holds, const char* what) {
  if (!holds) std::fprintf(stderr, "layers: %s\n", what), std::abort();
}

void check_level(const LayeredRegion& region, const GrowingRegion& grown_region,
                 const std::vector<VertexId>& source_of_vertex, std::size_t level) {
  const LayerSize& size = region.sizes[level];
  const RegionMesh mesh = grown(grown_region, region.loop_lengths, size);
  const CornerTable table = grown_region.mesh.plain();
  check(table.vertex_count() == size.vertices && table.triangle_count() == size.triangles,
        "another number of vertices or triangles");
  check(check_corner_table(table).has_value(), "not a manifold");
  const CornerTable& expected = level == 0 ? region.finest : region.layers[level - 1].coarse;
  const auto triangles = [](const CornerTable& of, auto name) {
    std::vector<Triangle> all;
    for (TriangleId t = 0; t < of.triangle_count(); ++t) {
      if (of.vertex(3 * t) == kNone) continue;
      Triangle triangle = of.triangle(t);
      for (VertexId& v : triangle) v = name(v);
      std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
      all.push_back(triangle);
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  check(triangles(table, [&](VertexId v) { return source_of_vertex[v]; }) ==
            triangles(expected, [](VertexId v) { return v; }),
        "other triangles");
  for (VertexId v = 0; v < size.vertices; ++v) {
    check(
        mesh.positions[v] == restore_bits(drop_bits(region.positions[source_of_vertex[v]], size.dropped_bits),
                                          size.dropped_bits),
        "another position");
    const bool is_border = table.is_border_vertex(v);
    check(is_border == (grown_region.run[v].length > 0), "another border");
  }
  for (std::size_t i = 0; i < mesh.vertex_of_boundary.size(); ++i) {
    check(source_of_vertex[mesh.vertex_of_boundary[i]] ==
              region.representative[level][region.vertex_of_boundary[i]],
          "another boundary vertex");
  }
}

}  // namespace

std::vector<Bytes> encode_layers(const LayeredRegion& region, const RefinementTables& tables,
                                 const LayerWatch* watch, std::vector<EntropyEncoder>* symbols) {
  GrowingRegion growing =
      start_growing(region.base_mesh, region.loop_lengths, region.sizes.back(), region.sizes.front());
  GrowingRegion decoded = growing;
  LayerEncoder encoder(growing, region.positions, region.source_of_base, region.finest,
                       region.corner_of_base);
  std::vector<Bytes> parts(kLevels - 1);
  for (std::size_t level = kLevels - 1; level-- > 0;) {
    const LayerSize &coarse = region.sizes[level + 1], &fine = region.sizes[level];
    const auto& splits = region.layers[level].splits;
    if (splits.empty() && coarse.dropped_bits == fine.dropped_bits) continue;
    EntropyEncoder coded = encoder.encode(splits, coarse, fine, level == 0, tables, watch);
    parts[level] = coded.finish(tables.models).bytes;
    if (symbols != nullptr) symbols->push_back(std::move(coded));
    check_level(region, growing, encoder.source_of_vertex(), level);
    check(decode_layer(parts[level], coarse, fine, level == 0, tables, decoded), "does not decode");
    check_level(region, decoded, encoder.source_of_vertex(), level);
  }
  return parts;
}

RefinementTables train_refinement(std::span<const LayeredModel* const> models) {
  RefinementTables tables;
  tables.models.assign(refinement_model::kCount, fresh_model());
  for (auto& axes : tables.size) {
    for (SizeWeights& weights : axes) weights[6] = 256;
  }
  const auto encode_all = [&](const LayerWatch* watch, std::vector<EntropyEncoder>* symbols) {
    for (const LayeredModel* model : models) {
      for (const LayeredRegion& region : model->regions) encode_layers(region, tables, watch, symbols);
    }
  };

  std::array<LeastSquares<kPlaceFeatures>, kPlaceClasses> places;
  LayerWatch watch;
  watch.on_place = [&](const PlaceModel::Features& features, IntLanes position) {
    const FloatLanes y = to_float(position) - features.mean;
    // In units of the ring, about: the largest rings would decide everything.
    double scale = 1;
    for (const FloatLanes& step : features.steps) {
      for (int axis = 0; axis < 3; ++axis) scale += std::abs(step[axis]);
    }
    for (int axis = 0; axis < 3; ++axis) {
      std::array<double, kPlaceFeatures> x;
      for (unsigned i = 0; i < kPlaceFeatures; ++i) x[i] = features.steps[i][axis];
      places[features.place_class].add(x, y[axis], 1 / (scale * (0.25 * scale + std::abs(y[axis]))));
    }
  };
  encode_all(&watch, nullptr);
  for (unsigned c = 0; c < kPlaceClasses; ++c) {
    const auto w = places[c].solve(1);
    for (unsigned i = 0; i < kPlaceFeatures; ++i) tables.place[c][i] = fixed(w[i], 1024);
  }

  std::array<std::array<LeastSquares<kSizeFeatures>, 3>, kSizeClasses> sizes;
  watch = {};
  watch.on_residual = [&](const Surroundings& around, const CodedResidual& residual) {
    const std::uint32_t u = magnitude_of(residual.u), w = magnitude_of(residual.w),
                        last = magnitude_of(residual.last);
    auto features = Predictor::size_features(around, log_of_magnitude(u), log_of_magnitude(w));
    const auto learn = [&](unsigned axis, std::uint32_t magnitude) {
      sizes[around.size_class][axis].add(features, 8 * std::log2(4.0 * magnitude + 2), 1);
    };
    learn(2, last);
    features[8] = 0;
    learn(1, w);
    features[7] = 0;
    learn(0, u);
  };
  encode_all(&watch, nullptr);
  for (unsigned c = 0; c < kSizeClasses; ++c) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const auto w = sizes[c][axis].solve(100);
      for (unsigned i = 0; i < kSizeFeatures; ++i) tables.size[c][axis][i] = fixed(w[i], 256);
    }
  }

  std::vector<EntropyEncoder> symbols;
  encode_all(nullptr, &symbols);
  std::vector<std::vector<Token>> parts;
  for (const EntropyEncoder& part : symbols) parts.emplace_back(part.tokens().begin(), part.tokens().end());
  tables.models = fit_bank(parts, refinement_model::kCount, [](unsigned) { return kSymbols; }).start;
  return tables;
}

}  // namespace selvage::bench
