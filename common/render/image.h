// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace selvage {

/// A colour in sRGB.
struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

inline constexpr Rgb kBlack{0, 0, 0};
inline constexpr Rgb kWhite{255, 255, 255};

/// Amounts of light, in which colours add and average; 1 is full white.
struct Light {
  float r = 0, g = 0, b = 0;

  Light& operator+=(const Light& o) {
    r += o.r, g += o.g, b += o.b;
    return *this;
  }
  friend Light operator+(Light a, const Light& b) { return a += b; }
  friend Light operator*(const Light& a, float s) { return {a.r * s, a.g * s, a.b * s}; }
};

Light to_light(Rgb colour);
Rgb to_rgb(const Light& light);  ///< clamps to what sRGB can show

/// Pixels row by row from the top left.
struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;

  Image() = default;
  Image(int w, int h, Rgb fill) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, fill) {}

  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  Rgb& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const Rgb& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

/// Copies `from` into `to` with its top left corner at (x, y); what does not fit is cut off.
void paste(Image& to, const Image& from, int x, int y);

/// Mixes `colour` over a pixel: 0 leaves it, 1 replaces it.
void blend(Rgb& pixel, Rgb colour, float coverage);

}  // namespace selvage
