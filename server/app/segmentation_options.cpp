// SPDX-License-Identifier: MIT
#include "server/app/segmentation_options.h"

#include <charconv>
#include <map>
#include <string>

#include <CLI/CLI.hpp>

namespace selvage {
namespace {

constexpr const char* kGroup = "Segmentation";

/// "auto" or a count.
void set_region_count(const std::string& text, SegmentOptions& options) {
  options.target_regions = 0;
  if (text == "auto") return;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, options.target_regions);
  if (error != std::errc{} || stop != end) {
    throw CLI::ValidationError("--regions", "'" + text + "' is neither auto nor a number of regions");
  }
}

void add_sizes(CLI::App& command, SegmentOptions& options) {
  command
      .add_option_function<std::string>(
          "--regions", [&options](const std::string& text) { set_region_count(text, options); },
          "auto: as many as the shape has, on models above 20,000 triangles of 256 to 4096 vertices each; N: "
          "merge until N are left, whatever their size (xmrg, cad, mw99)")
      ->type_name("auto|N")
      ->default_str("auto")
      ->group(kGroup);
  command
      .add_option("--min-region", options.min_region_vertices,
                  "merge regions with fewer vertices; 0: 256 on models above 20,000 triangles, else 0.5 % of "
                  "the area (xmrg, cad) or 1 % of the vertices")
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option("--max-region", options.max_region_vertices,
                  "xmrg, cad: cut regions with more vertices; 0: 4096 on models above 20,000 triangles, else "
                  "none is too large")
      ->capture_default_str()
      ->group(kGroup);
}

}  // namespace

void add_segmentation_options(CLI::App& command, SegmentOptions& options) {
  const std::map<std::string, SegmentMode> modes = {{"xmrg", SegmentMode::Xmrg},
                                                    {"classic", SegmentMode::Classic},
                                                    {"zhang", SegmentMode::Zhang},
                                                    {"mw99", SegmentMode::ManganWhitaker},
                                                    {"cad", SegmentMode::Cad}};
  command
      .add_option("--mode", options.mode,
                  "how parts are found: xmrg (bending over a radius, watershed, hierarchy), cad (also at "
                  "sharp edges), classic (curvature and concaveness), zhang (curvature alone), mw99 (merging "
                  "by depth)")
      ->transform(CLI::CheckedTransformer(modes, CLI::ignore_case))
      ->default_str("xmrg")
      ->group(kGroup);
  add_sizes(command, options);
  command.add_flag("--smooth", options.smooth, "xmrg, cad: smooth the borders between regions")
      ->group(kGroup);
  command
      .add_option("--xmr", options.xmr_rings,
                  "classic, zhang, mw99: rings of the neighbourhood that curvature is taken on")
      ->check(CLI::Range(1, 5))
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option("--curvature-factor", options.thresholds.curvature_factor,
                  "classic: plateau below this share of the lowest curvature")
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option("--distance-factor", options.thresholds.distance_factor,
                  "classic: plateau below this share of the deepest concavity")
      ->capture_default_str()
      ->group(kGroup);
  command.add_flag("--prune", options.prune_branches, "classic: prune branches before regularisation")
      ->group(kGroup);
}

}  // namespace selvage
