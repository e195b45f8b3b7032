// SPDX-License-Identifier: MIT
#include "bench/simplify/layered/layered_levels.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include "common/base/parallel.h"
#include "common/mesh/grid.h"
#include "common/pack/pack.h"
#include "server/encode/model_encoder.h"
#include "server/encode/region_encoder.h"
#include "server/segment/partition.h"
#include "server/simplify/model_levels.h"

namespace selvage::bench {
namespace {

std::vector<LevelTarget> targets_of(const LabelledMesh& mesh) {
  std::vector<LevelTarget> targets;
  for (const double ratio : kRatios)
    targets.push_back({static_cast<std::uint32_t>(ratio * mesh.table.triangle_count())});
  return targets;
}

class Maker {
 public:
  Maker(const LabelledMesh& mesh, int bits) : mesh_(mesh), grid_(make_grid(mesh.positions, bits)) {
    const auto& segmentation = mesh.segmentation;
    std::vector<Vec3> grid_positions;
    for (const Vec3& p : mesh.positions) {
      positions_.push_back(grid_.quantise(p));
      const GridPoint& q = positions_.back();
      grid_positions.push_back({double(q.x), double(q.y), double(q.z)});
    }
    partition_ = make_partition(mesh.table, segmentation.region_of_vertex, segmentation.region_count);
    const auto targets = targets_of(mesh);
    levels_ =
        make_model_levels({mesh.table, positions_, segmentation.region_of_vertex, segmentation.region_count},
                          targets, serial_for());
    // The same run once more, for its collapses.
    run_ = simplify({mesh.table, grid_positions, segmentation.region_of_vertex}, targets);
    local_vertex_.resize(mesh.table.vertex_count(), kNone);
    local_triangle_.resize(mesh.table.triangle_count(), kNone);
  }

  LayeredModel make() {
    LayeredModel model;
    const EncodedModel encoded = encode(&levels_);
    EncodedModel one = encode(nullptr);
    model.one_level_bytes = assemble_pack(std::move(one.directory), one.parts).size();
    Directory directory = encoded.directory;
    model.alone_bytes = assemble_pack(std::move(directory), encoded.parts).size();
    split_collapses();
    std::size_t part =
        encoded.directory.regions[0].levels.size() + (encoded.directory.regions[0].bundle_triangles > 0);
    for (RegionId id = 1; id <= partition_.region_count; ++id) {
      const RegionEntry& entry = encoded.directory.regions[id];
      LayeredRegion region = make_region(id, entry, model);
      for (std::size_t level = kLevels; level-- > 0;) {
        if (!entry.levels[level].is_repeat) region.alone[level] = encoded.parts[part++];
      }
      part += entry.bundle_triangles > 0;
      model.vertices += region.finest.vertex_count();
      model.regions.push_back(std::move(region));
    }
    for (LayeredRegion& region : model.regions) borrow_loops(region);
    return model;
  }

 private:
  EncodedModel encode(const LevelledMesh* levels) const {
    const std::vector<VertexId> no_sources;
    const std::vector<bool> is_turned(mesh_.table.triangle_count(), false);
    const ModelSource source{mesh_.table, mesh_.positions, no_sources, is_turned, partition_, false, levels};
    return encode_model(source, grid_, serial_for(), [] {}).value();
  }

  void split_collapses() {
    const auto& region_of_vertex = mesh_.segmentation.region_of_vertex;
    collapses_.resize(partition_.region_count + 1);
    ends_.assign(partition_.region_count + 1, {});
    std::uint32_t done = 0;
    for (const SimplifiedLevel& level : run_.levels) {
      for (; done < level.collapses; ++done)
        collapses_[region_of_vertex[run_.collapses[done].from]].push_back(run_.collapses[done]);
      for (RegionId id = 0; id < ends_.size(); ++id)
        ends_[id].push_back(static_cast<std::uint32_t>(collapses_[id].size()));
    }
  }

  /// Of one level, numbered by the level's own lists.
  RegionSource cut_out(RegionId id, std::size_t level) {
    const auto& representative = levels_.representative_of_vertex[level];
    const RegionLevel& cut_level = levels_.regions[level][id];
    for (std::uint32_t i = 0; i < cut_level.vertices.size(); ++i) local_vertex_[cut_level.vertices[i]] = i;
    for (std::uint32_t i = 0; i < cut_level.triangles.size(); ++i)
      local_triangle_[cut_level.triangles[i]] = i;
    RegionSource cut;
    for (const TriangleId t : cut_level.triangles) {
      for (CornerId c = 3 * t; c < 3 * t + 3; ++c) {
        cut.table.vertex_of_corner.push_back(local_vertex_[representative[mesh_.table.vertex(c)]]);
        const CornerId across = corner_across(mesh_.table, representative, c);
        const std::uint32_t local = across == kNone ? kNone : local_triangle_[triangle_of(across)];
        cut.table.opposite.push_back(local == kNone ? kNone : 3 * local + across % 3);
      }
    }
    cut.table.set_corner_of_vertex(static_cast<std::uint32_t>(cut_level.vertices.size()));
    for (const VertexId v : cut_level.vertices) cut.positions.push_back(positions_[v]);
    for (const TriangleId t : cut_level.triangles) local_triangle_[t] = kNone;
    return cut;
  }

