// SPDX-License-Identifier: MIT
//
// What fuzz_region and fuzz_bundle take, and tests/wasm and tests/golden read and write: a part behind what a
// directory would say of it.
//
//   region   u16 vertices, u16 triangles, u8 flags (1 exact, 2 coarser level), u16 box (low corner, then
//            extents), of a coarser level u8 dropped bits, u8 number of loops and their lengths as u16, the
//            part
//   bundle   u8 regions less one, for each a u8 number of loops and a u8 length less one for each loop, u16
//            triangles, the part
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "client/decode/bundle_decoder.h"
#include "client/decode/region_decoder.h"
#include "common/coding/byte_io.h"

namespace selvage {

/// The grid of every input with exact floats, which is that of the golden packs with such.
inline constexpr Grid kExactInputGrid{.origin = {-125, -125, -125}, .step = 250.0 / 1023, .bits = 10};

struct RegionInput {
  DecodeLimits expected;
  std::vector<std::uint32_t> loops;  ///< what `expected.coarse` refers to
  std::span<const std::byte> part;

  RegionInput() = default;
  RegionInput(RegionInput&&) = default;  // a moved vector's elements stay where they are
};

inline RegionInput read_region_input(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  RegionInput input;
  DecodeLimits& expected = input.expected;
  expected.vertices = in.u16();
  expected.triangles = in.u16();
  const std::uint8_t flags = in.u8();
  if (flags & 1) expected.exact = kExactInputGrid;
  for (int axis = 0; axis < 3; ++axis) expected.box_min[axis] = in.u16();
  for (int axis = 0; axis < 3; ++axis) expected.box_max[axis] = expected.box_min[axis] + in.u16();
  if (flags & 2) {
    const int dropped_bits = in.u8() % 16;
    input.loops.resize(in.u8());
    for (std::uint32_t& length : input.loops) length = in.u16();
    expected.coarse = CoarseLevel{input.loops, dropped_bits};
  }
  input.part = in.take(in.left());
  return input;
}

/// Nothing if a number does not fit.
inline std::optional<Bytes> write_region_input(const RegionInput& input) {
  ByteWriter out;
  bool fits = input.loops.size() < 256;
  const auto u16 = [&](std::int64_t value) {
    fits = fits && value >= 0 && value <= 0xffff;
    out.u16(static_cast<std::uint16_t>(value));
  };
  const DecodeLimits& expected = input.expected;
  u16(expected.vertices);
  u16(expected.triangles);
  out.u8(static_cast<std::uint8_t>(expected.exact.has_value() | expected.coarse.has_value() << 1));
  for (int axis = 0; axis < 3; ++axis) u16(expected.box_min[axis]);
  for (int axis = 0; axis < 3; ++axis) u16(std::int64_t{expected.box_max[axis]} - expected.box_min[axis]);
  if (expected.coarse) {
    out.u8(static_cast<std::uint8_t>(expected.coarse->dropped_bits));
    out.u8(static_cast<std::uint8_t>(input.loops.size()));
    for (const std::uint32_t length : input.loops) u16(length);
  }
  out.append(input.part);
  return fits ? std::optional(std::move(out).take()) : std::nullopt;
}

struct BundleInput {
  std::vector<std::vector<std::uint32_t>> loops;  ///< by region, the bundle's own last
  std::uint32_t triangles = 0;
  std::span<const std::byte> part;

  /// Of regions 1, 2 ...; borrows the loops.
  BundleTopology topology() const {
    std::vector<BundleTopology::Region> regions;
    for (const auto& lengths : loops) regions.push_back({static_cast<RegionId>(regions.size() + 1), lengths});
    return BundleTopology(std::move(regions));
  }
};

inline BundleInput read_bundle_input(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  BundleInput input;
  input.loops.resize(1 + in.u8() % 8);
  for (auto& lengths : input.loops) {
    lengths.resize(in.u8() % 8);
    for (std::uint32_t& length : lengths) length = 1 + in.u8();
  }
  input.triangles = in.u16();
  input.part = in.take(in.left());
  return input;
}

/// Nothing if a number does not fit.
inline std::optional<Bytes> write_bundle_input(const BundleInput& input) {
  bool fits = !input.loops.empty() && input.loops.size() <= 8 && input.triangles <= 0xffff;
  ByteWriter out;
  out.u8(static_cast<std::uint8_t>(input.loops.size() - 1));
  for (const auto& lengths : input.loops) {
    fits = fits && lengths.size() < 8 &&
           std::all_of(lengths.begin(), lengths.end(),
                       [](std::uint32_t length) { return length >= 1 && length <= 256; });
    out.u8(static_cast<std::uint8_t>(lengths.size()));
    for (const std::uint32_t length : lengths) out.u8(static_cast<std::uint8_t>(length - 1));
  }
  out.u16(static_cast<std::uint16_t>(input.triangles));
  out.append(input.part);
  return fits ? std::optional(std::move(out).take()) : std::nullopt;
}

}  // namespace selvage
