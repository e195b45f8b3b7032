// SPDX-License-Identifier: MIT
//
// A model in about so many regions, at levels of 50, 25, 12.5 and 6.25 % of its triangles, and what mixes of
// them are like.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/mesh/corner_table.h"
#include "common/mesh/triangle_soup.h"
#include "server/segment/segment.h"
#include "server/simplify/levels.h"
#include "server/simplify/simplify.h"

namespace selvage::bench {

inline constexpr double kRatios[] = {0.5, 0.25, 0.125, 0.0625};
inline constexpr std::uint32_t kLevels = 5;

struct LabelledMesh {
  CornerTable table;
  std::vector<Vec3> positions;
  Segmentation segmentation;
  TriangleSoup finest;
};

/// Says on stderr what is wrong with the file.
std::optional<LabelledMesh> load_labelled(const std::string& path, std::uint32_t regions);

/// All levels, with these labels or none; `seconds` is CPU time.
Simplification simplified(const LabelledMesh& mesh, std::span<const RegionId> labels, double& seconds);

/// The whole model at one level.
TriangleSoup level_of(const LabelledMesh& mesh, const Simplification& run, std::size_t level);

struct MixOptions {
  int count = 32;
  int measured = 8;        ///< of them: distances take most of the time
  bool is_smooth = false;  ///< levels of neighbours differ by one at most
};
struct MixFigures {
  double largest_distance = 0;                  ///< two-sided Hausdorff distance, model units
  double mean_reversed = 0, most_reversed = 0;  ///< share of area of reversed boundary triangles, %
  int broken = 0;  ///< mixes that are no manifold, or have another topology than the finest mesh
};
/// Random mixes, the same ones at every call.
MixFigures measure_mixes(const LabelledMesh& mesh, const LevelledMesh& levels, const MixOptions& options);

}  // namespace selvage::bench
