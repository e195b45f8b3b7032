// SPDX-License-Identifier: MIT
#include "tests/support/lathe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace selvage::shapes {
namespace {

std::vector<ProfilePoint> sampled(std::span<const ProfilePoint> profile, double step) {
  std::vector<ProfilePoint> samples;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const auto [r0, z0] = profile[i];
    const auto [r1, z1] = profile[i + 1];
    const int pieces = std::max(1, static_cast<int>(std::lround(std::hypot(r1 - r0, z1 - z0) / step)));
    for (int k = 0; k < pieces; ++k)
      samples.push_back({r0 + (r1 - r0) * k / pieces, z0 + (z1 - z0) * k / pieces});
  }
  samples.push_back(profile.back());
  return samples;
}

/// An arc about (0, z) from angle a to b, measured from the downward axis.
void add_arc(std::vector<ProfilePoint>& profile, double z, double radius, double a, double b) {
  constexpr int kPieces = 48;
  for (int i = 0; i <= kPieces; ++i) {
    const double angle = a + (b - a) * i / kPieces;
    profile.push_back({radius * std::sin(angle), z - radius * std::cos(angle)});
  }
}

}  // namespace

TriangleSoup lathe(std::span<const ProfilePoint> profile, double step) {
  const std::vector<ProfilePoint> samples = sampled(profile, step);
  double widest = 0;
  for (const ProfilePoint& p : samples) widest = std::max(widest, p.radius);
  const auto around =
      static_cast<std::uint32_t>(std::max(8.0, std::round(2 * std::numbers::pi * widest / step)));
  const auto rings = static_cast<std::uint32_t>(samples.size() - 2);

  TriangleSoup soup;
  for (std::uint32_t i = 1; i <= rings; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) {
      const double angle = 2 * std::numbers::pi * (j + 0.5 * (i % 2)) / around;
      const double r = samples[i].radius;
      soup.positions.push_back({r * std::cos(angle), r * std::sin(angle), samples[i].z});
    }
  }
  const auto bottom = static_cast<std::uint32_t>(soup.positions.size()), top = bottom + 1;
  soup.positions.push_back({0, 0, samples.front().z});
  soup.positions.push_back({0, 0, samples.back().z});
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i * around + j % around; };
  for (std::uint32_t j = 0; j < around; ++j) {
    soup.triangles.push_back({bottom, at(0, j + 1), at(0, j)});
    soup.triangles.push_back({top, at(rings - 1, j), at(rings - 1, j + 1)});
  }
  for (std::uint32_t i = 0; i + 1 < rings; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) {
      const std::uint32_t shift = i % 2;  // ring i is turned half a cell back against ring i + 1, or forth
      soup.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + shift)});
      soup.triangles.push_back({at(i, j + 1 - shift), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return soup;
}

TriangleSoup capped_cylinder(double step) {
  const std::array<ProfilePoint, 4> profile{{{0, 0}, {1, 0}, {1, 3}, {0, 3}}};
  return lathe(profile, step);
}

TriangleSoup bolt(double step) {
  const std::array<ProfilePoint, 6> profile{{{0, 0}, {1, 0}, {1, 4}, {2, 4}, {2, 5.5}, {0, 5.5}}};
  return lathe(profile, step);
}

TriangleSoup dumbbell(double step) {
  constexpr double kPi = std::numbers::pi, kBar = 0.3, kBall = 1;
  const double rim = std::asin(kBar / kBall);
  std::vector<ProfilePoint> profile;
  add_arc(profile, 0, kBall, 0, kPi - rim);
  add_arc(profile, 5, kBall, rim, kPi);
  return lathe(profile, step);
}

TriangleSoup bottle(double step) {
  // Body, shoulder, neck and a lip that flares out, along a smooth curve.
  constexpr int kSamples = 200;
  std::vector<ProfilePoint> profile{{0, 0}};
  const auto blend = [](double x) { return 1 / (1 + std::exp(-x)); };
  for (int i = 0; i <= kSamples; ++i) {
    const double z = 6.0 * i / kSamples;
    profile.push_back({1.4 - 0.95 * blend((z - 3.2) * 8) + 0.45 * blend((z - 5.4) * 12), z});
  }
  profile.push_back({0, 6});
  return lathe(profile, step);
}

TriangleSoup inside_out(TriangleSoup soup) {
  for (auto& [a, b, c] : soup.triangles) std::swap(b, c);
  return soup;
}

TriangleSoup pillow() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}; }

}  // namespace selvage::shapes
