// SPDX-License-Identifier: MIT
#include "common/render/sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/render/text.h"

namespace selvage {

Image make_sheet(std::span<const Panel> panels, const SheetStyle& style) {
  int cell_width = 1, cell_height = 1;
  for (const Panel& panel : panels) {
    cell_width = std::max(cell_width, panel.image.width);
    cell_height = std::max(cell_height, panel.image.height);
  }
  const int count = static_cast<int>(panels.size());
  const double square = std::sqrt(count * static_cast<double>(cell_height) / cell_width);
  const int wanted = style.columns > 0 ? style.columns : static_cast<int>(std::ceil(square));
  const int columns = std::clamp(wanted, 1, std::max(1, count));
  const int rows = (count + columns - 1) / columns;

  const bool has_captions = std::ranges::any_of(panels, [](const Panel& p) { return !p.caption.empty(); });
  const int line = static_cast<int>(std::lround(2 * style.text_px));
  const int row_height = cell_height + (has_captions ? line : 0) + style.gap_px;
  const TextStyle title_style{.height_px = 1.3 * style.text_px}, caption_style{.height_px = style.text_px};
  const int title_width = static_cast<int>(std::ceil(text_width_px(style.title, title_style)));
  const int top = style.gap_px + (style.title.empty() ? 0 : line + style.gap_px);
  const int width =
      std::max(style.gap_px + columns * (cell_width + style.gap_px), title_width + 2 * style.gap_px);

  Image sheet(width, top + rows * row_height, style.background);
  draw_text(sheet, style.gap_px, top - style.gap_px - style.text_px / 2, style.title, title_style);
  for (int i = 0; i < count; ++i) {
    const int x = style.gap_px + i % columns * (cell_width + style.gap_px),
              y = top + i / columns * row_height;
    paste(sheet, panels[i].image, x, y);
    draw_text_centred(sheet, x + cell_width / 2.0, y + cell_height + line / 2.0, panels[i].caption,
                      caption_style);
  }
  return sheet;
}

std::vector<Panel> render_views(const Scene& scene, std::span<const View> views, int width, int height,
                                const RenderOptions& options) {
  std::vector<Panel> panels;
  for (const View& view : views) {
    char caption[64];
    std::snprintf(caption, sizeof caption, "%g degrees round, %g up", view.azimuth_degrees,
                  view.elevation_degrees);
    panels.push_back({render(scene, fit_camera(scene.positions, view, width, height), options), caption});
  }
  return panels;
}

std::vector<View> four_sides(UpAxis up) { return {{35, 25, up}, {215, 25, up}, {-60, 5, up}, {35, -35, up}}; }

}  // namespace selvage
