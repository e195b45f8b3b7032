// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/mesh/corner_table.h"
#include "server/segment/segmentation.h"

namespace selvage {

/// A mesh as segmentation takes it.
struct TestMesh {
  CornerTable table;
  std::vector<Vec3> positions;
};

/// Asserts that the soup is manifold.
TestMesh mesh_of(const TriangleSoup& soup);

/// Meshes of all kinds that repair may hand on: closed, open, with holes and handles, several components,
/// single triangles, pillows, triangles that share vertices without being neighbours.
std::vector<std::pair<std::string, TestMesh>> odd_meshes();

/// Labels 0..label_count-1, the same for the same seed everywhere.
std::vector<std::uint32_t> random_labels(std::size_t vertex_count, std::uint32_t label_count,
                                         std::uint32_t seed);

/// Empty, or what check_partition finds wrong with the segmentation.
std::string violation_of(const CornerTable& table, const Segmentation& segmentation);

}  // namespace selvage