  LayeredRegion make_region(RegionId id, const RegionEntry& entry, LayeredModel& model) {
    LayeredRegion region;
    const RegionSource finest = cut_out(id, 0);
    region.finest = finest.table;
    region.positions = finest.positions;
    region.loop_lengths = entry.loop_lengths;
    const EncodedRegion encoded = encode_region(finest);
    for (const VertexId v : encoded.loops.vertices)
      region.vertex_of_boundary.push_back(encoded.source_of_vertex[v]);
    const auto& vertices = levels_.regions[0][id].vertices;
    std::vector<Collapse> collapses = collapses_[id];
    for (Collapse& collapse : collapses)
      collapse.from = local_vertex_[collapse.from], collapse.to = local_vertex_[collapse.to];
    for (std::size_t level = 0; level < kLevels; ++level) {
      const RegionLevel& of_level = levels_.regions[level][id];
      region.sizes.push_back({static_cast<std::uint32_t>(of_level.vertices.size()),
                              static_cast<std::uint32_t>(of_level.triangles.size()), of_level.dropped_bits});
      region.representative.emplace_back();
      for (const VertexId v : vertices)
        region.representative.back().push_back(local_vertex_[levels_.representative_of_vertex[level][v]]);
      region.alone_limits.push_back({entry.levels[level].vertices, entry.levels[level].triangles,
                                     entry.box_min, entry.box_max, std::nullopt, std::nullopt});
      if (level > 0) region.alone_limits.back().coarse = CoarseLevel{{}, entry.levels[level].dropped_bits};
    }
    region.alone.resize(kLevels);
    for (std::size_t level = kLevels - 1; level-- > 0;) {
      int& dropped = region.sizes[level].dropped_bits;
      const int coarser = region.sizes[level + 1].dropped_bits;
      model.refined_precisions += dropped > coarser;
      dropped = std::min(dropped, coarser);
    }
    region.layers = plan_layers(region.finest, collapses, ends_[id]);
    make_base(id, region, entry);
    return region;
  }

  void make_base(RegionId id, LayeredRegion& region, const RegionEntry& entry) {
    const std::vector<VertexId> finest_of_vertex = [&] {
      std::vector<VertexId> finest;  // by the coarsest level's own list
      for (const VertexId v : levels_.regions[kLevels - 1][id].vertices) finest.push_back(local_vertex_[v]);
      return finest;
    }();
    RegionSource cut = cut_out(id, kLevels - 1);
    std::vector<VertexId> coarse_of_finest(region.finest.vertex_count(), kNone);
    for (VertexId v = 0; v < finest_of_vertex.size(); ++v) coarse_of_finest[finest_of_vertex[v]] = v;
    std::vector<VertexId> vertex_of_boundary;
    for (const VertexId v : region.vertex_of_boundary)
      vertex_of_boundary.push_back(coarse_of_finest[region.representative.back()[v]]);
    const int dropped = region.sizes.back().dropped_bits;
    cut.coarse =
        CoarseSource{region.loop_lengths, vertex_of_boundary, {entry.box_min, entry.box_max}, dropped};
    EncodedRegion encoded = encode_region(cut);
    region.base = std::move(encoded.bytes);
    region.base_limits = {region.sizes.back().vertices,
                          region.sizes.back().triangles,
                          entry.box_min,
                          entry.box_max,
                          std::nullopt,
                          CoarseLevel{region.loop_lengths, dropped}};
    region.base_mesh = decode_region(region.base, region.base_limits).value();
    for (const VertexId v : encoded.source_of_vertex) region.source_of_base.push_back(finest_of_vertex[v]);
    find_corners(region);
  }

  /// Which of the finest region's corners each of the base's is: triangles are known by their corners'
  /// vertices.
  static void find_corners(LayeredRegion& region) {
    std::map<Triangle, CornerId> first_corner;
    const CornerTable& coarse = region.layers.back().coarse;
    for (CornerId c = 0; c < coarse.corner_count(); ++c) {
      if (coarse.vertex(c) != kNone)
        first_corner[{coarse.vertex(c), coarse.vertex(next(c)), coarse.vertex(prev(c))}] = c;
    }
    for (Triangle triangle : region.base_mesh.triangles) {
      for (VertexId& v : triangle) v = region.source_of_base[v];
      for (int i = 0; i < 3; ++i) {
        region.corner_of_base.push_back(first_corner.at(triangle));
        std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
      }
    }
  }

  static void borrow_loops(LayeredRegion& region) {
    region.base_limits.coarse->finest_loop_lengths = region.loop_lengths;
    for (std::size_t level = 1; level < kLevels; ++level)
      region.alone_limits[level].coarse->finest_loop_lengths = region.loop_lengths;
  }

  const LabelledMesh& mesh_;
  Grid grid_;
  std::vector<GridPoint> positions_;
  Partition partition_;
  LevelledMesh levels_;
  Simplification run_;
  std::vector<std::vector<Collapse>> collapses_;  // by region, in the model's numbers
  std::vector<std::vector<std::uint32_t>> ends_;  // by region, by level
  std::vector<std::uint32_t> local_vertex_, local_triangle_;
};

}  // namespace

LayeredModel make_layered_model(const LabelledMesh& mesh, int bits) { return Maker(mesh, bits).make(); }

}  // namespace selvage::bench
