// SPDX-License-Identifier: MIT
#include "common/mesh_io/mesh_builder.h"

#include <algorithm>

namespace selvage {

void MeshBuilder::reserve_vertices(std::uint64_t count) {
  file_.soup.positions.reserve(std::min(count, max_indices_));
}

void MeshBuilder::reserve_triangles(std::uint64_t count) {
  file_.soup.triangles.reserve(std::min(count, max_indices_ / 3));
}

void MeshBuilder::add_vertex(const Vec3& position) {
  if (file_.soup.positions.size() == max_indices_) is_over_limit_ = true;
  if (!is_over_limit_) file_.soup.positions.push_back(position);
}

void MeshBuilder::add_polygon(std::span<const std::uint32_t> corners) {
  if (corners.size() < 3) ++short_faces_;
  if (corners.size() > 3) ++file_.polygons;
  for (std::size_t k = 2; k < corners.size(); ++k) add_triangle({corners[0], corners[k - 1], corners[k]});
  if (has_names_) note_group();
}

std::uint32_t MeshBuilder::name_index(std::string_view name) {
  const auto found = index_of_name_.find(name);
  if (found != index_of_name_.end()) return found->second;
  const auto index = static_cast<std::uint32_t>(file_.names.size());
  file_.names.emplace_back(name);
  index_of_name_.emplace(name, index);
  return index;
}

void MeshBuilder::set_group(NamedGroup group) {
  if (!has_names_) note_group();  // what came before belongs to no name
  has_names_ = true;
  group_ = std::move(group);
  group_index_ = kNone;
}

void MeshBuilder::note_group() {
  const std::size_t triangles = file_.soup.triangles.size();
  if (triangles == file_.group_of_triangle.size()) return;
  if (group_index_ == kNone) {
    const auto next = static_cast<std::uint32_t>(file_.groups.size());
    const auto [it, is_new] =
        index_of_group_.try_emplace({group_.groups, group_.object, group_.material}, next);
    if (is_new) file_.groups.push_back(group_);
    group_index_ = it->second;
  }
  file_.group_of_triangle.resize(triangles, group_index_);
}

void MeshBuilder::add_triangle(const Triangle& triangle) {
  if (file_.soup.triangles.size() == max_indices_ / 3) is_over_limit_ = true;
  if (!is_over_limit_) file_.soup.triangles.push_back(triangle);
}

Result<MeshFile> MeshBuilder::finish(std::string format) && {
  if (is_over_limit_) {
    return fail(ErrorCode::LimitExceeded, "more than " + std::to_string(max_indices_) +
                                              " vertices or triangle corners in one mesh; split the model");
  }
  if (file_.soup.positions.empty()) return fail(ErrorCode::BadFile, "the mesh is empty: it has no vertices");
  if (file_.soup.triangles.empty()) {
    return fail(ErrorCode::BadFile,
                "the mesh is empty: " + std::to_string(file_.soup.positions.size()) +
                    " vertices, but no triangles (point clouds and lines cannot be used)");
  }
  if (file_.polygons > 0) {
    note(std::to_string(file_.polygons) + " polygons triangulated, each as a fan from its first corner");
  }
  if (short_faces_ > 0) note(std::to_string(short_faces_) + " faces with fewer than three corners left out");
  file_.format = std::move(format);
  return std::move(file_);
}

}  // namespace selvage
