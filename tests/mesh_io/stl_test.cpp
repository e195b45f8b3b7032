// SPDX-License-Identifier: MIT
#include "common/mesh_io/stl.h"

#include <limits>

#include "common/coding/byte_io.h"
#include "tests/mesh_io/support.h"

namespace selvage {
namespace {

using Corners = std::vector<float>;  // nine a triangle

std::string binary_stl(const Corners& corners, std::string start = "made by hand",
                       std::uint16_t attribute = 0) {
  start.resize(80);
  ByteWriter out;
  out.append(std::as_bytes(std::span(start)));
  out.u32(static_cast<std::uint32_t>(corners.size() / 9));
  for (std::size_t t = 0; t < corners.size(); t += 9) {
    for (int i = 0; i < 3; ++i) out.f32(0);
    for (int i = 0; i < 9; ++i) out.f32(corners[t + static_cast<std::size_t>(i)]);
    out.u16(attribute);
  }
  const Bytes bytes = std::move(out).take();
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

/// Two triangles of a square; the shared corner at the origin once as -0.
const Corners kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, /**/ -0.0f, 0, -0.0f, 1, 1, 0, 0, 1, 0};

const std::string kAsciiTriangle =
    "solid part\n facet normal nan nan nan\n  outer loop\n   vertex 0 0 0\n   vertex 1.5e+000 0 0\n   vertex "
    "0 1 0\n"
    "  endloop\n endfacet\nendsolid part\n";

TEST(Stl, WeldsCornersWithEqualFloatsAndTakesMinusZeroForZero) {
  const MeshFile file = parse_good(parse_stl, binary_stl(kSquare));
  EXPECT_EQ(file.soup.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(triangles_of(file), "0 1 2 | 0 2 3");
  EXPECT_EQ(file.format, "STL binary");
  EXPECT_TRUE(has_note(file, "normals dropped"));
}

TEST(Stl, WeldsManyCornersApart) {
  Corners corners;
  for (int i = 0; i < 3000; ++i)
    for (int k = 0; k < 9; ++k) corners.push_back(static_cast<float>(k % 3 == 0 ? i * 3 + k / 3 : 0));
  const MeshFile file = parse_good(parse_stl, binary_stl(corners));
  EXPECT_EQ(file.soup.positions.size(), 9000u);
  EXPECT_EQ(file.soup.triangles.back(), (Triangle{8997, 8998, 8999}));
}

TEST(Stl, ReadsABinaryFileWhoseHeaderBeginsWithSolid) {
  EXPECT_EQ(parse_good(parse_stl, binary_stl(kSquare, "solid of some exporter")).format, "STL binary");
}

TEST(Stl, ReadsAscii) {
  const MeshFile file = parse_good(parse_stl, kAsciiTriangle);
  EXPECT_EQ(file.soup.positions, (std::vector<Vec3>{{0, 0, 0}, {1.5, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(triangles_of(file), "0 1 2");
  EXPECT_EQ(file.format, "STL ascii");
}

TEST(Stl, ReadsSeveralAsciiSolidsInAnyCase) {
  std::string upper = kAsciiTriangle;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  EXPECT_EQ(triangles_of(parse_good(parse_stl, kAsciiTriangle + upper)), "0 1 2 | 0 1 2");
}

TEST(Stl, RefusesEveryTruncationOfABinaryFile) {
  const std::string whole = binary_stl(kSquare);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_FALSE(parse(parse_stl, std::string_view(whole).substr(0, length))) << length;
  }
}

TEST(Stl, RefusesEveryTruncationOfAnAsciiFile) {
  for (std::size_t length = 0; length < kAsciiTriangle.find("endsolid") + 8; ++length) {
    EXPECT_FALSE(parse(parse_stl, std::string_view(kAsciiTriangle).substr(0, length))) << length;
  }
}

TEST(Stl, RefusesACountThatTheSizeDoesNotBack) {
  std::string text = binary_stl(kSquare);
  text.replace(80, 4, "\xff\xff\xff\xff");
  const Error error = parse_bad(parse_stl, text);
  EXPECT_EQ(error.to_string(),
            "the STL header declares 4294967295 triangles, but the file's size is that of 2 (at byte 80)");
}

TEST(Stl, NotesAFewBytesAfterTheLastTriangleAndRefusesMore) {
  EXPECT_TRUE(
      has_note(parse_good(parse_stl, binary_stl(kSquare) + "end"), "3 bytes after the last triangle"));
  EXPECT_FALSE(parse(parse_stl, binary_stl(kSquare) + std::string(50, 'x')));
}

TEST(Stl, NotesAttributeBytes) {
  EXPECT_TRUE(has_note(parse_good(parse_stl, binary_stl(kSquare, "", 31)), "attribute bytes"));
}

TEST(Stl, RefusesCoordinatesThatAreNotFinite) {
  Corners corners = kSquare;
  corners[12] = std::numeric_limits<float>::quiet_NaN();
  const Error error = parse_bad(parse_stl, binary_stl(corners));
  EXPECT_EQ(error.message, "a coordinate of triangle 1 is not a finite number");
  EXPECT_EQ(error.offset, 84u + 50 + 12 + 12);
  std::string text = kAsciiTriangle;
  text.replace(text.find("1.5e+000"), 8, "1.5e+400");
  expect_error(parse_stl, text, "line 5: expected a finite coordinate, found '1.5e+400'");
}

TEST(Stl, RefusesBrokenAsciiWithItsLine) {
  const auto without = [](const std::string& word) {
    std::string text = kAsciiTriangle;
    return text.erase(text.find(word), word.size());
  };
  expect_error(parse_stl, without("outer"), "line 3: expected outer loop, found 'loop'");
  expect_error(parse_stl, without("   vertex 0 1 0\n"), "line 6: expected vertex, found 'endloop'");
  expect_error(parse_stl, without("endsolid"), "line 9: expected facet or endsolid, found 'part'");
}

TEST(Stl, RefusesAnEmptyMesh) {
  expect_error(parse_stl, "solid nothing\nendsolid nothing\n", "it has no vertices");
  expect_error(parse_stl, binary_stl({}), "it has no vertices");
  expect_error(parse_stl, "", "neither an ascii STL");
}

}  // namespace
}  // namespace selvage
