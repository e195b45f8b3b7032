// SPDX-License-Identifier: MIT
#include "common/mesh_io/ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "common/mesh_io/mesh_builder.h"
#include "common/mesh_io/ply_header.h"
#include "common/mesh_io/text_scanner.h"

namespace selvage {
namespace {

// The two bodies below give the same interface to the same reading code: step through records, and take or
// skip one value at a time. The first failure is kept and every call after it gives false.

class AsciiBody {
 public:
  AsciiBody(std::span<const std::byte> bytes, const PlyHeader& header)
      : scan_(bytes.subspan(header.body_offset), {}, header.body_line) {}

  /// What `count` records take at least: a digit and a separator for each value, and the last needs no
  /// separator.
  bool can_hold(std::uint64_t count, const PlyElement& element) const {
    const std::uint64_t least = 2 * std::max<std::size_t>(1, element.properties.size());
    return count <= (scan_.left() + 1) / least;
  }
  bool can_hold_list(std::uint64_t count, PlyType) const { return count <= (scan_.left() + 1) / 2; }

  bool begin_record() { return !scan_.at_end() || failed(scan_.fail_here("the file ends early")); }
  bool end_record() {
    return scan_.at_line_end() ||
           failed(scan_.fail_here("more values than the header declares (first " + quote(scan_.peek()) +
                                  "); header and data disagree"));
  }
  void begin_item() { scan_.at_end(); }

  bool coordinate(PlyType, double& value) {
    return scan_.coordinate(value) || failed(scan_.fail_expecting("a finite coordinate"));
  }
  bool integer(PlyType, std::int64_t& value) {
    return scan_.integer(value) || failed(scan_.fail_expecting("an integer"));
  }
  bool skip(PlyType) { return !scan_.word().empty() || failed(scan_.fail_expecting("another value")); }
  bool skip_items(PlyType type, std::uint64_t count) {
    for (; count > 0; --count) {
      begin_item();
      if (!skip(type)) return false;
    }
    return true;
  }
  bool finish() {
    return scan_.at_end() ||
           failed(scan_.fail_here(
               "data after the last element that the header declares; header and data disagree"));
  }

  bool fail_here(std::string message) { return failed(scan_.fail_here(message)); }
  Error take_error() { return std::move(error_); }

 private:
  bool failed(tl::unexpected<Error> failure) {
    error_ = std::move(failure.value());
    return false;
  }

  TextScanner scan_;
  Error error_;
};

class BinaryBody {
 public:
  BinaryBody(std::span<const std::byte> bytes, const PlyHeader& header)
      : bytes_(bytes),
        at_(header.body_offset),
        is_big_endian_(header.encoding == PlyEncoding::BinaryBigEndian) {}

  bool can_hold(std::uint64_t count, const PlyElement& element) const {
    std::uint64_t least = 0;
    for (const PlyProperty& p : element.properties) least += size_of(p.is_list() ? *p.count_type : p.type);
    return least == 0 || count <= left() / least;
  }
  bool can_hold_list(std::uint64_t count, PlyType type) const { return count <= left() / size_of(type); }

  bool begin_record() { return true; }
  bool end_record() { return true; }
  void begin_item() {}

  bool coordinate(PlyType type, double& value) {
    const std::size_t start = at_;
    if (!scalar(type, value)) return false;
    if (std::isfinite(value)) return true;
    at_ = start;
    return fail_here("a coordinate is not a finite number");
  }
  bool integer(PlyType type, std::int64_t& value) { return scalar(type, value); }
  bool skip(PlyType type) { return skip_items(type, 1); }
  bool skip_items(PlyType type, std::uint64_t count) {
    if (count > left() / size_of(type)) return fail_here("the file ends early");
    at_ += count * size_of(type);
    return true;
  }
  /// A line end after the data is what some text tools leave behind; anything else means that the header is
  /// wrong.
  bool finish() {
    for (std::size_t i = at_; i < bytes_.size(); ++i) {
      if (bytes_[i] == std::byte{'\n'} || bytes_[i] == std::byte{'\r'}) continue;
      return fail_here(std::to_string(left()) +
                       " bytes after the last element that the header declares; header and data disagree");
    }
    return true;
  }

  bool fail_here(std::string message) {
    error_ = {ErrorCode::BadFile, std::move(message), at_};
    return false;
  }
  Error take_error() { return std::move(error_); }

