// SPDX-License-Identifier: MIT
#include "common/render/palette.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace selvage {
namespace {

/// A colour in Oklab [Ottosson 2020], where distance is close to how different two colours look.
struct Lab {
  double l, a, b;
};

double distance(const Lab& x, const Lab& y) { return std::hypot(x.l - y.l, x.a - y.a, x.b - y.b); }

Rgb to_rgb(const Lab& c) {
  const auto cube = [](double v) { return v * v * v; };
  const double l = cube(c.l + 0.3963377774 * c.a + 0.2158037573 * c.b);
  const double m = cube(c.l - 0.1055613458 * c.a - 0.0638541728 * c.b);
  const double s = cube(c.l - 0.0894841775 * c.a - 1.2914855480 * c.b);
  return selvage::to_rgb(Light{static_cast<float>(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
                               static_cast<float>(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
                               static_cast<float>(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)});
}

/// The golden angle keeps any run of numbers spread over the hues; lightness takes turns so that the same
/// hue, when it comes round again, differs.
Lab lab_of(RegionId number) {
  if (number == kLooseRegion) return {0.72, 0, 0};
  constexpr double kGoldenAngle = std::numbers::pi * (3 - 2.2360679774997896964);
  constexpr double kLightness[] = {0.80, 0.68, 0.88}, kChroma[] = {0.115, 0.125, 0.085};
  const std::uint32_t turn = (number - 1) % 3;
  const double hue = 0.62 + kGoldenAngle * static_cast<double>((number - 1) % 987);
  return {kLightness[turn], kChroma[turn] * std::cos(hue), kChroma[turn] * std::sin(hue)};
}

constexpr double kClearlyDifferent = 0.11;

}  // namespace

Rgb colour_of_region(RegionId region) { return to_rgb(lab_of(region)); }

std::vector<Rgb> colours_of_regions(std::uint32_t count, std::span<const RegionPair> neighbours) {
  std::vector<std::vector<RegionId>> lower_neighbours(count);
  for (const auto& [a, b] : neighbours) lower_neighbours[std::max(a, b)].push_back(std::min(a, b));

  std::vector<Lab> chosen(count);
  std::vector<Rgb> colours(count);
  for (RegionId region = 0; region < count; ++region) {
    double best = -1;
    for (RegionId attempt = 0; attempt < 12 && best < kClearlyDifferent; ++attempt) {
      const Lab candidate = lab_of(region + (region == kLooseRegion ? 0 : attempt * 5));
      double nearest = 1;
      for (RegionId other : lower_neighbours[region])
        nearest = std::min(nearest, distance(candidate, chosen[other]));
      if (nearest > best) best = nearest, chosen[region] = candidate;
    }
    colours[region] = to_rgb(chosen[region]);
  }
  return colours;
}

std::vector<RegionPair> neighbouring_regions(std::span<const Triangle> triangles,
                                             std::span<const RegionId> region_of_vertex) {
  std::vector<RegionPair> pairs;
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const RegionId a = region_of_vertex[t[k]], b = region_of_vertex[t[(k + 1) % 3]];
      if (a != b) pairs.push_back(std::minmax(a, b));
    }
  }
  std::ranges::sort(pairs);
  const auto repeated = std::ranges::unique(pairs);
  pairs.erase(repeated.begin(), repeated.end());
  return pairs;
}

RegionPaint paint_regions(std::span<const Triangle> triangles, std::span<const RegionId> region_of_vertex,
                          std::span<const Rgb> colour_of_region, Rgb boundary_colour) {
  RegionPaint paint;
  for (const auto& [a, b, c] : triangles) {
    const RegionId region = region_of_vertex[a];
    const bool is_inner = region == region_of_vertex[b] && region == region_of_vertex[c];
    paint.region_of_triangle.push_back(is_inner ? region : kNone);
    paint.colour_of_triangle.push_back(is_inner ? colour_of_region[region] : boundary_colour);
  }
  return paint;
}

}  // namespace selvage
