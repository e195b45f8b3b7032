// SPDX-License-Identifier: MIT
#include "bench/simplify/error_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/render/text.h"

namespace selvage::bench {
namespace {

constexpr int kWidth = 900, kHeight = 560;
constexpr double kLeft = 90, kRight = 730, kTop = 60, kBottom = 490;
constexpr Rgb kGrey{215, 215, 215};
constexpr Rgb kColours[] = {{200, 40, 40}, {30, 90, 190},  {20, 140, 80},
                            {230, 140, 0}, {130, 60, 160}, {90, 90, 90}};

struct Point {
  double x, y;
};

void draw_line(Image& image, Point a, Point b, double width, Rgb colour) {
  const double dx = b.x - a.x, dy = b.y - a.y, squared = std::max(dx * dx + dy * dy, 1e-9);
  const double reach = width / 2 + 1;
  const auto first_y = static_cast<int>(std::min(a.y, b.y) - reach);
  const auto last_y = static_cast<int>(std::max(a.y, b.y) + reach);
  const auto first_x = static_cast<int>(std::min(a.x, b.x) - reach);
  const auto last_x = static_cast<int>(std::max(a.x, b.x) + reach);
  for (int y = first_y; y <= last_y; ++y) {
    for (int x = first_x; x <= last_x; ++x) {
      if (!image.contains(x, y)) continue;
      const double px = x + 0.5 - a.x, py = y + 0.5 - a.y;
      const double along = std::clamp((px * dx + py * dy) / squared, 0.0, 1.0);
      const double distance = std::hypot(px - along * dx, py - along * dy);
      const double coverage = std::clamp(width / 2 + 0.5 - distance, 0.0, 1.0);
      if (coverage > 0) blend(image.at(x, y), colour, static_cast<float>(coverage));
    }
  }
}

std::string in_short(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

/// Whole decades that hold all errors.
struct Decades {
  int low = 3, high = -9;

  explicit Decades(const std::vector<ErrorCurve>& curves) {
    for (const ErrorCurve& curve : curves) {
      for (const double error : curve.error) {
        if (!(error > 0)) continue;
        low = std::min(low, static_cast<int>(std::floor(std::log10(error))));
        high = std::max(high, static_cast<int>(std::ceil(std::log10(error))));
      }
    }
    if (low >= high) low = high - 1;
  }
  double y_of(double error) const {
    const double at = error > 0 ? (std::log10(error) - low) / (high - low) : 0;
    return kBottom - (kBottom - kTop) * std::clamp(at, 0.0, 1.0);
  }
};

}  // namespace

Image plot_errors(const std::string& title, const std::vector<double>& percents,
                  const std::vector<ErrorCurve>& curves) {
  Image image(kWidth, kHeight, kWhite);
  const Decades decades(curves);
  const double span = std::log(percents.front() / percents.back());
  const auto x_of = [&](double percent) {
    return kLeft + (kRight - kLeft) * std::log(percents.front() / percent) / span;
  };
  const TextStyle small{.height_px = 11}, large{.height_px = 14};
  draw_text_centred(image, kWidth / 2.0, kTop / 2, title, large);
  draw_text_centred(image, (kLeft + kRight) / 2, kHeight - 22, "triangles, % of the model's", small);
  draw_text(image, 8, kTop - 12, "largest error, % of the diagonal", small);
  for (int decade = decades.low; decade <= decades.high; ++decade) {
    const double y = decades.y_of(std::pow(10.0, decade));
    draw_line(image, {kLeft, y}, {kRight, y}, 1, kGrey);
    draw_text_centred(image, kLeft - 36, y, in_short(std::pow(10.0, decade)), small);
  }
  for (const double percent : percents) {
    draw_line(image, {x_of(percent), kTop}, {x_of(percent), kBottom}, 1, kGrey);
    draw_text_centred(image, x_of(percent), kBottom + 18, in_short(percent), small);
  }
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const Rgb colour = kColours[c % std::size(kColours)];
    const ErrorCurve& curve = curves[c];
    for (std::size_t i = 0; i + 1 < curve.error.size(); ++i) {
      draw_line(image, {x_of(percents[i]), decades.y_of(curve.error[i])},
                {x_of(percents[i + 1]), decades.y_of(curve.error[i + 1])}, 2.4, colour);
    }
    const double y = kTop + 12 + 26.0 * double(c);
    draw_line(image, {kRight + 24, y}, {kRight + 54, y}, 2.4, colour);
    draw_text(image, kRight + 64, y + 5, curve.name, small);
  }
  return image;
}

}  // namespace selvage::bench
