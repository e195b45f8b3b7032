// SPDX-License-Identifier: MIT
//
// Would levels that build on one another take fewer bytes than levels that stand alone?
//
//   layered_bench MODEL...                40 regions, levels of 50, 25, 12.5 and 6.25 % of the triangles
//   layered_bench --regions 20 MODEL...
//
// On grids of 12 and 14 bits: bytes of the pack with five levels over those with one, as they are coded, and
// as an estimate of levels each coded with the next coarser one at hand (refinement_cost.h). The estimate
// leaves the coarsest level, joins, connectivity, boundary maps and the directory at what they take now. Its
// positions are held against the codec's own on the finest level, with nothing known.
#include <cmath>
#include <cstdio>
#include <mutex>
#include <string>

#include "bench/simplify/labelled_levels.h"
#include "bench/simplify/refinement_cost.h"
#include "common/base/parallel.h"
#include "common/pack/pack.h"
#include "server/encode/model_encoder.h"
#include "server/simplify/model_levels.h"

namespace selvage::bench {
namespace {

/// Of the parts of one level, bits.
struct CodedBits {
  double connectivity = 0, positions = 0, boundary_map = 0, bytes = 0;
};

struct Model {
  LabelledMesh mesh;
  Grid grid;
  std::vector<GridPoint> positions;
  Partition partition;
  LevelledMesh levels;
};

Model make_model(const LabelledMesh& mesh, int bits) {
  Model model{mesh, make_grid(mesh.positions, bits), {}, {}, {}};
  for (const Vec3& p : mesh.positions) model.positions.push_back(model.grid.quantise(p));
  const auto& segmentation = mesh.segmentation;
  model.partition = make_partition(mesh.table, segmentation.region_of_vertex, segmentation.region_count);
  std::vector<LevelTarget> targets;
  for (const double ratio : kRatios)
    targets.push_back({static_cast<std::uint32_t>(ratio * mesh.table.triangle_count())});
  model.levels = make_model_levels(
      {mesh.table, model.positions, segmentation.region_of_vertex, segmentation.region_count}, targets,
      serial_for());
  return model;
}

CodedBits sorted_bits(std::span<const Token> tokens, double plain_bits) {
  SymbolModels models(shipped_tables().region);
  CodedBits bits{.positions = plain_bits};
  for (const Token& token : tokens) {
    const double cost = kProbabilityBits - std::log2(models.range(token.model, token.symbol).frequency);
    models.update(token.model, token.symbol);
    using namespace region_model;
    const bool is_position = (token.model >= kMagnitude && token.model < kFields) || token.model == kExcess ||
                             token.model == kTangent;
    const bool is_map = token.model >= kMapLoop && token.model <= kMapExcess;
    (is_position ? bits.positions : is_map ? bits.boundary_map : bits.connectivity) += cost;
  }
  return bits;
}

/// Bytes of the pack, and the bits of each level's parts if asked for.
double pack_size(const Model& model, bool has_levels, std::vector<CodedBits>* levels) {
  const std::vector<VertexId> no_sources;
  const std::vector<bool> is_turned(model.mesh.table.triangle_count(), false);
  const ModelSource source{model.mesh.table,
                           model.mesh.positions,
                           no_sources,
                           is_turned,
                           model.partition,
                           false,
                           has_levels ? &model.levels : nullptr};
  EncodeHooks hooks;
  if (levels != nullptr) {
    levels->assign(kLevels, {});
    hooks.on_symbols = [&](const PartId& id, std::span<const Token> tokens, double plain_bits) {
      if (id.kind != PartKind::Region) return;
      const CodedBits bits = sorted_bits(tokens, plain_bits);
      CodedBits& sum = (*levels)[id.level];
      sum.connectivity += bits.connectivity;
      sum.positions += bits.positions;
      sum.boundary_map += bits.boundary_map;
    };
  }
  auto encoded = encode_model(
                     source, model.grid, serial_for(), [] {}, hooks)
                     .value();
  return static_cast<double>(assemble_pack(std::move(encoded.directory), encoded.parts).size());
}

/// A region at a level, for the coarser one that it is refined from; without one, for the codec's own task.
Refinement cut_out(const Model& model, RegionId region, std::uint32_t level, std::uint32_t coarser) {
  const auto& representative = model.levels.representative_of_vertex[level];
  const RegionLevel& fine = model.levels.regions[level][region];
  std::vector<std::uint32_t> local_vertex(model.positions.size(), kNone);
  std::vector<std::uint32_t> local_triangle(model.mesh.table.triangle_count(), kNone);
  for (std::uint32_t i = 0; i < fine.vertices.size(); ++i) local_vertex[fine.vertices[i]] = i;
  for (std::uint32_t i = 0; i < fine.triangles.size(); ++i) local_triangle[fine.triangles[i]] = i;
  Refinement cut;
  for (const TriangleId t : fine.triangles) {
    for (CornerId c = 3 * t; c < 3 * t + 3; ++c) {
      cut.table.vertex_of_corner.push_back(local_vertex[representative[model.mesh.table.vertex(c)]]);
      const CornerId across = corner_across(model.mesh.table, representative, c);
      const std::uint32_t local = across == kNone ? kNone : local_triangle[triangle_of(across)];
      cut.table.opposite.push_back(local == kNone ? kNone : 3 * local + across % 3);
    }
  }
  cut.table.set_corner_of_vertex(static_cast<std::uint32_t>(fine.vertices.size()));
  for (const VertexId v : fine.vertices) {
    const GridPoint& p = model.positions[v];
    cut.positions.push_back({double(p.x >> fine.dropped_bits), double(p.y >> fine.dropped_bits),
                             double(p.z >> fine.dropped_bits)});
    cut.representative.push_back(
        coarser < kLevels ? local_vertex[model.levels.representative_of_vertex[coarser][v]] : kNone);
  }
  return cut;
}

/// What the positions of a level take with a coarser one at hand, and all it takes to know which vertex is
/// which.
struct LayeredBits {
  RefinementBits refinement;
  double low_bits = 0;  ///< of the positions that the coarser level has
  double all(double alike) const {
    return refinement.kept_flags + refinement.targets + low_bits + refinement.positions / alike;
  }
};

LayeredBits layered_bits(const Model& model, std::uint32_t level, std::uint32_t coarser) {
  std::vector<Refinement> refined;
  LayeredBits bits;
  for (RegionId region = 1; region <= model.partition.region_count; ++region) {
    const RegionLevel &fine = model.levels.regions[level][region],
                      &coarse = model.levels.regions[coarser][region];
    if (level > 0 && fine.is_repeat) continue;
    refined.push_back(cut_out(model, region, level, coarser));
    bits.low_bits += 3.0 * std::max(0, coarse.dropped_bits - fine.dropped_bits) *
                     static_cast<double>(coarse.vertices.size());
  }
  bits.refinement = refinement_bits(refined);
  return bits;
}

/// The estimate's positions over the codec's, on the finest level with nothing known.
double likeness(const Model& model, const CodedBits& finest) {
  std::vector<Refinement> whole;
  for (RegionId region = 1; region <= model.partition.region_count; ++region)
    whole.push_back(cut_out(model, region, 0, kLevels));
  return refinement_bits(whole).positions / finest.positions;
}

void print(std::uint32_t level, const CodedBits& coded, const LayeredBits& layered, double alike) {
  const RefinementBits& bits = layered.refinement;
  std::printf(
      "  level %u, bits a vertex: connectivity %.2f, positions %.2f; layered: flags %.2f, targets %.2f, low "
      "bits "
      "%.2f, positions %.2f (%.2f a new one)\n",
      level, coded.connectivity / bits.vertices, coded.positions / bits.vertices,
      bits.kept_flags / bits.vertices, bits.targets / bits.vertices, layered.low_bits / bits.vertices,
      bits.positions / alike / bits.vertices, bits.positions / alike / bits.new_vertices);
}

void measure(const LabelledMesh& mesh, const std::string& name, int bits) {
  const Model model = make_model(mesh, bits);
  std::vector<CodedBits> coded;
  const double one = pack_size(model, false, nullptr), five = pack_size(model, true, &coded);
  const double alike = likeness(model, coded[0]);
  double layered = five;
  std::vector<LayeredBits> layers;
  for (std::uint32_t level = 0; level + 1 < kLevels; ++level) {
    layers.push_back(layered_bits(model, level, level + 1));
    layered -= (coded[level].positions - layers[level].all(alike)) / 8;
  }
  const double two_alone = coded[3].connectivity + coded[3].positions + coded[3].boundary_map;
  const double two_saved = coded[0].positions - layered_bits(model, 0, 3).all(alike);
  std::printf(
      "%s, %d bits, %u regions: over one level, five alone %.3f, layered %.3f; with 12.5 %% only, alone "
      "%.3f, layered "
      "%.3f; the estimate's positions over the codec's %.3f\n",
      name.c_str(), bits, model.partition.region_count, five / one, layered / one, 1 + two_alone / 8 / one,
      1 + (two_alone - two_saved) / 8 / one, alike);
  for (std::uint32_t level = 0; level + 1 < kLevels; ++level)
    print(level, coded[level], layers[level], alike);
  std::fflush(stdout);
}

}  // namespace
}  // namespace selvage::bench

int main(int argc, char** argv) {
  using namespace selvage::bench;
  std::uint32_t regions = 40;
  int models = 0;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--regions" && i + 1 < argc) {
      regions = static_cast<std::uint32_t>(std::stoul(argv[++i]));
      continue;
    }
    const auto mesh = load_labelled(argument, regions);
    if (!mesh) return 1;
    for (const int bits : {12, 14}) measure(*mesh, argument.substr(argument.find_last_of('/') + 1), bits);
    ++models;
  }
  return models > 0 ? 0 : (std::fprintf(stderr, "usage: layered_bench [--regions N] MODEL...\n"), 2);
}
