// SPDX-License-Identifier: MIT
#include "server/encode/model_encoder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "common/coding/entropy_decoder.h"
#include "common/mesh/boundary_loops.h"
#include "server/encode/bundle_encoder.h"
#include "server/encode/level_encoder.h"
#include "server/encode/part_limits.h"
#include "server/encode/region_encoder.h"

namespace selvage {
namespace {

/// Vertices by region in one array (region 0: the loose ones), and each vertex's place in its region.
struct VerticesByRegion {
  std::vector<VertexId> vertices;
  std::vector<std::uint32_t> begin;  ///< by region; one more at the end
  std::vector<std::uint32_t> local_of_vertex;

  std::span<const VertexId> of(RegionId region) const {
    return std::span(vertices).subspan(begin[region], begin[region + 1] - begin[region]);
  }
};

VerticesByRegion group_vertices(const Partition& partition) {
  VerticesByRegion grouped;
  grouped.begin.assign(partition.region_count + 2, 0);
  for (RegionId region : partition.region_of_vertex) ++grouped.begin[region + 1];
  std::partial_sum(grouped.begin.begin(), grouped.begin.end(), grouped.begin.begin());
  std::vector<std::uint32_t> filled(partition.region_count + 1, 0);
  grouped.vertices.resize(partition.region_of_vertex.size());
  grouped.local_of_vertex.resize(partition.region_of_vertex.size());
  for (VertexId v = 0; v < partition.region_of_vertex.size(); ++v) {
    const RegionId region = partition.region_of_vertex[v];
    grouped.local_of_vertex[v] = filled[region];
    grouped.vertices[grouped.begin[region] + filled[region]++] = v;
  }
  return grouped;
}

/// The triangles of each region's bundle: those whose highest region it is.
std::vector<std::vector<TriangleId>> group_boundary_triangles(const CornerTable& table,
                                                              const Partition& partition) {
  std::vector<std::vector<TriangleId>> bundles(partition.region_count + 1);
  for (TriangleId t : partition.boundary_triangles) {
    const auto [a, b, c] = table.triangle(t);
    const auto& region = partition.region_of_vertex;
    bundles[std::max({region[a], region[b], region[c]})].push_back(t);
  }
  return bundles;
}

/// The next float up, so that what is a bound stays one.
float above(double value) {
  const auto rounded = static_cast<float>(value);
  return rounded < value ? std::nextafter(rounded, std::numeric_limits<float>::infinity()) : rounded;
}

}  // namespace

class ModelEncoder::Impl {
 public:
  Impl(const ModelSource& source, const Grid& grid, const EncodeHooks& hooks)
      : source_(source),
        grid_(grid),
        hooks_(hooks),
        by_region_(group_vertices(source.partition)),
        weld_group_(find_weld_groups(source.table, source.source_of_vertex)),
        boundary_index_(source.positions.size(), kNone),
        boundary_vertices_(source.partition.region_count + 1),
        local_of_triangle_(source.table.triangle_count(), kNone) {
    for (RegionId region = 1; region <= source.partition.region_count; ++region) {
      const auto triangles = source.partition.triangles_of(region);
      for (TriangleId i = 0; i < triangles.size(); ++i) local_of_triangle_[triangles[i]] = i;
    }
  }

