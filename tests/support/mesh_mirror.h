// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "client/stitch/stitch_update.h"

namespace selvage {

/// What somebody holds who knows nothing but the updates. Fails the test where one takes away what was not
/// there.
class MeshMirror {
 public:
  void apply(const StitchUpdate& update) {
    for (const auto& vertex : update.vertices) position_of_vertex_[vertex.id] = vertex.position;
    for (const auto& patch : update.patches) {
      if (patch.triangles.empty()) {
        EXPECT_EQ(triangles_of_patch_.erase(patch.id), 1u) << "a patch went that was not there";
      } else {
        triangles_of_patch_[patch.id] = patch.triangles;
      }
    }
    for (const VertexId id : update.removed_vertices) {
      EXPECT_EQ(position_of_vertex_.erase(id), 1u) << "a vertex went that was not there";
    }
  }

  /// Vertices in the order of their numbers.
  TriangleSoup soup() const {
    TriangleSoup soup;
    std::map<VertexId, VertexId> dense;
    for (const auto& [id, position] : position_of_vertex_) {
      dense.emplace(id, static_cast<VertexId>(dense.size()));
      soup.positions.push_back(position);
    }
    for (const auto& [id, triangles] : triangles_of_patch_) {
      for (Triangle triangle : triangles) {
        for (VertexId& v : triangle) v = dense.at(v);
        soup.triangles.push_back(triangle);
      }
    }
    return soup;
  }

 private:
  std::map<VertexId, Vec3> position_of_vertex_;
  std::map<PatchId, std::vector<Triangle>> triangles_of_patch_;
};

}  // namespace selvage
