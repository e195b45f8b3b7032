// SPDX-License-Identifier: MIT
//
// The region part's layout (docs/FORMAT.md, "Region part"): one byte of version and flags, then everything
// else in one entropy-coded span: connectivity, blends, positions and the floats behind them, or both in
// lists of values, turned bits, anchors.
//
//   u8      low 4 bits kRegionPartVersion, then has_turned, has_anchors, has_exact, is_coarse
//   bytes   entropy coded to the end of the part
//
// A level coarser than the finest has no floats, but the boundary map before the turned bits; its coordinates
// and the box that bounds them lack the level's dropped low bits.
//
// A part of a region without triangles holds loose vertices: their number stands in place of connectivity.
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/result.h"
#include "common/codec/codec_tables.h"
#include "common/codec/geometry_walk.h"
#include "common/coding/byte_io.h"
#include "common/mesh/boundary_loops.h"

namespace selvage {

inline constexpr std::uint8_t kRegionPartVersion = 1;

struct RegionPartHeader {
  bool has_turned = false;
  bool has_anchors = false;
  bool has_exact = false;
  bool is_coarse = false;  ///< not the finest level
};

void write_region_header(ByteWriter& out, const RegionPartHeader& header);
Result<RegionPartHeader> read_region_header(ByteReader& in);

/// An inclusive box on the grid.
struct GridBox {
  GridPoint low, high;
  std::int32_t extent() const;
  bool holds(const GridPoint& p) const {
    return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y && p.z <= high.z;
  }
  /// Bits that an offset from `low` takes.
  int offset_bits(int axis) const;
};

/// A point, or a box, without its low bits, and the middle of the cell of such a point.
GridPoint drop_bits(const GridPoint& p, int dropped);
inline GridBox drop_bits(const GridBox& box, int dropped) {
  return {drop_bits(box.low, dropped), drop_bits(box.high, dropped)};
}
GridPoint restore_bits(const GridPoint& p, int dropped);

/// One axis of a residual: magnitude m is split at the class's raw_low_bits k. m >> k is a symbol 0..14, or
/// kMagnitudeEscape and the excess as a number. After the symbols of all three axes come, for each axis
/// unless both m >> k and k are 0, the sign and the k low bits. Mirrors: server/encode/attribute_encoder.cpp,
/// client/decode/attribute_decoder.cpp.
inline unsigned magnitude_model(unsigned axis, const Surroundings& around, const SizeClass& size) {
  const unsigned several = around.parallelograms >= 2;
  return region_model::kMagnitude + (axis * 2 + several) * region_model::kMagnitudes + size.magnitude;
}
/// In the boundary map, a run of so many indices or more, less one, is this symbol and the excess.
inline constexpr std::uint32_t kRunEscape = 15;
/// More than any valid residual can be: predictions lie within 2^28 of the grid.
inline constexpr std::uint32_t kMaxResidual = 1u << 29;

/// What is coded of a vertex: residuals along the two tangential axes, what the tangent plane makes of them
/// along the normal axis, and what is left there.
struct CodedResidual {
  std::int32_t u, w, tangent, last;
};
inline CodedResidual residual_of(const Predictor& predictor, const Surroundings& around, IntLanes position) {
  const IntLanes residual = position - predictor.predict(around);
  const unsigned d = around.normal_axis;
  const std::int32_t u = residual[d == 2 ? 0 : d + 1], w = residual[d == 0 ? 2 : d - 1];
  const std::int32_t tangent = predictor.tangent_residual(around, u, w);
  return {u, w, tangent, residual[d] - tangent};
}

/// The order that anchor gaps count in: boundary vertices by boundary index, then the others.
std::vector<VertexId> anchor_order(const BoundaryLoops& loops, std::uint32_t vertex_count);

/// Maps signed to unsigned so that small magnitudes stay small: 0, -1, 1, -2 -> 0, 1, 2, 3.
inline std::uint32_t fold_sign(std::int32_t value) {
  return (static_cast<std::uint32_t>(value) << 1) ^ static_cast<std::uint32_t>(value >> 31);
}
inline std::int32_t unfold_sign(std::uint32_t folded) {
  return static_cast<std::int32_t>(folded >> 1) ^ -static_cast<std::int32_t>(folded & 1);
}

}  // namespace selvage