  Result<EncodedModel> encode(const LevelledMesh* levels, const ParallelFor& parallel,
                              const std::function<void()>& on_part_done) {
    if (auto ok = check_region_sizes(source_.table, source_.partition); !ok) return forward_error(ok);
    const std::uint32_t regions = source_.partition.region_count + 1;
    if (finest_.entries.empty()) {
      encode_finest(parallel, on_part_done);
    } else {
      for (std::uint32_t i = 0; i < 2 * regions; ++i) on_part_done();
    }
    EncodedModel model;
    std::vector<RegionEntry>& entries = model.directory.regions;
    entries = finest_.entries;
    std::vector<std::vector<Bytes>> level_parts(regions);
    for (RegionId region = 0; region < regions; ++region) {
      if (!entries[region].levels.empty()) level_parts[region].push_back(finest_.parts[region]);
    }
    if (levels != nullptr) encode_levels(*levels, parallel, on_part_done, entries, level_parts);
    for (RegionId region = 0; region < regions; ++region) {
      std::move(level_parts[region].rbegin(), level_parts[region].rend(), std::back_inserter(model.parts));
      if (entries[region].bundle_triangles > 0) model.parts.push_back(finest_.bundles[region]);
    }
    model.directory.connectivity_bytes = finest_.connectivity_bytes;
    model.directory.grid = grid_;
    model.directory.is_exact = source_.is_exact;
    model.directory.boundary_triangles =
        static_cast<std::uint32_t>(source_.partition.boundary_triangles.size());
    if (auto ok = check_parts(model.directory.regions, model.parts); !ok) return forward_error(ok);
    return model;
  }

 private:
  /// What no choice of levels changes, by region.
  struct Finest {
    std::vector<RegionEntry> entries;
    std::vector<Bytes> parts, bundles;
    std::uint64_t connectivity_bytes = 0;
  };

  void encode_finest(const ParallelFor& parallel, const std::function<void()>& on_part_done) {
    const std::uint32_t regions = source_.partition.region_count + 1;
    std::vector<RegionEntry>& entries = finest_.entries;
    entries.resize(regions);
    finest_.parts.resize(regions);
    finest_.bundles.resize(regions);
    std::vector<std::size_t> connectivity_sizes(regions, 0);
    parallel(regions, [&](std::size_t i) {
      const auto region = static_cast<RegionId>(i);
      if (!by_region_.of(region).empty())
        finest_.parts[i] = encode_one(region, entries[i], connectivity_sizes[i]);
      on_part_done();
    });
    finest_.connectivity_bytes =
        std::accumulate(connectivity_sizes.begin(), connectivity_sizes.end(), std::uint64_t{0});
    // Bundles name boundary vertices by index, so they wait for all regions.
    const auto bundles = group_boundary_triangles(source_.table, source_.partition);
    parallel(regions, [&](std::size_t i) {
      entries[i].bundle_triangles = static_cast<std::uint32_t>(bundles[i].size());
      if (!bundles[i].empty())
        finest_.bundles[i] = encode_joins(static_cast<RegionId>(i), bundles[i], entries);
      on_part_done();
    });
  }

  template <class Encoder>
  void note(const PartId& id, const Encoder& symbols) const {
    if (hooks_.on_symbols) hooks_.on_symbols(id, symbols.tokens(), symbols.plain_bits());
  }

  RegionSource cut_out(RegionId region) const {
    RegionSource cut;
    const auto vertices = by_region_.of(region);
    cut.positions.reserve(vertices.size());
    for (VertexId v : vertices) cut.positions.push_back(grid_.quantise(source_.positions[v]));
    if (source_.is_exact) {
      cut.grid = grid_;
      for (VertexId v : vertices) {
        const Vec3& p = source_.positions[v];
        cut.exact.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
      }
    }
    if (!weld_group_.empty()) {
      for (VertexId v : vertices) cut.weld_groups.push_back(weld_group_[v]);
    }
    if (region != kLooseRegion) cut_triangles(region, cut);
    cut.table.set_corner_of_vertex(static_cast<std::uint32_t>(vertices.size()));
    return cut;
  }

  void cut_triangles(RegionId region, RegionSource& cut) const {
    const auto triangles = source_.partition.triangles_of(region);
    cut.table.vertex_of_corner.reserve(3 * triangles.size());
    cut.table.opposite.reserve(3 * triangles.size());
    for (TriangleId t : triangles) {
      for (CornerId c = 3 * t; c < 3 * t + 3; ++c) {
        cut.table.vertex_of_corner.push_back(by_region_.local_of_vertex[source_.table.vertex(c)]);
        cut.table.opposite.push_back(local_corner(region, source_.table.opposite[c]));
      }
      cut.is_turned.push_back(source_.is_turned[t]);
    }
  }

