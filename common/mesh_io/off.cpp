// SPDX-License-Identifier: MIT
#include "common/mesh_io/off.h"

#include <optional>
#include <string>
#include <vector>

#include "common/mesh_io/mesh_builder.h"
#include "common/mesh_io/text_scanner.h"

namespace selvage {
namespace {

using Failure = std::optional<tl::unexpected<Error>>;

struct Counts {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
};

/// "STC4NOFF": texture coordinates, colours, normals, and more dimensions than three.
std::string_view prefix_of(std::string_view keyword) { return keyword.substr(0, keyword.size() - 3); }

Failure read_keyword(TextScanner& scan, MeshBuilder& mesh) {
  if (scan.at_end()) return scan.fail_here("the file is empty");
  const std::string_view keyword = scan.peek();
  if (!is_off_keyword(keyword))
    return scan.fail_expecting("OFF (or COFF, NOFF, STOFF) at the start of the file");
  scan.word();
  const std::string_view prefix = prefix_of(keyword);
  if (prefix.find_first_of("4n") != prefix.npos) {
    return scan.fail_here(std::string(keyword) + ": only three dimensions can be read",
                          ErrorCode::Unsupported);
  }
  if (scan.peek() == "BINARY") {
    return scan.fail_here("binary OFF cannot be read; convert the file to text OFF or PLY",
                          ErrorCode::Unsupported);
  }
  if (!prefix.empty()) mesh.note("vertex attributes dropped (" + std::string(keyword) + ")");
  return std::nullopt;
}

/// The number of edges is often wrong or missing, and of no use.
Failure read_counts(TextScanner& scan, Counts& counts) {
  std::int64_t vertices = 0, faces = 0;
  scan.at_end();
  if (!scan.integer(vertices) || vertices < 0) return scan.fail_expecting("the number of vertices");
  scan.at_end();
  if (!scan.integer(faces) || faces < 0) return scan.fail_expecting("the number of faces");
  std::int64_t edges = 0;
  if (!scan.at_line_end() && !scan.integer(edges)) return scan.fail_expecting("the number of edges");
  if (!scan.at_line_end()) return scan.fail_expecting("the end of the line");
  counts = {static_cast<std::uint64_t>(vertices), static_cast<std::uint64_t>(faces)};
  const std::uint64_t most = (scan.left() + 1) / 6;  // "0 0 0\n" or longer, and the last line needs no end
  if (counts.vertices <= most && counts.faces <= most - counts.vertices) return std::nullopt;
  return scan.fail_here("the header declares " + std::to_string(vertices) + " vertices and " +
                        std::to_string(faces) +
                        " faces, more than the rest of the file can hold; is it cut short?");
}

Failure read_vertices(TextScanner& scan, const Counts& counts, MeshBuilder& mesh) {
  mesh.reserve_vertices(counts.vertices);
  bool has_extras = false;
  for (std::uint64_t i = 0; i < counts.vertices; ++i) {
    scan.at_end();
    Vec3 position;
    for (int axis = 0; axis < 3; ++axis)
      if (!scan.coordinate(position[axis])) return scan.fail_expecting("a finite coordinate");
    has_extras = has_extras || !scan.at_line_end();
    scan.next_line();
    mesh.add_vertex(position);
  }
  if (has_extras) mesh.note("values after the vertices' coordinates dropped (colours, normals ...)");
  return std::nullopt;
}

Failure read_corner(TextScanner& scan, std::uint64_t vertex_count, std::uint32_t& index) {
  std::int64_t stated = 0;
  if (!scan.integer(stated)) return scan.fail_expecting("a vertex index");
  if (stated < 0 || static_cast<std::uint64_t>(stated) >= vertex_count) {
    return scan.fail_here("a face names vertex " + std::to_string(stated) + ", but the file declares " +
                          std::to_string(vertex_count) + ", counted from 0");
  }
  index = static_cast<std::uint32_t>(stated);
  return std::nullopt;
}

Failure read_faces(TextScanner& scan, const Counts& counts, MeshBuilder& mesh) {
  mesh.reserve_triangles(counts.faces);
  std::vector<std::uint32_t> polygon;
  bool has_extras = false;
  for (std::uint64_t i = 0; i < counts.faces; ++i) {
    scan.at_end();
    std::int64_t corners = 0;
    if (!scan.integer(corners) || corners < 0) return scan.fail_expecting("the number of a face's corners");
    if (static_cast<std::uint64_t>(corners) > scan.left()) {
      return scan.fail_here("a face claims " + std::to_string(corners) +
                            " corners, more than the rest of the file holds");
    }
    polygon.resize(static_cast<std::size_t>(corners));
    for (std::uint32_t& index : polygon)
      if (auto failure = read_corner(scan, counts.vertices, index)) return failure;
    has_extras = has_extras || !scan.at_line_end();
    scan.next_line();
    mesh.add_polygon(polygon);
  }
  if (has_extras) mesh.note("values after the faces' corners dropped (colours)");
  return std::nullopt;
}

}  // namespace

bool is_off_keyword(std::string_view word) {
  return word.size() >= 3 && word.substr(word.size() - 3) == "OFF" &&
         prefix_of(word).find_first_not_of("STCN4n") == word.npos;
}

Result<MeshFile> parse_off(std::span<const std::byte> bytes) {
  TextScanner scan(bytes, {.comment = '#'});
  MeshBuilder mesh;
  Counts counts;
  if (auto failure = read_keyword(scan, mesh)) return *failure;
  if (auto failure = read_counts(scan, counts)) return *failure;
  if (auto failure = read_vertices(scan, counts, mesh)) return *failure;
  if (auto failure = read_faces(scan, counts, mesh)) return *failure;
  if (!scan.at_end()) return scan.fail_here("data after the last face that the header declares");
  return std::move(mesh).finish("OFF");
}

}  // namespace selvage
