// SPDX-License-Identifier: MIT
//
// What a stitched mesh looks like from one moment to the next, for whoever keeps a copy: a renderer's
// buffers, another thread's mesh. Set the vertices, replace the patches, forget the removed vertices; the
// copy is then the mesh, whatever happened in between.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/triangle_soup.h"

namespace selvage {

/// Triangles that come and go together: the interior of a region, or the join between two or three.
struct PatchId {
  enum class Kind : std::uint8_t { Region, Join };
  Kind kind = Kind::Region;
  /// The region, or those that the join connects, highest first; kNone after the last.
  std::array<RegionId, 3> regions = {kNone, kNone, kNone};
  friend auto operator<=>(const PatchId&, const PatchId&) = default;
};

struct StitchUpdate {
  struct Vertex {
    VertexId id = 0;
    Vec3 position;  ///< model units
    RegionId region = 0;
    friend bool operator==(const Vertex&, const Vertex&) = default;
  };
  struct Patch {
    PatchId id;
    std::vector<Triangle> triangles;  ///< all that it has now; none if it is gone
  };

  std::vector<Vertex> vertices;            ///< new ones, and those that changed place; by id, each once
  std::vector<Patch> patches;              ///< those that changed; by id, each once
  std::vector<VertexId> removed_vertices;  ///< by id, each once; the numbers may be given out again later

  bool empty() const { return vertices.empty() && patches.empty() && removed_vertices.empty(); }
};

}  // namespace selvage
