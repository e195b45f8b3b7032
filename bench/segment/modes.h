// SPDX-License-Identifier: MIT
//
// The segmentation modes by the names that the benchmarks' command lines and tables use.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/segment/segment.h"

namespace selvage::bench {

struct Mode {
  std::string name;
  SegmentOptions options;
  /// The options for a mesh of so many triangles: "streaming" depends on it.
  SegmentOptions for_triangles(std::uint32_t count) const;
};

/// "xmrg,classic-3": those, in the order of the full list; empty: all.
std::vector<Mode> chosen_modes(std::string_view names);

/// Applies settings of the form "tau=0.02" to every mode. False if one is malformed or unknown.
bool apply_settings(std::vector<Mode>& modes, const std::vector<std::string>& settings);

}  // namespace selvage::bench
