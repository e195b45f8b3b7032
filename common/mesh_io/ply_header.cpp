// SPDX-License-Identifier: MIT
#include "common/mesh_io/ply_header.h"

#include <array>

#include "common/mesh_io/text_scanner.h"

namespace selvage {
namespace {

using Failure = std::optional<tl::unexpected<Error>>;

struct TypeName {
  std::string_view name;
  PlyType type;
};

constexpr std::array<TypeName, 16> kTypeNames = {{
    {"char", PlyType::Int8},
    {"int8", PlyType::Int8},
    {"uchar", PlyType::Uint8},
    {"uint8", PlyType::Uint8},
    {"short", PlyType::Int16},
    {"int16", PlyType::Int16},
    {"ushort", PlyType::Uint16},
    {"uint16", PlyType::Uint16},
    {"int", PlyType::Int32},
    {"int32", PlyType::Int32},
    {"uint", PlyType::Uint32},
    {"uint32", PlyType::Uint32},
    {"float", PlyType::Float32},
    {"float32", PlyType::Float32},
    {"double", PlyType::Float64},
    {"float64", PlyType::Float64},
}};

std::optional<PlyType> type_named(std::string_view name) {
  for (const TypeName& each : kTypeNames)
    if (each.name == name) return each.type;
  return std::nullopt;
}

Failure read_type(TextScanner& scan, PlyType& type) {
  const auto known = type_named(scan.peek());
  if (!known) return scan.fail_expecting("a PLY type (char, uchar, short, ushort, int, uint, float, double)");
  scan.word();
  type = *known;
  return std::nullopt;
}

Failure read_format(TextScanner& scan, PlyEncoding& encoding) {
  const std::string_view name = scan.peek();
  if (name == "ascii")
    encoding = PlyEncoding::Ascii;
  else if (name == "binary_little_endian")
    encoding = PlyEncoding::BinaryLittleEndian;
  else if (name == "binary_big_endian")
    encoding = PlyEncoding::BinaryBigEndian;
  else
    return scan.fail_expecting("ascii, binary_little_endian or binary_big_endian");
  scan.word();
  if (scan.peek() != "1.0") return scan.fail_expecting("version 1.0");
  scan.word();
  return std::nullopt;
}

Failure read_element(TextScanner& scan, PlyHeader& header) {
  PlyElement element;
  element.name = scan.word();
  std::int64_t count = 0;
  if (!scan.integer(count) || count < 0) return scan.fail_expecting("the number of elements");
  if (header.find(element.name))
    return scan.fail_here("element " + quote(element.name) + " is declared twice");
  element.count = static_cast<std::uint64_t>(count);
  header.elements.push_back(std::move(element));
  return std::nullopt;
}

Failure read_property(TextScanner& scan, PlyHeader& header) {
  if (header.elements.empty()) return scan.fail_here("a property before the first element");
  PlyProperty property;
  if (scan.peek() == "list") {
    scan.word();
    PlyType count_type{};
    if (auto failure = read_type(scan, count_type)) return failure;
    if (!is_integer(count_type)) return scan.fail_here("the length of a list must have an integer type");
    property.count_type = count_type;
  }
  if (auto failure = read_type(scan, property.type)) return failure;
  property.name = scan.word();
  if (property.name.empty()) return scan.fail_expecting("the property's name");
  header.elements.back().properties.push_back(std::move(property));
  return std::nullopt;
}

/// One line of the header, after its keyword.
Failure read_statement(TextScanner& scan, std::string_view keyword, PlyHeader& header, bool& has_format) {
  if (keyword == "comment" || keyword == "obj_info") return std::nullopt;
  Failure failure;
  if (keyword == "format")
    failure = read_format(scan, header.encoding);
  else if (keyword == "element")
    failure = read_element(scan, header);
  else if (keyword == "property")
    failure = read_property(scan, header);
  else
    return scan.fail_here("unknown statement " + quote(keyword) + " in the PLY header");
  has_format = has_format || keyword == "format";
  if (!failure && !scan.at_line_end()) return scan.fail_expecting("the end of the line");
  return failure;
}

}  // namespace

const PlyElement* PlyHeader::find(std::string_view name) const {
  for (const PlyElement& element : elements)
    if (element.name == name) return &element;
  return nullptr;
}

Result<PlyHeader> parse_ply_header(std::span<const std::byte> bytes) {
  TextScanner scan(bytes, {});
  if (scan.word() != "ply" || !scan.at_line_end()) {
    return scan.fail_here("not a PLY file: it does not begin with a line 'ply'");
  }
  PlyHeader header;
  bool has_format = false;
  for (;;) {
    scan.next_line();
    if (scan.left() == 0)
      return scan.fail_here("the PLY header has no end_header line; is the file cut short?");
    const std::string_view keyword = scan.word();
    if (keyword == "end_header") break;
    if (keyword.empty()) continue;
    if (auto failure = read_statement(scan, keyword, header, has_format)) return std::move(*failure);
  }
  if (!has_format) return scan.fail_here("the PLY header has no format line");
  const std::uint64_t last_line = scan.line();
  scan.next_line();
  header.body_offset = scan.offset();
  header.body_line = last_line + 1;
  return header;
}

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::Int8:
    case PlyType::Uint8:
      return 1;
    case PlyType::Int16:
    case PlyType::Uint16:
      return 2;
    case PlyType::Int32:
    case PlyType::Uint32:
    case PlyType::Float32:
      return 4;
    case PlyType::Float64:
      break;
  }
  return 8;
}

}  // namespace selvage
