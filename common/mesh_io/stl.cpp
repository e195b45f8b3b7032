// SPDX-License-Identifier: MIT
#include "common/mesh_io/stl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "common/base/ids.h"
#include "common/coding/byte_io.h"
#include "common/mesh_io/mesh_builder.h"
#include "common/mesh_io/text_scanner.h"

namespace selvage {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kTriangleBytes = 50;

using Corner = std::array<float, 3>;

/// Gives equal corners equal numbers. An open-addressed table of vertex indices, at most half full; the
/// vertices themselves stay in the mesh.
class CornerWelder {
 public:
  explicit CornerWelder(MeshBuilder& mesh) : mesh_(mesh), slots_(1024, kNone) {}

  std::uint32_t index_of(const Corner& corner) {
    const Vec3 position{corner[0] + 0.0f, corner[1] + 0.0f, corner[2] + 0.0f};  // -0 becomes 0
    std::uint32_t& slot = slot_of(position);
    if (slot != kNone) return slot;
    const auto index = static_cast<std::uint32_t>(mesh_.vertex_count());
    slot = index;
    mesh_.add_vertex(position);
    if (2 * mesh_.vertex_count() > slots_.size()) grow();
    return index;
  }

 private:
  static std::uint64_t hash(const Vec3& p) {
    std::uint64_t h = 0;
    for (int axis = 0; axis < 3; ++axis) {
      h = (h ^ std::bit_cast<std::uint64_t>(p[axis])) * 0x9E3779B97F4A7C15u;
      h ^= h >> 32;
    }
    return h;
  }

  std::uint32_t& slot_of(const Vec3& position) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash(position) & mask;
    while (slots_[at] != kNone && !(mesh_.soup().positions[slots_[at]] == position)) at = (at + 1) & mask;
    return slots_[at];
  }

  void grow() {
    slots_.assign(2 * slots_.size(), kNone);
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) slot_of(mesh_.soup().positions[v]) = v;
  }

  MeshBuilder& mesh_;
  std::vector<std::uint32_t> slots_;
};

std::uint64_t stated_triangles(std::span<const std::byte> bytes) {
  return ByteReader(bytes.subspan(80, 4)).u32();
}

Result<MeshFile> parse_binary_stl(std::span<const std::byte> bytes) {
  if (bytes.size() < kHeaderBytes) {
    return fail(ErrorCode::BadFile,
                "neither an ascii STL (no word 'solid' at the start) nor a binary one (shorter than " +
                    std::to_string(kHeaderBytes) + " bytes)",
                bytes.size());
  }
  const std::uint64_t count = stated_triangles(bytes);
  const std::uint64_t held = (bytes.size() - kHeaderBytes) / kTriangleBytes;
  if (count != held) {
    return fail(ErrorCode::BadFile,
                "the STL header declares " + std::to_string(count) +
                    " triangles, but the file's size is that of " + std::to_string(held),
                80);
  }
  MeshBuilder mesh;
  mesh.reserve_triangles(count);
  CornerWelder welder(mesh);
  ByteReader in(bytes.subspan(kHeaderBytes));
  bool has_attributes = false;
  for (std::uint64_t i = 0; i < count; ++i) {
    in.take(12);  // the normal
    Triangle triangle;
    for (std::uint32_t& index : triangle) {
      const std::size_t offset = kHeaderBytes + in.offset();
      const Corner corner = {in.f32(), in.f32(), in.f32()};
      if (!std::all_of(corner.begin(), corner.end(), [](float c) { return std::isfinite(c); })) {
        return fail(ErrorCode::BadFile,
                    "a coordinate of triangle " + std::to_string(i) + " is not a finite number", offset);
      }
      index = welder.index_of(corner);
    }
    has_attributes = in.u16() != 0 || has_attributes;
    mesh.add_polygon(triangle);
  }
  mesh.note(has_attributes ? "face normals and attribute bytes dropped" : "face normals dropped");
  if (in.left() > 0) mesh.note(std::to_string(in.left()) + " bytes after the last triangle left out");
  return std::move(mesh).finish("STL binary");
}

/// facet normal x y z / outer loop / vertex x y z, three times / endloop / endfacet, until endsolid; several
/// solids may follow one another.
class AsciiStlReader {
 public:
  explicit AsciiStlReader(std::span<const std::byte> bytes) : scan_(bytes, {}), welder_(mesh_) {}

  Result<MeshFile> read() {
    while (!scan_.at_end()) {
      if (auto failure = read_solid()) return *failure;
    }
    mesh_.note("face normals dropped");
    return std::move(mesh_).finish("STL ascii");
  }

 private:
  using Failure = std::optional<tl::unexpected<Error>>;

  bool takes(std::string_view keyword) {
    scan_.at_end();
    if (!equals_ignoring_case(scan_.peek(), keyword)) return false;
    scan_.word();
    return true;
  }

  Failure read_solid() {
    if (!takes("solid")) return scan_.fail_expecting("solid");
    scan_.next_line();  // its name
    while (takes("facet")) {
      if (auto failure = read_facet()) return failure;
    }
    if (!takes("endsolid")) return scan_.fail_expecting("facet or endsolid");
    scan_.next_line();
    return std::nullopt;
  }

  Failure read_facet() {
    if (!takes("normal")) return scan_.fail_expecting("normal");
    for (int axis = 0; axis < 3; ++axis)  // not read: writers put nan here for a triangle without area
      if (scan_.word().empty()) return scan_.fail_expecting("a normal's component");
    if (!takes("outer") || !takes("loop")) return scan_.fail_expecting("outer loop");
    Triangle triangle;
    for (std::uint32_t& index : triangle)
      if (auto failure = read_vertex(index)) return failure;
    if (!takes("endloop")) return scan_.fail_expecting("endloop after three vertices");
    if (!takes("endfacet")) return scan_.fail_expecting("endfacet");
    mesh_.add_polygon(triangle);
    return std::nullopt;
  }

  Failure read_vertex(std::uint32_t& index) {
    if (!takes("vertex")) return scan_.fail_expecting("vertex");
    Corner corner;
    for (float& coordinate : corner)
      if (!scan_.coordinate(coordinate)) return scan_.fail_expecting("a finite coordinate");
    index = welder_.index_of(corner);
    return std::nullopt;
  }

  TextScanner scan_;
  MeshBuilder mesh_;
  CornerWelder welder_;
};

/// Binary files may begin with "solid" too, but then soon hold bytes that no text has.
bool looks_like_text(std::span<const std::byte> bytes) {
  const std::string_view start = as_text(bytes.first(std::min<std::size_t>(bytes.size(), 512)));
  const std::size_t word = start.find_first_not_of(" \t\r\n");
  return word != start.npos && equals_ignoring_case(start.substr(word, 5), "solid") &&
         start.find('\0') == start.npos;
}

}  // namespace

bool is_exact_binary_stl(std::span<const std::byte> bytes) {
  return bytes.size() >= kHeaderBytes && (bytes.size() - kHeaderBytes) % kTriangleBytes == 0 &&
         (bytes.size() - kHeaderBytes) / kTriangleBytes == stated_triangles(bytes);
}

Result<MeshFile> parse_stl(std::span<const std::byte> bytes) {
  if (!is_exact_binary_stl(bytes) && looks_like_text(bytes)) return AsciiStlReader(bytes).read();
  return parse_binary_stl(bytes);
}

}  // namespace selvage
