// SPDX-License-Identifier: MIT
//
// The text header that opens every PLY file: which elements follow, how many of each, and what each consists
// of.
//
//     ply
//     format binary_little_endian 1.0
//     element vertex 8                               how many vertices
//     property float x                               a scalar
//     element face 12
//     property list uchar int vertex_indices         a count, then that many items
//     end_header
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/base/result.h"

namespace selvage {

enum class PlyEncoding { Ascii, BinaryLittleEndian, BinaryBigEndian };
enum class PlyType : std::uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;
  std::optional<PlyType> count_type;  ///< set for lists

  bool is_list() const { return count_type.has_value(); }
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< as the header claims: check it before trusting it
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;
  std::size_t body_offset = 0;  ///< the first byte after the header
  std::uint64_t body_line = 1;  ///< the number of the line that begins there

  const PlyElement* find(std::string_view name) const;
};

Result<PlyHeader> parse_ply_header(std::span<const std::byte> bytes);

std::size_t size_of(PlyType type);
inline bool is_integer(PlyType type) { return type < PlyType::Float32; }

}  // namespace selvage
