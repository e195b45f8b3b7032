// SPDX-License-Identifier: MIT
#include "bench/simplify/layered/refinement_coder.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "common/coding/entropy_decoder.h"

namespace selvage::bench {
namespace {

using refinement_model::kExcess;

CornerId four(CornerId c) { return c / 3 * 4 + c % 3; }

/// x, y, z of a residual along the normal axis and the two after it.
IntLanes along_axes(unsigned normal_axis, std::int32_t n, std::int32_t u, std::int32_t w) {
  static constexpr IntLanes kLanes[3] = {{-1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}};
  const IntLanes first = kLanes[normal_axis], second = __builtin_shufflevector(first, first, 2, 0, 1, 3),
                 third = __builtin_shufflevector(first, first, 1, 2, 0, 3);
  return (first & n) | (second & u) | (third & w);
}

/// A residual and the number of its raw bits: a sign unless it must be 0, then the low bits.
struct Residual {
  std::int32_t magnitude, value;
  int bits;
  Residual(std::uint32_t coarse, int low_bits, std::uint64_t window)
      : bits(low_bits + ((coarse | static_cast<unsigned>(low_bits)) != 0)) {
    const auto raw = static_cast<std::uint32_t>(window);
    magnitude = static_cast<std::int32_t>(coarse << low_bits | (raw >> 1 & ((1u << low_bits) - 1)));
    const auto sign = static_cast<std::int32_t>(raw & 1);
    value = (magnitude ^ -sign) + sign;
  }
};

unsigned place_model(unsigned axis, const Surroundings& around, const SizeClass& size) {
  return refinement_model::kMagnitude + magnitude_model(axis, around, size) - region_model::kMagnitude;
}

class LayerDecoder {
 public:
  LayerDecoder(std::span<const std::byte> bytes, const RefinementTables& tables)
      : in_(bytes, tables.models) {}

  EntropyDecoder& in() { return in_; }

  SplitChoice wanted(VertexId) { return {}; }
  unsigned symbol(unsigned model, unsigned) { return in_.symbol(model); }
  std::uint32_t number(unsigned model, std::uint32_t) { return in_.number(model); }
  void is_split(std::uint32_t) {}

  [[gnu::always_inline]] IntLanes position(const Predictor& sizes, const Surroundings& around,
                                           const PlaceModel::Features&, std::uint32_t& tangential,
                                           std::uint32_t& normal) {
    const IntLanes expected = sizes.expected_sizes(around);
    const SizeClass first = sizes.size_class(around, expected, 0, 0, 0);
    const unsigned symbol_u = in_.symbol(place_model(0, around, first));
    const std::uint32_t coarse_u = coarse(symbol_u, first);
    const std::int32_t log_u = coarse_log(symbol_u, first);
    const SizeClass second = sizes.size_class(around, expected, 1, log_u, 0);
    const unsigned symbol_w = in_.symbol(place_model(1, around, second));
    const std::uint32_t coarse_w = coarse(symbol_w, second);
    const SizeClass third = sizes.size_class(around, expected, 2, log_u, coarse_log(symbol_w, second));
    const std::uint32_t coarse_last = coarse(in_.symbol(place_model(2, around, third)), third);
    std::uint64_t window = in_.peek_bits();
    const Residual u(coarse_u, first.raw_low_bits, window);
    const Residual w(coarse_w, second.raw_low_bits, window >>= u.bits);
    const Residual last(coarse_last, third.raw_low_bits, window >>= w.bits);
    in_.skip_bits(u.bits + w.bits + last.bits);
    tangential = static_cast<std::uint32_t>(u.magnitude + w.magnitude);
    normal = static_cast<std::uint32_t>(last.magnitude);
    const std::int32_t tangent = sizes.tangent_residual(around, u.value, w.value);
    return rounded(around.mean) + along_axes(around.normal_axis, last.value + tangent, u.value, w.value);
  }

