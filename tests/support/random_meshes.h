// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "common/mesh/corner_table.h"
#include "common/mesh/triangle_soup.h"

namespace selvage {

/// A 2-manifold with boundary that is as irregular as they come: several components of random genus, some
/// triangles cut out (holes, ragged borders, islands of one triangle), vertices split where that left two
/// fans.
struct RandomManifold {
  CornerTable table;
  std::vector<Vec3> positions;
};
RandomManifold random_manifold(std::uint32_t seed);

/// The table of any triangles, made manifold: vertices with several fans are split, one copy each.
RandomManifold split_fans(const TriangleSoup& soup);

}  // namespace selvage
