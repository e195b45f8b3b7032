// SPDX-License-Identifier: MIT
#include "server/ingest/parts.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <utility>

#include "common/base/disjoint_sets.h"
#include "common/base/gathered.h"
#include "common/mesh_io/text_scanner.h"
#include "server/ingest/split_fans.h"

namespace selvage {
namespace {

std::string selectable(std::string name) {
  std::replace(name.begin(), name.end(), ',', '_');
  return name;
}

/// Numbers values 0, 1 ... in the order in which they come first.
class FirstUse {
 public:
  std::uint32_t operator()(std::int64_t value) {
    return number_of_.try_emplace(value, static_cast<std::uint32_t>(number_of_.size())).first->second;
  }
  const std::map<std::int64_t, std::uint32_t>& numbers() const { return number_of_; }

 private:
  std::map<std::int64_t, std::uint32_t> number_of_;
};

tl::unexpected<Error> wrong_count(std::size_t labels, const TriangleSoup& soup) {
  return fail(ErrorCode::BadFile, std::to_string(labels) + " labels, but the model has " +
                                      std::to_string(soup.triangles.size()) + " triangles and " +
                                      std::to_string(soup.positions.size()) +
                                      " vertices; state one label for each of either");
}

}  // namespace

Result<Parts> parts_of_groups(const MeshFile& file) {
  if (file.names.empty() || file.group_of_triangle.empty()) {
    return fail(ErrorCode::BadFile, "the file names no parts: it has no g, o or usemtl (only OBJ has them)");
  }
  Parts parts{.of_triangle = file.group_of_triangle, .of_vertex = {}, .parts_of_name = {}};
  std::set<std::uint32_t> is_object;  // names of groups and objects
  for (std::uint32_t part = 0; part < file.groups.size(); ++part) {
    std::vector<std::uint32_t> names = file.groups[part].groups;
    if (file.groups[part].object != kNone) names.push_back(file.groups[part].object);
    is_object.insert(names.begin(), names.end());
    for (std::uint32_t name : names) parts.parts_of_name[selectable(file.names[name])].push_back(part);
  }
  for (std::uint32_t part = 0; part < file.groups.size(); ++part) {
    const std::uint32_t name = file.groups[part].material;
    if (name == kNone) continue;
    const std::string prefix = is_object.contains(name) ? "usemtl " : "";
    parts.parts_of_name[selectable(prefix + file.names[name])].push_back(part);
  }
  for (auto& [name, list] : parts.parts_of_name) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return parts;
}

Parts parts_of_components(const TriangleSoup& soup) {
  DisjointSets sets(static_cast<std::uint32_t>(soup.positions.size()));
  for (const auto& [a, b, c] : soup.triangles) sets.merge(a, b), sets.merge(b, c);
  FirstUse number;
  Parts parts;
  for (const Triangle& t : soup.triangles) parts.of_triangle.push_back(number(sets.set_of(t[0])));
  for (const auto& [set, part] : number.numbers())
    parts.parts_of_name["component_" + std::to_string(part + 1)] = {part};
  return parts;
}

Result<Parts> parse_part_labels(std::span<const std::byte> bytes, const TriangleSoup& soup) {
  const std::size_t most = std::max(soup.triangles.size(), soup.positions.size());
  TextScanner scan(bytes, {.comment = '#'});
  FirstUse number;
  std::vector<std::uint32_t> labels;
  std::size_t count = 0;  // beyond `most` labels are counted for the message alone
  for (; !scan.at_end(); scan.next_line()) {
    for (; !scan.at_line_end(); ++count) {
      std::int64_t label = 0;
      if (!scan.integer(label)) return scan.fail_expecting("a label, which is an integer");
      if (count < most) labels.push_back(number(label));
    }
  }
  if (count != soup.triangles.size() && count != soup.positions.size()) return wrong_count(count, soup);
  Parts parts;
  (count == soup.triangles.size() ? parts.of_triangle : parts.of_vertex) = std::move(labels);
  for (const auto& [label, part] : number.numbers())
    parts.parts_of_name["label_" + std::to_string(label)] = {part};
  return parts;
}

Result<Parts> read_part_labels(const std::filesystem::path& path, const TriangleSoup& soup) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    return fail(ErrorCode::NotFound, path.string() + ": no such file of labels");
  std::ifstream in(path, std::ios::binary);
  std::vector<char> text(static_cast<std::size_t>(std::filesystem::file_size(path, error)));
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!in) return fail(ErrorCode::Io, path.string() + ": cannot be read");
  auto parts = parse_part_labels(std::as_bytes(std::span(text)), soup);
  if (!parts) return forward_error(parts, path.string());
  return parts;
}

RepairedMesh cut_along_parts(RepairedMesh mesh, std::span<const std::uint32_t> part_of_triangle) {
  const auto part_at = [&](CornerId c) { return part_of_triangle[mesh.source_of_triangle[triangle_of(c)]]; };
  std::vector<CornerId> opposite = mesh.table.opposite;
  for (CornerId c = 0; c < opposite.size(); ++c) {
    if (opposite[c] != kNone && part_at(c) != part_at(opposite[c])) opposite[c] = kNone;
  }
  SplitTable split = split_fans(std::move(mesh.table.vertex_of_corner), std::move(opposite));
  mesh.table = std::move(split.table);
  mesh.positions = gathered(mesh.positions, split.source_of_vertex);
  mesh.source_of_vertex = gathered(mesh.source_of_vertex, split.source_of_vertex);
  return mesh;
}

std::vector<std::uint32_t> parts_of_vertices(const RepairedMesh& mesh, const Parts& parts) {
  if (!parts.of_vertex.empty()) return gathered(parts.of_vertex, mesh.source_of_vertex);
  std::vector<std::uint32_t> part_of_vertex(mesh.table.vertex_count());
  for (CornerId c = 0; c < mesh.table.corner_count(); ++c)
    part_of_vertex[mesh.table.vertex(c)] = parts.of_triangle[mesh.source_of_triangle[triangle_of(c)]];
  return part_of_vertex;
}

}  // namespace selvage
