// SPDX-License-Identifier: MIT
//
// Colours for regions: far apart in hue from one number to the next, light enough for black lines and dark
// text.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh/triangle_soup.h"
#include "common/render/image.h"

namespace selvage {

/// Always the same colour for the same number, whatever else is in the picture. The loose pseudo-region is
/// grey.
Rgb colour_of_region(RegionId region);

using RegionPair = std::pair<RegionId, RegionId>;

/// Colours for regions 0 to count - 1 in which neighbours differ clearly: colour_of_region, except that the
/// higher number of a pair that would look alike gets another one. Pairs name regions below `count`.
std::vector<Rgb> colours_of_regions(std::uint32_t count, std::span<const RegionPair> neighbours);

/// The pairs of regions (lower, higher) that some triangle touches both of, sorted. Labels are by vertex.
std::vector<RegionPair> neighbouring_regions(std::span<const Triangle> triangles,
                                             std::span<const RegionId> region_of_vertex);

/// How a segmentation is drawn: triangles of one region in its colour, boundary triangles in a dark one of
/// their own, which on a fine mesh draws the border lines.
struct RegionPaint {
  std::vector<Rgb> colour_of_triangle;
  std::vector<RegionId> region_of_triangle;  ///< kNone for a boundary triangle
};
RegionPaint paint_regions(std::span<const Triangle> triangles, std::span<const RegionId> region_of_vertex,
                          std::span<const Rgb> colour_of_region, Rgb boundary_colour = {52, 52, 56});

}  // namespace selvage
