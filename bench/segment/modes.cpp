// SPDX-License-Identifier: MIT
#include "bench/segment/modes.h"

#include <cstdlib>
#include <map>

namespace selvage::bench {
namespace {

std::vector<Mode> all_modes() {
  std::vector<Mode> modes = {{"xmrg", {}}, {"streaming", {}}, {"cad", {.mode = SegmentMode::Cad}}};
  for (int rings : {1, 2, 3, 5}) {
    modes.push_back({"classic-" + std::to_string(rings), {.mode = SegmentMode::Classic, .xmr_rings = rings}});
  }
  modes.push_back({"zhang", {.mode = SegmentMode::Zhang}});
  modes.push_back({"mw99", {.mode = SegmentMode::ManganWhitaker}});
  return modes;
}

/// What --set NAME=VALUE may change. False if there is no such name.
bool set_option(SegmentOptions& options, const std::string& name, double value) {
  const std::map<std::string, double*> knobs = {{"rho", &options.height.radius_share},
                                                {"spacing", &options.height.sample_spacing},
                                                {"tau", &options.basins.plateau_depth},
                                                {"gap", &options.basins.gap},
                                                {"eps", &options.hierarchy.flat_border},
                                                {"cap", &options.hierarchy.deepest},
                                                {"min-area", &options.hierarchy.min_area_share},
                                                {"stop", &options.stop_saliency},
                                                {"delta-k", &options.thresholds.curvature_factor},
                                                {"delta-d", &options.thresholds.distance_factor}};
  if (const auto knob = knobs.find(name); knob != knobs.end()) return *knob->second = value, true;
  if (name == "smooth") return options.smooth = value != 0, true;
  if (name == "prune") return options.prune_branches = value != 0, true;
  if (name == "regions") return options.target_regions = static_cast<std::uint32_t>(value), true;
  return false;
}

}  // namespace

SegmentOptions Mode::for_triangles(std::uint32_t count) const {
  return name == "streaming" ? with_streaming_sizes(options, count) : options;
}

std::vector<Mode> chosen_modes(std::string_view names) {
  std::vector<Mode> modes;
  for (Mode& mode : all_modes()) {
    const bool is_named = ("," + std::string(names) + ",").find("," + mode.name + ",") != std::string::npos;
    if (names.empty() || is_named) modes.push_back(std::move(mode));
  }
  return modes;
}

bool apply_settings(std::vector<Mode>& modes, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) return false;
    for (Mode& mode : modes) {
      if (!set_option(mode.options, setting.substr(0, equals), std::atof(setting.c_str() + equals + 1)))
        return false;
    }
  }
  return true;
}

}  // namespace selvage::bench