  /// The region's own number for a corner across an edge; kNone where another region or nothing lies there.
  CornerId local_corner(RegionId region, CornerId across) const {
    if (across == kNone) return kNone;
    const TriangleId local = local_of_triangle_[triangle_of(across)];
    const bool is_inside =
        local != kNone && source_.partition.region_of_vertex[source_.table.vertex(across)] == region;
    return is_inside ? 3 * local + across % 3 : kNone;
  }

  /// Writes only what belongs to this region, so regions may run at once.
  Bytes encode_one(RegionId region, RegionEntry& entry, std::size_t& connectivity_size) {
    const RegionSource cut = cut_out(region);
    EntropyEncoder symbols;
    EncodedRegion encoded = encode_region(cut, hooks_.tables, hooks_.on_symbols ? &symbols : nullptr);
    note({PartKind::Region, region}, symbols);
    connectivity_size = encoded.connectivity_size;
    const auto vertices = by_region_.of(region);
    for (std::uint32_t index = 0; index < encoded.loops.vertices.size(); ++index) {
      const VertexId v = vertices[encoded.source_of_vertex[encoded.loops.vertices[index]]];
      boundary_index_[v] = index;
      boundary_vertices_[region].push_back(v);
    }
    entry.box_min = encoded.box.low;
    entry.box_max = encoded.box.high;
    entry.loop_lengths = std::move(encoded.loops.lengths);
    entry.levels.push_back({.vertices = cut.table.vertex_count(), .triangles = cut.table.triangle_count()});
    return std::move(encoded.bytes);
  }

  /// All levels but the finest, one after the other: each needs maps of the whole mesh.
  void encode_levels(const LevelledMesh& levels, const ParallelFor& parallel,
                     const std::function<void()>& on_part_done, std::vector<RegionEntry>& entries,
                     std::vector<std::vector<Bytes>>& level_parts) const {
    ModelSource source = source_;
    source.levels = &levels;
    for (std::size_t level = 1; level < levels.regions.size(); ++level) {
      const LevelEncoder encoder(source, grid_, weld_group_, level);
      parallel(entries.size() - 1, [&](std::size_t i) {
        const auto region = static_cast<RegionId>(i + 1);
        encode_level(encoder, levels, region, level, entries[region], level_parts[region]);
        on_part_done();
      });
    }
  }

  void encode_level(const LevelEncoder& encoder, const LevelledMesh& levels, RegionId region,
                    std::size_t level, RegionEntry& entry, std::vector<Bytes>& parts) const {
    const RegionLevel& source = levels.regions[level][region];
    LevelEntry coarse = entry.levels.back();
    coarse.is_repeat = true;
    if (!source.is_repeat || source.dropped_bits != coarse.dropped_bits) {
      EntropyEncoder symbols;
      Bytes bytes = encoder.encode(region, entry, boundary_vertices_[region], hooks_.tables,
                                   hooks_.on_symbols ? &symbols : nullptr);
      // Fewer bytes than any finer part, and enough of them to back the boundary map (docs/FORMAT.md).
      const bool is_worth_it = bytes.size() < parts.back().size() &&
                               entry.boundary_vertices() <= kMaxSymbolsPerByte * bytes.size();
      if (is_worth_it) {
        coarse = {.vertices = static_cast<std::uint32_t>(source.vertices.size()),
                  .triangles = static_cast<std::uint32_t>(source.triangles.size()),
                  .deviation = above(source.bound * grid_.step),
                  .dropped_bits = static_cast<std::uint8_t>(source.dropped_bits)};
        parts.push_back(std::move(bytes));
        note({PartKind::Region, region, static_cast<std::uint8_t>(level)}, symbols);
      }
    }
    entry.levels.push_back(coarse);
  }

