// SPDX-License-Identifier: MIT
//
// The packs whose bytes are kept in tests/golden: made from given labels, because segmentation uses floating
// point.
#pragma once

#include <string>
#include <vector>

#include "common/mesh/triangle_soup.h"

namespace selvage {

struct GoldenPack {
  std::string name;  ///< of the file, without .selvage
  TriangleSoup soup;
  std::vector<std::uint32_t> labels;
  int bits;
  bool is_exact;
  std::vector<double> level_ratios = {};  ///< of levels beside the finest
};

/// Holes, handles, pieces, junctions, turned triangles, welds, exact positions and lists of values between them.
std::vector<GoldenPack> golden_packs();

}  // namespace selvage
