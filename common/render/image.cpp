// SPDX-License-Identifier: MIT
#include "common/render/image.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace selvage {
namespace {

double decoded(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double encoded(double v) { return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

constexpr int kSteps = 4096;  // fine enough that every one of the 256 values comes back from to_light

std::uint8_t to_byte(float light) {
  static const auto table = [] {
    std::array<std::uint8_t, kSteps + 1> t{};
    for (int i = 0; i <= kSteps; ++i)
      t[i] = static_cast<std::uint8_t>(std::lround(255 * encoded(double(i) / kSteps)));
    return t;
  }();
  return table[static_cast<std::size_t>(std::clamp(light, 0.0f, 1.0f) * kSteps + 0.5f)];
}

}  // namespace

Light to_light(Rgb colour) {
  static const auto table = [] {
    std::array<float, 256> t{};
    for (int i = 0; i < 256; ++i) t[i] = static_cast<float>(decoded(i / 255.0));
    return t;
  }();
  return {table[colour.r], table[colour.g], table[colour.b]};
}

Rgb to_rgb(const Light& light) { return {to_byte(light.r), to_byte(light.g), to_byte(light.b)}; }

void paste(Image& to, const Image& from, int x, int y) {
  for (int row = 0; row < from.height; ++row)
    for (int column = 0; column < from.width; ++column)
      if (to.contains(x + column, y + row)) to.at(x + column, y + row) = from.at(column, row);
}

void blend(Rgb& pixel, Rgb colour, float coverage) {
  const float c = std::clamp(coverage, 0.0f, 1.0f);
  pixel = to_rgb(to_light(pixel) * (1 - c) + to_light(colour) * c);
}

}  // namespace selvage
