// SPDX-License-Identifier: MIT
#include "common/render/image.h"

#include <filesystem>
#include <fstream>
#include <memory>

#include <gtest/gtest.h>
#include <spng.h>

#include "common/render/png.h"

namespace selvage {
namespace {

Image gradient(int width, int height) {
  Image image(width, height, kWhite);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y) = {static_cast<std::uint8_t>(7 * x), static_cast<std::uint8_t>(11 * y), 99};
  return image;
}

std::vector<Rgb> decoded(const std::vector<std::byte>& png) {
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> context(spng_ctx_new(0), spng_ctx_free);
  spng_set_png_buffer(context.get(), png.data(), png.size());
  std::size_t size = 0;
  EXPECT_EQ(spng_decoded_image_size(context.get(), SPNG_FMT_RGB8, &size), 0);
  std::vector<Rgb> pixels(size / sizeof(Rgb));
  EXPECT_EQ(spng_decode_image(context.get(), pixels.data(), size, SPNG_FMT_RGB8, 0), 0);
  return pixels;
}

TEST(Image, KeepsEveryColourThroughLight) {
  for (int v = 0; v < 256; ++v) {
    const auto byte = static_cast<std::uint8_t>(v);
    EXPECT_EQ(to_rgb(to_light({byte, 0, byte})), (Rgb{byte, 0, byte}));
  }
}

TEST(Image, ClampsLightBeyondWhite) { EXPECT_EQ(to_rgb({2.0f, -1.0f, 1.0f}), (Rgb{255, 0, 255})); }

TEST(Image, CutsOffWhatIsPastedOutside) {
  Image to(4, 4, kWhite);
  paste(to, Image(3, 3, kBlack), 2, -1);
  int black = 0;
  for (const Rgb& p : to.pixels) black += p == kBlack;
  EXPECT_EQ(black, 2 * 2);
}

TEST(Png, RestoresThePixels) {
  const Image image = gradient(31, 17);
  const auto png = encode_png(image);
  ASSERT_TRUE(png);
  EXPECT_EQ(decoded(*png), image.pixels);
}

TEST(Png, IsTheSameBytesEachTime) {
  EXPECT_EQ(encode_png(gradient(20, 20)).value(), encode_png(gradient(20, 20)).value());
}

TEST(Png, RefusesAnEmptyImage) { EXPECT_EQ(encode_png(Image()).error().code, ErrorCode::InvalidArgument); }

TEST(Png, NamesThePathThatCannotBeWritten) {
  const auto written = write_png("/no/such/folder/picture.png", gradient(2, 2));
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::Io);
  EXPECT_NE(written.error().message.find("/no/such/folder/picture.png"), std::string::npos);
}

TEST(Png, WritesTheEncodedBytes) {
  const auto path = std::filesystem::path(testing::TempDir()) / "selvage image test.png";
  ASSERT_TRUE(write_png(path, gradient(5, 5)));
  EXPECT_EQ(std::filesystem::file_size(path), encode_png(gradient(5, 5))->size());
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace selvage