 private:
  std::size_t left() const { return bytes_.size() - at_; }

  template <class Raw>
  Raw load() {
    std::array<std::byte, sizeof(Raw)> raw;
    std::memcpy(raw.data(), bytes_.data() + at_, sizeof(Raw));
    at_ += sizeof(Raw);
    if (is_big_endian_ != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<Raw>(raw);
  }

  template <class Value>
  bool scalar(PlyType type, Value& value) {
    if (left() < size_of(type)) return fail_here("the file ends early");
    switch (type) {
      case PlyType::Int8:
        value = static_cast<Value>(load<std::int8_t>());
        break;
      case PlyType::Uint8:
        value = static_cast<Value>(load<std::uint8_t>());
        break;
      case PlyType::Int16:
        value = static_cast<Value>(load<std::int16_t>());
        break;
      case PlyType::Uint16:
        value = static_cast<Value>(load<std::uint16_t>());
        break;
      case PlyType::Int32:
        value = static_cast<Value>(load<std::int32_t>());
        break;
      case PlyType::Uint32:
        value = static_cast<Value>(load<std::uint32_t>());
        break;
      case PlyType::Float32:
        value = static_cast<Value>(load<float>());
        break;
      case PlyType::Float64:
        value = static_cast<Value>(load<double>());
        break;
    }
    return true;
  }

  std::span<const std::byte> bytes_;
  std::size_t at_;
  bool is_big_endian_;
  Error error_;
};

bool is_index_list(const PlyProperty& property) {
  return property.is_list() && is_integer(property.type) &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

int axis_of(const PlyProperty& property) {
  if (property.is_list() || property.name.size() != 1) return -1;
  const int axis = property.name[0] - 'x';
  return axis >= 0 && axis < 3 ? axis : -1;
}

/// "normals, colours and the like": the names of what is not read, for a note.
template <class IsRead>
std::string names_of_dropped(const PlyElement& element, const IsRead& is_read) {
  std::string names;
  for (const PlyProperty& property : element.properties) {
    if (is_read(property)) continue;
    names += (names.empty() ? "" : " ") + property.name;
  }
  return names;
}

template <class Body>
class PlyReader {
 public:
  PlyReader(Body body, const PlyHeader& header) : body_(std::move(body)), header_(header) {
    if (const PlyElement* vertices = header.find("vertex")) vertex_count_ = vertices->count;
  }

  Result<MeshFile> read(std::string format) {
    for (const PlyElement& element : header_.elements)
      if (!read_element(element)) return tl::unexpected<Error>(body_.take_error());
    if (!body_.finish()) return tl::unexpected<Error>(body_.take_error());
    return std::move(mesh_).finish(std::move(format));
  }

 private:
  bool read_element(const PlyElement& element) {
    if (!body_.can_hold(element.count, element)) {
      return body_.fail_here("the header declares " + std::to_string(element.count) + " elements " +
                             quote(element.name) +
                             ", more than the rest of the file can hold; is it cut short?");
    }
    if (element.name == "vertex") return read_vertices(element);
    if (element.name == "face") return read_faces(element, &PlyReader::add_face);
    if (element.name == "tristrips") return read_faces(element, &PlyReader::add_strips);
    return skip_element(element);
  }

  bool read_vertices(const PlyElement& element) {
    std::array<int, 3> found{};
    for (const PlyProperty& property : element.properties)
      if (axis_of(property) >= 0) ++found[axis_of(property)];
    if (found != std::array<int, 3>{1, 1, 1})
      return body_.fail_here("the vertices have no properties x, y and z");
    note_dropped(element, [](const PlyProperty& p) { return axis_of(p) >= 0; });
    mesh_.reserve_vertices(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      Vec3 position;
      if (!body_.begin_record()) return false;
      for (const PlyProperty& property : element.properties) {
        const int axis = axis_of(property);
        if (!(axis >= 0 ? body_.coordinate(property.type, position[axis]) : skip(property))) return false;
      }
      if (!body_.end_record()) return false;
      mesh_.add_vertex(position);
    }
    return true;
  }

  bool read_faces(const PlyElement& element, void (PlyReader::*add)()) {
    int index_lists = 0;
    for (const PlyProperty& property : element.properties) index_lists += is_index_list(property);
    if (index_lists != 1) {
      return body_.fail_here("element " + quote(element.name) +
                             " has no one list of integers named vertex_indices or vertex_index");
    }
    note_dropped(element, is_index_list);
    if (add == &PlyReader::add_face) mesh_.reserve_triangles(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!body_.begin_record()) return false;
      for (const PlyProperty& property : element.properties)
        if (!(is_index_list(property) ? read_indices(property) : skip(property))) return false;
      if (!body_.end_record()) return false;
      if (!check_indices(element)) return false;
      (this->*add)();
    }
    return true;
  }

  bool skip_element(const PlyElement& element) {
    if (element.count == 0) return true;
    mesh_.note("element " + element.name + " dropped");
    if (element.properties.empty()) return true;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!body_.begin_record()) return false;
      for (const PlyProperty& property : element.properties)
        if (!skip(property)) return false;
      if (!body_.end_record()) return false;
    }
    return true;
  }