 private:
  std::uint32_t coarse(unsigned symbol, const SizeClass& size) {
    if (symbol != kMagnitudeEscape) return symbol;
    return std::min(symbol + std::min(in_.number(kExcess), kMaxResidual), kMaxResidual >> size.raw_low_bits);
  }
  EntropyDecoder in_;
};

}  // namespace

GrowingRegion start_growing(const RegionMesh& base, std::span<const std::uint32_t> finest_loop_lengths,
                            const LayerSize& coarsest, const LayerSize& finest) {
  // A decoder that shipped would keep the table that the base was decoded into.
  GrowingRegion region(build_corner_table(base.triangles, base.vertex_count()), finest.vertices,
                       finest.triangles);
  for (VertexId v = 0; v < base.vertex_count(); ++v) {
    const GridPoint p = drop_bits(base.positions[v], coarsest.dropped_bits);
    region.position[v] = IntLanes{p.x, p.y, p.z, 0};
  }
  std::uint32_t first = 0;
  for (std::uint32_t l = 0; l < finest_loop_lengths.size(); first += finest_loop_lengths[l++]) {
    const auto loop = std::span(base.vertex_of_boundary).subspan(first, finest_loop_lengths[l]);
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
      GrowingRegion::BoundaryRun& run = region.run[loop[i]];
      // The first run may have begun at the loop's end.
      if (run.length++ == 0 || (i > 0 && loop[i - 1] != loop[i])) run.begin = i, run.loop = l;
    }
  }
  return region;
}

RegionMesh grown(const GrowingRegion& region, std::span<const std::uint32_t> finest_loop_lengths,
                 const LayerSize& level) {
  RegionMesh mesh;
  mesh.triangles = region.mesh.triangles();
  mesh.positions.resize(level.vertices);
  std::vector<std::uint32_t> begin_of_loop{0};
  for (const std::uint32_t length : finest_loop_lengths)
    begin_of_loop.push_back(begin_of_loop.back() + length);
  mesh.vertex_of_boundary.resize(begin_of_loop.back());
  for (VertexId v = 0; v < level.vertices; ++v) {
    const IntLanes p = region.position[v];
    mesh.positions[v] = restore_bits({p[0], p[1], p[2]}, level.dropped_bits);
    const GrowingRegion::BoundaryRun& run = region.run[v];
    for (std::uint32_t i = 0; i < run.length; ++i) {
      const std::uint32_t at = (run.begin + i) % finest_loop_lengths[run.loop];
      mesh.vertex_of_boundary[begin_of_loop[run.loop] + at] = v;
    }
  }
  return mesh;
}

bool decode_layer(std::span<const std::byte> bytes, const LayerSize& coarse, const LayerSize& fine,
                  bool is_finest, const RefinementTables& tables, GrowingRegion& region) {
  LayerDecoder side(bytes, tables);
  const int low = coarse.dropped_bits - fine.dropped_bits;
  if (low > 0) {
    for (VertexId v = 0; v < coarse.vertices; ++v) {
      const auto x = static_cast<std::int32_t>(side.in().bits(low)),
                 y = static_cast<std::int32_t>(side.in().bits(low)),
                 z = static_cast<std::int32_t>(side.in().bits(low));
      region.position[v] = region.position[v] << low | IntLanes{x, y, z, 0};
    }
  }
  RefinementWalk<LayerDecoder> walk(region, tables, fine.vertices, fine.triangles, is_finest, side);
  return walk.run() && side.in().is_finished();
}

LayerEncoder::LayerEncoder(GrowingRegion& region, std::span<const GridPoint> positions,
                           std::vector<VertexId> source_of_vertex, const CornerTable& finest,
                           std::span<const CornerId> corner_of_base)
    : region_(region),
      positions_(positions),
      source_of_vertex_(std::move(source_of_vertex)),
      local_of_corner_(finest.corner_count(), kNone) {
  for (CornerId c = 0; c < corner_of_base.size(); ++c) local_of_corner_[corner_of_base[c]] = four(c);
}

EntropyEncoder LayerEncoder::encode(const std::vector<PlannedSplit>& splits, const LayerSize& coarse,
                                    const LayerSize& fine, bool is_finest, const RefinementTables& tables,
                                    const LayerWatch* watch) {
  out_ = {};
  watch_ = watch;
  splits_ = &splits;
  dropped_bits_ = fine.dropped_bits;
  const int low = coarse.dropped_bits - fine.dropped_bits;
  for (VertexId v = 0; v < coarse.vertices && low > 0; ++v) {
    const GridPoint p = drop_bits(positions_[source_of_vertex_[v]], fine.dropped_bits);
    for (int axis = 0; axis < 3; ++axis)
      out_.bits(static_cast<std::uint32_t>(p[axis]) & ((1u << low) - 1), low);
    region_.position[v] = IntLanes{p.x, p.y, p.z, 0};
  }
  waits_for_.clear();
  ready_.clear();
  for (std::uint32_t i = 0; i < splits.size(); ++i) {
    waits_for_.push_back(splits[i].waits_for);
    if (splits[i].waits_for == 0) ready_.push_back(i);
  }
  RefinementWalk<LayerEncoder> walk(region_, tables, fine.vertices, fine.triangles, is_finest, *this);
  if (!walk.run() || !ready_.empty()) std::fprintf(stderr, "layers: a level is not reached\n"), std::abort();
  return std::move(out_);
}