  Bytes encode_joins(RegionId region, std::span<const TriangleId> triangles,
                     std::vector<RegionEntry>& entries) {
    std::vector<BoundaryTriangle> named;
    std::vector<RegionId> touched = {region};
    for (TriangleId t : triangles) {
      BoundaryTriangle triangle{{}, source_.is_turned[t]};
      for (CornerId k = 0; k < 3; ++k) {
        const VertexId v = source_.table.vertex(3 * t + k);
        triangle.corners[k] = {source_.partition.region_of_vertex[v], boundary_index_[v]};
        touched.push_back(triangle.corners[k].region);
      }
      named.push_back(triangle);
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    std::vector<BundleTopology::Region> topology;
    for (RegionId id : touched) topology.push_back({id, entries[id].loop_lengths});
    RangeEncoder symbols;
    Bytes bytes = encode_bundle(BundleTopology(std::move(topology)), named, hooks_.tables,
                                hooks_.on_symbols ? &symbols : nullptr);
    note({PartKind::Bundle, region}, symbols);
    touched.pop_back();
    entries[region].lower_neighbours = std::move(touched);
    return bytes;
  }

  const ModelSource source_;
  const Grid& grid_;
  const EncodeHooks hooks_;
  VerticesByRegion by_region_;
  std::vector<std::uint32_t> weld_group_;                 ///< by vertex; empty if nothing is welded
  std::vector<std::uint32_t> boundary_index_;             ///< by vertex; kNone inside a region
  std::vector<std::vector<VertexId>> boundary_vertices_;  ///< by region and boundary index
  std::vector<TriangleId> local_of_triangle_;             ///< by triangle; kNone for boundary triangles
  Finest finest_;                                         ///< without entries until it is encoded
};

ModelEncoder::ModelEncoder(const ModelSource& source, const Grid& grid, const EncodeHooks& hooks)
    : impl_(std::make_unique<Impl>(source, grid, hooks)) {}
ModelEncoder::~ModelEncoder() = default;

Result<EncodedModel> ModelEncoder::encode(const LevelledMesh* levels, const ParallelFor& parallel,
                                          const std::function<void()>& on_part_done) {
  return impl_->encode(levels, parallel, on_part_done);
}

/// Groups are numbered along the mesh's borders, so that those along the rim of a part differ by one from
/// each to the next; then come what copies lie inside.
std::vector<std::uint32_t> find_weld_groups(const CornerTable& table,
                                            std::span<const VertexId> source_of_vertex) {
  if (source_of_vertex.empty()) return {};
  const VertexId sources = *std::max_element(source_of_vertex.begin(), source_of_vertex.end()) + 1;
  std::vector<std::uint32_t> copies(sources, 0);
  for (VertexId source : source_of_vertex) ++copies[source];
  std::vector<std::uint32_t> group_of_source(sources, kNone), group_of_vertex(source_of_vertex.size(), kNone);
  std::uint32_t groups = 0;
  const auto add = [&](VertexId v) {
    const VertexId source = source_of_vertex[v];
    if (copies[source] < 2) return;
    if (group_of_source[source] == kNone) group_of_source[source] = groups++;
    group_of_vertex[v] = group_of_source[source];
  };
  for (VertexId v : find_boundary_loops(table).vertices) add(v);
  for (VertexId v = 0; v < source_of_vertex.size(); ++v) add(v);
  if (groups == 0) group_of_vertex.clear();
  return group_of_vertex;
}

Result<EncodedModel> encode_model(const ModelSource& source, const Grid& grid, const ParallelFor& parallel,
                                  const std::function<void()>& on_part_done, const EncodeHooks& hooks) {
  return ModelEncoder(source, grid, hooks).encode(source.levels, parallel, on_part_done);
}

}  // namespace selvage