  bool skip(const PlyProperty& property) {
    if (!property.is_list()) return body_.skip(property.type);
    std::uint64_t length = 0;
    return list_length(property, length) && body_.skip_items(property.type, length);
  }

  bool list_length(const PlyProperty& property, std::uint64_t& length) {
    std::int64_t stated = 0;
    if (!body_.integer(*property.count_type, stated)) return false;
    length = static_cast<std::uint64_t>(stated);
    if (stated >= 0 && body_.can_hold_list(length, property.type)) return true;
    return body_.fail_here("a list " + quote(property.name) + " claims " + std::to_string(stated) +
                           " items, more than the rest of the file can hold");
  }

  bool read_indices(const PlyProperty& property) {
    std::uint64_t length = 0;
    if (!list_length(property, length)) return false;
    indices_.resize(length);
    for (std::int64_t& index : indices_) {
      body_.begin_item();
      if (!body_.integer(property.type, index)) return false;
    }
    return true;
  }

  bool check_indices(const PlyElement& element) {
    const bool is_strip = element.name == "tristrips";
    for (std::int64_t index : indices_) {
      if (index >= 0 && static_cast<std::uint64_t>(index) < vertex_count_) continue;
      if (is_strip && index == -1) continue;
      return body_.fail_here("a face names vertex " + std::to_string(index) + ", but the vertices are 0 to " +
                             std::to_string(static_cast<std::int64_t>(vertex_count_) - 1));
    }
    return true;
  }

  void add_face() {
    polygon_.assign(indices_.begin(), indices_.end());
    mesh_.add_polygon(polygon_);
  }

  /// Every index after the second makes a triangle with the two before it, every other one turned round; -1
  /// starts the next strip.
  void add_strips() {
    std::size_t start = 0;
    for (std::size_t i = 0; i < indices_.size(); ++i) {
      if (indices_[i] == -1) start = i + 1;
      if (i < start + 2) continue;
      polygon_.assign(indices_.begin() + static_cast<std::ptrdiff_t>(i) - 2,
                      indices_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      if ((i - start) % 2 == 1) std::swap(polygon_[0], polygon_[1]);
      mesh_.add_polygon(polygon_);
    }
  }

  template <class IsRead>
  void note_dropped(const PlyElement& element, const IsRead& is_read) {
    const std::string names = names_of_dropped(element, is_read);
    if (!names.empty()) mesh_.note(element.name + " attributes dropped: " + names);
  }

  Body body_;
  const PlyHeader& header_;
  MeshBuilder mesh_;
  std::uint64_t vertex_count_ = 0;
  std::vector<std::int64_t> indices_;
  std::vector<std::uint32_t> polygon_;
};

}  // namespace

Result<MeshFile> parse_ply(std::span<const std::byte> bytes) {
  Result<PlyHeader> header = parse_ply_header(bytes);
  if (!header) return forward_error(header);
  if (!header->find("vertex")) return fail(ErrorCode::BadFile, "the PLY header declares no element vertex");
  switch (header->encoding) {
    case PlyEncoding::Ascii:
      return PlyReader(AsciiBody(bytes, *header), *header).read("PLY ascii");
    case PlyEncoding::BinaryLittleEndian:
      return PlyReader(BinaryBody(bytes, *header), *header).read("PLY binary little-endian");
    case PlyEncoding::BinaryBigEndian:
      break;
  }
  return PlyReader(BinaryBody(bytes, *header), *header).read("PLY binary big-endian");
}

}  // namespace selvage
