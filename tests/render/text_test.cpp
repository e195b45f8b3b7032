// SPDX-License-Identifier: MIT
#include "common/render/text.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace selvage {
namespace {

std::vector<Rgb> drawn(std::string_view text) {
  Image image(200, 40, kWhite);
  draw_text(image, 10, 30, text, {.height_px = 16});
  return image.pixels;
}

TEST(Text, DrawsEveryPrintableCharacterDifferently) {
  std::set<std::string> seen;
  for (char c = '!'; c <= '~'; ++c) {
    if (c == '0') continue;  // an oval, as O is
    std::string ink;
    for (const Rgb& p : drawn(std::string(1, c))) ink += static_cast<char>(p.r);
    EXPECT_TRUE(seen.insert(ink).second) << c;
  }
}

TEST(Text, ShowsWhatItCannotDrawAsAQuestionMark) { EXPECT_EQ(drawn("\xC3"), drawn("?")); }

TEST(Text, DrawsNothingForNothing) { EXPECT_EQ(drawn(""), drawn("   ")); }

TEST(Text, StaysInsideItsWidth) {
  const TextStyle style{.height_px = 20};
  Image image(300, 60, kWhite);
  draw_text(image, 50, 40, "Wide 123", style);
  const double right = 50 + text_width_px("Wide 123", style) + 2;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      EXPECT_TRUE((x >= 48 && x <= right) || image.at(x, y) == kWhite) << x << " " << y;
}

TEST(Text, IsCutOffAtTheEdges) {
  Image image(8, 8, kWhite);
  draw_text(image, -20, 4, "0123456789", {.height_px = 30, .halo_px = 4});
  draw_text_centred(image, 500, 500, "away", {});
  EXPECT_EQ(image.pixels.size(), 64u);
}

}  // namespace
}  // namespace selvage