SplitChoice LayerEncoder::wanted(VertexId v) {
  for (const std::uint32_t i : ready_) {
    const PlannedSplit& planned = (*splits_)[i];
    const CornerId first = local_of_corner_[planned.first], last = local_of_corner_[planned.last];
    if (region_.mesh.vertex(first) != v) continue;
    current_ = i;
    const SplitMesh::Star star = region_.mesh.star(v);
    const auto place = [&](CornerId c) {
      return static_cast<std::uint32_t>(std::find(star.corners, star.corners + star.size, c) - star.corners);
    };
    SplitChoice wanted{planned.kind, 0, 0, planned.boundary_run};
    if (planned.is_ear) {
      wanted.begin = planned.kind == SplitKind::AtEnd ? star.size : 0;
    } else if (planned.kind == SplitKind::AtStart) {
      wanted.span = place(last) + 1;
    } else if (planned.kind == SplitKind::AtEnd) {
      wanted.begin = place(first);
      wanted.span = star.size - wanted.begin;
    } else {
      wanted.begin = place(first);
      const std::uint32_t end = place(last) + 1;
      wanted.span = end > wanted.begin ? end - wanted.begin : end + star.size - wanted.begin;
    }
    return wanted;
  }
  return {};
}

IntLanes LayerEncoder::position(const Predictor& sizes, const Surroundings& around,
                                const PlaceModel::Features& features, std::uint32_t& tangential,
                                std::uint32_t& normal) {
  const GridPoint p = drop_bits(positions_[(*splits_)[current_].from], dropped_bits_);
  const IntLanes position{p.x, p.y, p.z, 0};
  if (watch_ != nullptr && watch_->on_place) watch_->on_place(features, position);
  const CodedResidual residual = residual_of(sizes, around, position);
  if (watch_ != nullptr && watch_->on_residual) watch_->on_residual(around, residual);
  const IntLanes expected = sizes.expected_sizes(around);
  const auto magnitude = [&](unsigned axis, const SizeClass& size, std::int32_t value) {
    const std::uint32_t coarse = magnitude_of(value) >> size.raw_low_bits,
                        symbol = std::min(coarse, kMagnitudeEscape);
    out_.symbol(place_model(axis, around, size), symbol);
    if (symbol == kMagnitudeEscape) out_.number(kExcess, coarse - kMagnitudeEscape);
    return coarse_log(symbol, size);
  };
  const auto rest = [&](const SizeClass& size, std::int32_t value) {
    if (magnitude_of(value) >> size.raw_low_bits == 0 && size.raw_low_bits == 0) return;
    out_.bits((magnitude_of(value) & ((1u << size.raw_low_bits) - 1)) << 1 | (value < 0),
              1 + size.raw_low_bits);
  };
  const SizeClass first = sizes.size_class(around, expected, 0, 0, 0);
  const std::int32_t log_u = magnitude(0, first, residual.u);
  const SizeClass second = sizes.size_class(around, expected, 1, log_u, 0);
  const std::int32_t log_w = magnitude(1, second, residual.w);
  const SizeClass third = sizes.size_class(around, expected, 2, log_u, log_w);
  magnitude(2, third, residual.last);
  rest(first, residual.u);
  rest(second, residual.w);
  rest(third, residual.last);
  tangential = magnitude_of(residual.u) + magnitude_of(residual.w);
  normal = magnitude_of(residual.last);
  return position;
}

void LayerEncoder::is_split(std::uint32_t triangles) {
  const PlannedSplit& planned = (*splits_)[current_];
  source_of_vertex_.push_back(planned.from);
  CornerId t = 4 * triangles;
  for (const CornerId c : {planned.before, planned.after}) {
    if (c == kNone) continue;
    local_of_corner_[c] = t;
    local_of_corner_[next(c)] = t + 1;
    local_of_corner_[prev(c)] = t + 2;
    t += 4;
  }
  ready_.erase(std::find(ready_.begin(), ready_.end(), current_));
  for (const std::uint32_t i : planned.lets) {
    if (--waits_for_[i] == 0) ready_.push_back(i);
  }
}

}  // namespace selvage::bench
