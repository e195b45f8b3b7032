// SPDX-License-Identifier: MIT
//
// Where every reader puts what it finds: triangulates polygons, counts what deserves a note, keeps the index
// limit, and refuses a mesh that came out empty. Coordinates are finite and indices in range before they get
// here.
#pragma once

#include <cstdint>
#include <span>
#include <string>

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
  void note(std::string line) { file_.notes.push_back(std::move(line)); }

  std::uint64_t vertex_count() const { return file_.soup.positions.size(); }
  /// For readers that move or turn what they added (the transforms of VRML).
  TriangleSoup& soup() { return file_.soup; }

  /// The finished file. Fails when there is nothing to show, or too much.
  Result<MeshFile> finish(std::string format) &&;

 private:
  void add_triangle(const Triangle& triangle);

  std::uint64_t max_indices_;
  MeshFile file_;
  std::uint64_t short_faces_ = 0;
  bool is_over_limit_ = false;
};

}  // namespace selvage
