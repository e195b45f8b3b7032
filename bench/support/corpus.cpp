// SPDX-License-Identifier: MIT
#include "bench/support/corpus.h"

#include <algorithm>
#include <cstdio>
#include <random>
#include <regex>

#include "common/mesh_io/read_mesh.h"
#include "server/ingest/spatial_order.h"
#include "server/segment/regularise.h"

namespace selvage::bench {
namespace {

std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_regular_file(folder)) return {folder};
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && is_mesh_file_name(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::uint32_t> nearest_seed(const CornerTable& table, std::vector<VertexId> seeds) {
  std::vector<std::uint32_t> seed_of_vertex(table.vertex_count(), 0);
  std::vector<bool> is_reached(table.vertex_count(), false);
  for (std::uint32_t i = 0; i < seeds.size(); ++i) {
    seed_of_vertex[seeds[i]] = i;
    is_reached[seeds[i]] = true;
  }
  const auto reach = [&](VertexId from, VertexId to) {
    if (is_reached[to]) return;
    is_reached[to] = true;
    seed_of_vertex[to] = seed_of_vertex[from];
    seeds.push_back(to);
  };
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const CornerId first = table.corner_of_vertex[seeds[i]];
    for (CornerId c = first; c != kNone;) {
      reach(seeds[i], table.vertex(next(c)));
      reach(seeds[i], table.vertex(prev(c)));
      c = table.swing_ccw(c);
      if (c == first) break;
    }
  }
  return seed_of_vertex;
}

}  // namespace

std::vector<Model> read_models(const std::vector<std::filesystem::path>& folders,
                               const std::string& excluded) {
  std::vector<Model> models;
  const std::regex pattern(excluded);
  for (const auto& folder : folders) {
    for (const auto& path : mesh_files(folder)) {
      const std::string name = path.lexically_relative(folder.parent_path()).string();
      if (!excluded.empty() && std::regex_search(name, pattern)) continue;
      const auto file = read_mesh(path);
      auto mesh = file ? repair(file->soup) : Result<RepairedMesh>(tl::unexpected(file.error()));
      if (!mesh) {
        std::fprintf(stderr, "left out: %s: %s\n", name.c_str(), mesh.error().message.c_str());
        continue;
      }
      models.push_back({name, spatially_ordered(std::move(*mesh))});
    }
  }
  return models;
}

Partition voronoi_partition(const RepairedMesh& mesh, std::uint32_t vertices) {
  const std::uint32_t count = mesh.table.vertex_count();
  std::vector<std::uint32_t> labels(count, 0);
  if (vertices > 0 && count > vertices) {
    std::mt19937 random(1);
    std::vector<VertexId> seeds;
    for (std::uint32_t i = 0; i < (count + vertices / 2) / vertices; ++i) seeds.push_back(random() % count);
    // One round towards the middle: seeds drawn at random make regions of very different sizes.
    labels = nearest_seed(mesh.table, seeds);
    std::vector<Vec3> middle(seeds.size());
    std::vector<double> members(seeds.size(), 0);
    for (VertexId v = 0; v < count; ++v) {
      middle[labels[v]] += mesh.positions[v];
      ++members[labels[v]];
    }
    for (std::size_t i = 0; i < seeds.size(); ++i) middle[i] = middle[i] * (1 / std::max(members[i], 1.0));
    std::vector<double> nearest(seeds.size(), 1e300);
    for (VertexId v = 0; v < count; ++v) {
      const double distance = length(mesh.positions[v] - middle[labels[v]]);
      if (distance < nearest[labels[v]]) nearest[labels[v]] = distance, seeds[labels[v]] = v;
    }
    labels = nearest_seed(mesh.table, seeds);
  }
  const Segmentation segmentation =
      regularise(mesh.table, labels, {.min_component_vertices = std::min(vertices, 256u)}, mesh.positions);
  return make_partition(mesh.table, segmentation.region_of_vertex, segmentation.region_count);
}

}  // namespace selvage::bench
