// SPDX-License-Identifier: MIT
#include "server/app/segmentation_options.h"

#include <map>
#include <string>

#include <CLI/CLI.hpp>

#include "common/app/cut_options.h"

namespace selvage {
namespace {

constexpr const char* kGroup = "Segmentation";

void add_sizes(CLI::App& command, SegmentOptions& options) {
  add_region_count_option(
      command, options.target_regions,
      "auto: as many as the shape has; for streaming, on models above 20,000 triangles, of 384 to 4096 "
      "vertices each; N: merge until N are left, whatever their size (xmrg, cad, mw99)")
      ->group(kGroup);
  command
      .add_option("--min-region", options.min_region_vertices,
                  "merge regions with fewer vertices; 0: for streaming, 384 on models above 20,000 "
                  "triangles, else 0.5 % of "
                  "the area (xmrg, cad) or 1 % of the vertices")
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option("--max-region", options.max_region_vertices,
                  "xmrg, cad: cut regions with more vertices; 0: for streaming, 4096 on models above 20,000 "
                  "triangles, else "
                  "none is too large")
      ->capture_default_str()
      ->group(kGroup);
}

/// --segment-by may take one value or two, so a MODEL right behind it is taken for the second.
void settle(SegmentationOptions& options) {
  std::vector<std::string>& by = options.by;
  if (by[0] != "labels" && by.size() == 2 && options.model.empty()) {
    options.model = by[1];
    by.pop_back();
  }
  if (options.model.empty()) throw CLI::RequiredError("MODEL");
  const bool is_known = by[0] == "shape" || by[0] == "groups" || by[0] == "components" || by[0] == "labels";
  if (!is_known || by.size() != (by[0] == "labels" ? 2u : 1u)) {
    throw CLI::ValidationError("--segment-by", "write shape, groups, components, or labels FILE");
  }
}

}  // namespace

void SegmentationOptions::add_to(CLI::App& command) {
  const std::map<std::string, SegmentMode> modes = {{"xmrg", SegmentMode::Xmrg},
                                                    {"classic", SegmentMode::Classic},
                                                    {"zhang", SegmentMode::Zhang},
                                                    {"mw99", SegmentMode::ManganWhitaker},
                                                    {"cad", SegmentMode::Cad}};
  command.add_option("MODEL", model, "mesh: .ply .obj .off .stl .wrl .om");
  command
      .add_option(
          "--segment-by", by,
          "shape: parts that a person would see; groups: what the file's author named (OBJ g, o, usemtl); "
          "components: connected pieces; labels FILE: an integer a triangle, or a vertex. All but shape "
          "give names to ask for, and keep every triangle of a part in it")
      ->expected(1, 2)
      ->type_name("shape|groups|components|labels FILE")
      ->default_str("shape")
      ->group(kGroup);
  command.parse_complete_callback([this] { settle(*this); });
  command
      .add_option("--mode", segment.mode,
                  "how parts are found: xmrg (bending over a radius, watershed, hierarchy), cad (also at "
                  "sharp edges), classic (curvature and concaveness), zhang (curvature alone), mw99 (merging "
                  "by depth)")
      ->transform(CLI::CheckedTransformer(modes, CLI::ignore_case))
      ->default_str("xmrg")
      ->group(kGroup);
  add_sizes(command, segment);
  command.add_flag("--smooth", segment.smooth, "xmrg, cad: smooth the borders between regions")
      ->group(kGroup);
  command
      .add_option("--xmr", segment.xmr_rings,
                  "classic, zhang, mw99: rings of the neighbourhood that curvature is taken on")
      ->check(CLI::Range(1, 5))
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option("--curvature-factor", segment.thresholds.curvature_factor,
                  "classic: plateau below this share of the lowest curvature")
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option("--distance-factor", segment.thresholds.distance_factor,
                  "classic: plateau below this share of the deepest concavity")
      ->capture_default_str()
      ->group(kGroup);
  command.add_flag("--prune", segment.prune_branches, "classic: prune branches before regularisation")
      ->group(kGroup);
}

Result<Parts> SegmentationOptions::load_parts(const MeshFile& file) const {
  if (by[0] == "components") return parts_of_components(file.soup);
  if (by[0] == "labels") return read_part_labels(by[1], file.soup);
  if (by[0] != "groups") return Parts{};
  auto parts = parts_of_groups(file);
  if (!parts) return forward_error(parts, model.string());
  return parts;
}

}  // namespace selvage
