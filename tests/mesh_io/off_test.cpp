// SPDX-License-Identifier: MIT
#include "common/mesh_io/off.h"

#include "tests/mesh_io/support.h"

namespace selvage {
namespace {

const TriangleSoup kTriangle = {{{0, 0, 0}, {1, 0, 0}, {0, 1.5, 0}}, {{0, 1, 2}}};

TEST(Off, ReadsCountsOnTheHeaderLineOrTheNext) {
  for (const std::string head :
       {"OFF\n3 1 3\n", "OFF 3 1 3\n", "OFF\n\n3 1\n", "OFF # c\n# c\n3 1 0 # c\n"}) {
    const MeshFile file = parse_good(parse_off, head + "0 0 0\n1 0 0\n0 1.5 0\n3 0 1 2\n");
    expect_same(file.soup, kTriangle);
    EXPECT_EQ(file.format, "OFF");
  }
}

TEST(Off, SkipsCommentsAnywhere) {
  expect_same(
      parse_good(parse_off,
                 "# before\n\n# the header\nOFF\n3 1 0\n0 0 0 # a\n# b\n1 0 0\n0 1.5 0\n\n3 0 1 2#c\n# end\n")
          .soup,
      kTriangle);
}

TEST(Off, DropsWhatFollowsCoordinatesAndCorners) {
  for (const std::string word : {"COFF", "NOFF", "STOFF", "CNOFF", "OFF"}) {
    const MeshFile file =
        parse_good(parse_off, word + "\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 9\n0 1.5 0\n3 0 1 2 0.5 0.5 0.5\n");
    expect_same(file.soup, kTriangle);
    EXPECT_TRUE(has_note(file, "coordinates dropped"));
    EXPECT_TRUE(has_note(file, "corners dropped"));
  }
}

TEST(Off, TriangulatesPolygons) {
  const MeshFile file = parse_good(parse_off, "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 1 2 3 0\n");
  EXPECT_EQ(triangles_of(file), "1 2 3 | 1 3 0");
  EXPECT_EQ(file.polygons, 1u);
}

TEST(Off, RefusesOtherDimensionsAndTheBinaryForm) {
  expect_error(parse_off, "4OFF\n3 1 0\n", "only three dimensions", ErrorCode::Unsupported);
  expect_error(parse_off, "nOFF\n3 1 0\n", "only three dimensions", ErrorCode::Unsupported);
  expect_error(parse_off, "OFF BINARY\n", "line 1: binary OFF cannot be read", ErrorCode::Unsupported);
}

TEST(Off, RefusesBrokenFilesWithTheirLine) {
  expect_error(parse_off, "", "line 1: the file is empty");
  expect_error(parse_off, "PLY\n", "line 1: expected OFF");
  expect_error(parse_off, "OFF\nx 1 0\n", "line 2: expected the number of vertices, found 'x'");
  expect_error(parse_off, "OFF\n-1 1 0\n", "line 2: expected the number of vertices");
  expect_error(parse_off, "OFF\n3 1 0 7\n", "line 2: expected the end of the line, found '7'");
  expect_error(parse_off, "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n",
               "line 4: expected a finite coordinate, found 'nan'");
  expect_error(parse_off, "OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n",
               "line 4: expected a finite coordinate, found the end of the line");
  expect_error(parse_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
               "line 6: a face names vertex 3, but the file declares 3");
  expect_error(parse_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "line 6: a face names vertex -1");
  expect_error(parse_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n",
               "line 6: expected a vertex index, found the end of the line");
  expect_error(parse_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n900 0 1\n", "line 6: a face claims 900 corners");
  expect_error(parse_off, "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n# cut", "found the end of the file");
  expect_error(parse_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n",
               "line 7: data after the last face");
}

TEST(Off, RefusesAbsurdCountsBeforeAllocating) {
  for (const std::string counts :
       {"1152921504606846976 1 0", "3 1152921504606846976 0", "9223372036854775807 9223372036854775807 0"}) {
    expect_error(parse_off, "OFF\n" + counts + "\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                 "more than the rest of the file can hold");
  }
}

TEST(Off, RefusesAnEmptyMesh) {
  expect_error(parse_off, "OFF\n0 0 0\n", "it has no vertices");
  expect_error(parse_off, "OFF\n1 0 0\n0 0 0\n", "1 vertices, but no triangles");
}

}  // namespace
}  // namespace selvage
