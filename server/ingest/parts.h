// SPDX-License-Identifier: MIT
//
// The user's own parts: what the author of a file named, its components, or labels from a file beside it. A
// model is then streamed by these parts instead of by its shape.
//
// Labels by triangle are exact: the mesh is cut along the borders between parts before it is segmented, so
// that every part keeps all its triangles. Both sides of a cut keep a copy of its vertices, on the one grid,
// and clients weld them as they weld what repair cut. Labels by vertex go through joins like any
// segmentation.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/mesh/triangle_soup.h"
#include "common/mesh_io/mesh_file.h"
#include "server/ingest/repair.h"

namespace selvage {

/// A part for every triangle or every vertex of a soup; neither of them: no parts.
struct Parts {
  std::vector<std::uint32_t> of_triangle;
  std::vector<std::uint32_t> of_vertex;
  std::map<std::string, std::vector<std::uint32_t>>
      parts_of_name;  ///< ascending; a part may have several names

  bool empty() const { return of_triangle.empty() && of_vertex.empty(); }
};

/// Triangles with the same `g`, `o` and `usemtl` are a part; each of these names stands for all parts that
/// have it. A material called like a group or object becomes "usemtl NAME". Commas, which separate names in a
/// selection, become '_'. BadFile if the file names nothing.
Result<Parts> parts_of_groups(const MeshFile& file);

/// Triangles connected by vertices of the file, called component_1, component_2 ... by first triangle.
Parts parts_of_components(const TriangleSoup& soup);

/// Integers separated by blanks or line ends, one a triangle (as the .seg files of the Princeton Segmentation
/// Benchmark) or one a vertex of the soup; one a triangle where both counts agree. Equal numbers are a part,
/// called label_N. BadFile states the line of what is no integer, or the counts that would fit.
Result<Parts> parse_part_labels(std::span<const std::byte> bytes, const TriangleSoup& soup);
/// The same from a file, whose name errors begin with.
Result<Parts> read_part_labels(const std::filesystem::path& path, const TriangleSoup& soup);

/// Opens every edge between triangles of different parts and splits the vertices there. `part_of_triangle` is
/// by the file's triangles. Linear time. The report stays repair's.
RepairedMesh cut_along_parts(RepairedMesh mesh, std::span<const std::uint32_t> part_of_triangle);

/// By vertex of a repaired mesh, which is cut along the parts if they are by triangle.
std::vector<std::uint32_t> parts_of_vertices(const RepairedMesh& mesh, const Parts& parts);

}  // namespace selvage
