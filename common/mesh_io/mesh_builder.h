// SPDX-License-Identifier: MIT
//
// Where every reader puts what it finds: triangulates polygons, counts what deserves a note, keeps the index
// limit, and refuses a mesh that came out empty. Coordinates are finite and indices in range before they get
// here.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>

#include "common/base/result.h"
#include "common/mesh_io/mesh_file.h"

namespace selvage {

class MeshBuilder {
 public:
  /// Corners of triangles, and vertices, in one mesh: the index spaces are 32-bit and kNone is one of them.
  static constexpr std::uint64_t kMaxIndices = std::uint64_t{1} << 31;

  explicit MeshBuilder(std::uint64_t max_indices = kMaxIndices) : max_indices_(max_indices) {}

  /// For counts that were already checked against the bytes that back them.
  void reserve_vertices(std::uint64_t count);
  void reserve_triangles(std::uint64_t count);

  void add_vertex(const Vec3& position);
  /// A fan from the first corner. Fewer than three corners make no triangle, only a note.
  void add_polygon(std::span<const std::uint32_t> corners);
  /// The polygons that follow belong to it. Groups that are stated again, with the same names, are the same.
  void set_group(NamedGroup group);
  /// The number by which groups refer to a name.
  std::uint32_t name_index(std::string_view name);
  void note(std::string line) { file_.notes.push_back(std::move(line)); }

  std::uint64_t vertex_count() const { return file_.soup.positions.size(); }
  /// For readers that move or turn what they added (the transforms of VRML).
  TriangleSoup& soup() { return file_.soup; }

  /// The finished file. Fails when there is nothing to show, or too much.
  Result<MeshFile> finish(std::string format) &&;

 private:
  void add_triangle(const Triangle& triangle);
  void note_group();  ///< the triangles added since the last call belong to group_

  std::uint64_t max_indices_;
  MeshFile file_;
  std::map<std::string, std::uint32_t, std::less<>> index_of_name_;
  std::map<std::tuple<std::vector<std::uint32_t>, std::uint32_t, std::uint32_t>, std::uint32_t>
      index_of_group_;
  NamedGroup group_;                   ///< of the polygons that follow
  std::uint32_t group_index_ = kNone;  ///< of group_ in the file; kNone until it has a triangle
  bool has_names_ = false;
  std::uint64_t short_faces_ = 0;
  bool is_over_limit_ = false;
};

}  // namespace selvage
