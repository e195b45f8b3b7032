// SPDX-License-Identifier: MIT
//
// Models for benchmarks and training: read, repaired, cut into regions of a wanted size.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/ingest/repair.h"
#include "server/segment/partition.h"

namespace selvage::bench {

struct Model {
  std::string name;  ///< path below the folder it was found in
  RepairedMesh mesh;
};

/// Every mesh file under `folders`, in the order of their paths; files that are no valid mesh are left out
/// and named on stderr. `excluded` is a regular expression (ECMAScript) that a name must not match; empty
/// excludes nothing.
std::vector<Model> read_models(const std::vector<std::filesystem::path>& folders,
                               const std::string& excluded);

/// Regions of about `vertices` vertices: seeds spread over the mesh, every vertex to the seed nearest in
/// edges (breadth-first Voronoi). 0 leaves the mesh in one piece.
Partition voronoi_partition(const RepairedMesh& mesh, std::uint32_t vertices);

}  // namespace selvage::bench
