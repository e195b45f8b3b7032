// SPDX-License-Identifier: MIT
//
// Feature extraction of the classic mode, dissertation Table 4.1, and the height map made of it: a vertex is
// plateau (height 1, a possible boundary between parts) or minimum (height 0, inside a part).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/parallel.h"
#include "common/mesh/corner_table.h"
#include "common/mesh/vec3.h"
#include "server/segment/components.h"

namespace selvage {

/// By vertex. Both are negative where a boundary may run.
struct Features {
  std::vector<double>
      curvature;  ///< integral Gaussian curvature, radians (eq. 4.1; the text allows it for 4.2)
  std::vector<double>
      distance;  ///< signed distance to the average plane, model units (eq. 4.7), turned outward
};

/// Measures every vertex on its XMR neighbourhood of level `rings` (1 = direct neighbours). Runs in parallel.
/// Values that are mere rounding become 0: on flat and developable surfaces Def. 4.5 would scale its
/// thresholds to them.
Features extract_features(const CornerTable& mesh, std::span<const Vec3> positions,
                          const Components& components, std::span<const ComponentShape> shapes, int rings,
                          const ParallelFor& parallel);

/// What counts as plateau. A factor multiplies the lowest value of the whole mesh; 0 gives Def. 4.3.
struct PlateauThresholds {
  double curvature_factor = 0.01;
  double distance_factor = 0.01;
  bool use_distance = true;  ///< false: Gaussian curvature alone [Zhang et al. 2002]
};

/// Def. 4.5: plateau if K < curvature_factor * min K or d_s < distance_factor * min d_s. By vertex, 1 =
/// plateau. The factor is brittle: .003 / .01 / .03 / .1 give a Rand error of .161 / .160 / .224 / .400 on
/// the benchmark.
std::vector<std::uint8_t> find_plateau(const Features& features, const PlateauThresholds& thresholds);

}  // namespace selvage
