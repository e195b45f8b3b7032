// SPDX-License-Identifier: MIT
//
// Pictures of meshes without a graphics card: for the demo, the documentation, and looking at a segmentation.
// Made for millions of small triangles: one pass fills a depth buffer with triangle numbers, a second shades
// what is seen.
#pragma once

#include <span>

#include "common/base/ids.h"
#include "common/mesh/triangle_soup.h"
#include "common/render/camera.h"
#include "common/render/image.h"

namespace selvage {

/// What to draw; borrowed for the call. Any triangles will do: flat, degenerate, none at all.
struct Scene {
  std::span<const Vec3> positions;
  std::span<const Triangle> triangles;
  std::span<const Rgb> colour_of_triangle = {};       ///< empty: all in one light colour
  std::span<const RegionId> region_of_triangle = {};  ///< for labels; kNone is not labelled; empty: no labels
};

struct RenderOptions {
  Rgb background = kWhite;
  int samples = 3;             ///< per pixel and axis; edges get smoother and time grows with its square
  double crease_degrees = 35;  ///< surfaces that meet at less than this are shaded as one; 0 shows facets
  double border_px = 0;        ///< black lines between triangles of different colour; 0: none
  double wire_px = 0;          ///< dark lines along triangle edges; 0: none
  double label_px = 0;         ///< height of region numbers; they shrink where room is short; 0: none
};

/// The same input gives the same picture. Memory: 8 bytes a sample and about 40 a triangle.
Image render(const Scene& scene, const Camera& camera, const RenderOptions& options = {});

}  // namespace selvage
