// SPDX-License-Identifier: MIT
#include "common/render/render.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "common/render/sheet.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

long count(const Image& image, Rgb colour) { return std::ranges::count(image.pixels, colour); }

Image picture(const TriangleSoup& soup, const RenderOptions& options, std::span<const Rgb> colours = {},
              std::span<const RegionId> regions = {}) {
  const Camera camera = fit_camera(soup.positions, {.azimuth_degrees = 20}, 120, 100);
  return render({soup.positions, soup.triangles, colours, regions}, camera, options);
}

TEST(Render, ShowsTheBackgroundWhereNothingIs) {
  const Image empty = picture({}, {.background = {10, 20, 30}});
  EXPECT_EQ(count(empty, {10, 20, 30}), 120 * 100);
  const Image sphere = picture(shapes::sphere(3), {.background = {10, 20, 30}});
  EXPECT_LT(count(sphere, {10, 20, 30}), 120 * 100 - 4000);
  EXPECT_EQ(sphere.at(0, 0), (Rgb{10, 20, 30}));
}

TEST(Render, IsDeterministic) {
  const TriangleSoup soup = shapes::torus(20, 30);
  const std::vector<RegionId> regions(soup.triangles.size(), 4);
  const RenderOptions options{.border_px = 1, .wire_px = 1, .label_px = 12};
  EXPECT_EQ(picture(soup, options, {}, regions).pixels, picture(soup, options, {}, regions).pixels);
}

TEST(Render, SurvivesMeshesWithoutExtentOrArea) {
  TriangleSoup flat = shapes::sphere(2), point = flat;
  for (Vec3& p : flat.positions) p.z = 0;
  for (Vec3& p : point.positions) p = {1, 1, 1};
  EXPECT_GT(count(picture(flat, {}), kWhite), 0);
  EXPECT_EQ(count(picture(point, {}), kWhite), 120 * 100);
  for (Vec3& p : flat.positions) p.y = 0;
  EXPECT_EQ(count(picture(flat, {}), kWhite), 120 * 100);
}

TEST(Render, DrawsBordersBetweenColoursOnly) {
  const TriangleSoup soup = shapes::grid(2, 2);
  const std::vector<Rgb> one(8, Rgb{200, 0, 0});
  std::vector<Rgb> two = one;
  two[0] = two[1] = {0, 200, 0};
  EXPECT_EQ(count(picture(soup, {.border_px = 2}, one), kBlack), 0);
  EXPECT_GT(count(picture(soup, {.border_px = 2}, two), kBlack), 10);
  EXPECT_EQ(count(picture(soup, {.border_px = 0}, two), kBlack), 0);
}

TEST(Render, DrawsWiresAlongEdges) {
  const TriangleSoup soup = shapes::grid(3, 3);
  EXPECT_NE(picture(soup, {.wire_px = 1}).pixels, picture(soup, {}).pixels);
}

TEST(Render, ShadesAnInsideOutMeshLikeAnother) {
  TriangleSoup turned = shapes::sphere(3);
  for (Triangle& t : turned.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(picture(turned, {}).at(60, 50), picture(shapes::sphere(3), {}).at(60, 50));
}

TEST(Render, WritesLabelsWhereAskedAndThereIsRoom) {
  const TriangleSoup soup = shapes::grid(2, 2);
  const std::vector<RegionId> regions(8, 1), nameless(8, kNone);
  const Image plain = picture(soup, {});
  EXPECT_NE(picture(soup, {.label_px = 12}, {}, regions).pixels, plain.pixels);
  EXPECT_EQ(picture(soup, {.label_px = 12}, {}, nameless).pixels, plain.pixels);
  EXPECT_EQ(picture(soup, {}, {}, regions).pixels, plain.pixels);
}

TEST(Sheet, PlacesPanelsInRowsWithTheirCaptions) {
  const std::vector<Panel> panels(3, Panel{Image(50, 40, kBlack), "a caption"});
  const Image sheet = make_sheet(panels, {.columns = 2, .gap_px = 10, .title = "three", .text_px = 10});
  EXPECT_EQ(sheet.width, 10 + 2 * 60);
  EXPECT_EQ(sheet.height, 10 + 20 + 10 + 2 * (40 + 20 + 10));
  EXPECT_EQ(sheet.at(10, 40), kBlack);
  EXPECT_EQ(sheet.at(60, 40), kWhite);
  EXPECT_EQ(sheet.at(70, 40), kBlack);
  EXPECT_EQ(sheet.at(10, 110), kBlack);
  EXPECT_EQ(sheet.at(70, 110), kWhite);
}

TEST(Sheet, CanBeEmpty) { EXPECT_GT(make_sheet({}).pixels.size(), 0u); }

}  // namespace
}  // namespace selvage
