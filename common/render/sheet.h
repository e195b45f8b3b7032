// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/render/camera.h"
#include "common/render/image.h"
#include "common/render/render.h"

namespace selvage {

/// Several pictures on one page, each with a line of text below it.
struct Panel {
  Image image;
  std::string caption;
};

struct SheetStyle {
  int columns = 0;  ///< 0: as many as make the page about as wide as high
  int gap_px = 12;
  std::string title = {};
  double text_px = 13;
  Rgb background = kWhite;
};

/// Lays panels out row by row; cells are as large as the largest picture. No panels give a page with the
/// title alone.
Image make_sheet(std::span<const Panel> panels, const SheetStyle& style = {});

/// The same scene from several sides, for make_sheet: front right, back left and above, say. The captions
/// name the angles.
std::vector<Panel> render_views(const Scene& scene, std::span<const View> views, int width, int height,
                                const RenderOptions& options = {});

/// Sides that show most of an unknown model: two from above, at the front and at the back, one from the side,
/// one from below.
std::vector<View> four_sides(UpAxis up);

}  // namespace selvage
