// SPDX-License-Identifier: MIT
#include "common/mesh_io/obj.h"

#include "tests/mesh_io/support.h"

namespace selvage {
namespace {

const std::string kThree = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(Obj, ReadsFacesInAllTheirForms) {
  for (const std::string face : {"1 2 3", "1/1 2/1 3/1", "1//1 2//1 3//1", "1/1/1 2/2/2 3/3/3", "-3 -2 -1",
                                 "-3/-1/-1 -2/-1/-1 -1/-1/-1", "1/ 2/ 3/"}) {
    const MeshFile file = parse_good(parse_obj, kThree + "f " + face + "\n");
    EXPECT_EQ(triangles_of(file), "0 1 2") << face;
    EXPECT_EQ(file.format, "OBJ");
  }
}

TEST(Obj, NegativeIndicesCountFromWhereTheyStand) {
  EXPECT_EQ(triangles_of(parse_good(parse_obj, kThree + "f -3 -2 -1\n" + kThree + "f -3 -2 -1\n")),
            "0 1 2 | 3 4 5");
}

TEST(Obj, FacesMayComeBeforeTheirVertices) {
  EXPECT_EQ(triangles_of(parse_good(parse_obj, "f 1 2 3\n" + kThree)), "0 1 2");
}

TEST(Obj, JoinsContinuedLinesAndTakesAllLineEnds) {
  EXPECT_EQ(triangles_of(parse_good(parse_obj, "v 0 \\\n 0 0\r\nv 1 0 0\rv 0 1 0\nf 1 \\\r\n2\\\n 3")),
            "0 1 2");
}

TEST(Obj, TriangulatesPolygonsInPlace) {
  const MeshFile file = parse_good(parse_obj, kThree + "v 0 2 0\nf 4 1 2 3\nf 1 2 3\n");
  EXPECT_EQ(triangles_of(file), "3 0 1 | 3 1 2 | 0 1 2");
  EXPECT_EQ(file.polygons, 1u);
}

TEST(Obj, KeepsRepeatedIndices) {
  EXPECT_EQ(triangles_of(parse_good(parse_obj, kThree + "f 1 1 2\n")), "0 0 1");
}

TEST(Obj, DropsWhatIsNoSurfaceAndNotesIt) {
  const MeshFile file =
      parse_good(parse_obj,
                 "####\n# by hand\nmtllib a\\b.mtl\no thing\ng left right\ns off\nvn 0 0 1\nvt 0 0\nusemtl "
                 "red # comment\n" +
                     kThree + "v 0 0 0 1 0.5 0\nl 1 2\np 3\nshadow_obj x\nvp 0 0\nf 1 2 3\n");
  for (const char* note :
       {"materials dropped (first: 'mtllib' on line 3)", "normals dropped (first: 'vn' on line 7)",
        "texture coordinates", "vertex colours dropped (first: 'v' on line 13)", "lines", "points",
        "unknown statements dropped (first: 'shadow_obj' on line 16)", "free-form"}) {
    EXPECT_TRUE(has_note(file, note)) << note;
  }
  EXPECT_EQ(file.notes.size(), 8u);
}

TEST(Obj, NamesTriangles) {
  const MeshFile file = parse_good(
      parse_obj, kThree + "f 1 2 3\ng a b\nf 1 2 3 1\no Big Wheel\nf 1 2 3\ng\nf 1 2 3\no\ng b a\nusemtl red\n"
                          "usemtl\nf 1 2 3\n");
  EXPECT_EQ(file.group_of_triangle, (std::vector<std::uint32_t>{0, 1, 1, 2, 3, 1}));
  ASSERT_EQ(file.groups.size(), 4u);
  EXPECT_TRUE(file.groups[0].groups.empty());
  EXPECT_EQ(file.groups[0].object, kNone);
  ASSERT_EQ(file.groups[1].groups.size(), 2u);
  EXPECT_EQ(file.names[file.groups[1].groups[0]], "a");
  EXPECT_EQ(file.names[file.groups[1].groups[1]], "b");
  EXPECT_EQ(file.names[file.groups[2].object], "Big Wheel");
  EXPECT_EQ(file.groups[1].material, kNone);
  EXPECT_TRUE(parse_good(parse_obj, kThree + "f 1 2 3\n").group_of_triangle.empty());
}

TEST(Obj, BoundsWhatNamesTake) {
  std::string many = "g";
  for (int i = 0; i < 40; ++i) many += " n" + std::to_string(i);
  const MeshFile file = parse_good(parse_obj, kThree + many + "\nusemtl " + std::string(5000, 'x') + "\nf 1 2 3\n");
  EXPECT_EQ(file.groups.at(0).groups.size(), 16u);
  EXPECT_EQ(file.names.at(file.groups[0].material).size(), 255u);
  EXPECT_TRUE(has_note(file, "more than 16 groups at once"));
}

TEST(Obj, RefusesMalformedNumbersWithTheirLine) {
  for (const std::string bad : {"nan", "inf", "1e999", "one", "1.0.0", "0,5"}) {
    expect_error(parse_obj, kThree + "v 0 " + bad + " 0\nf 1 2 3\n",
                 "line 4: expected a finite coordinate, found '" + bad);
  }
  expect_error(parse_obj, "v 0 0\n", "line 1: expected a finite coordinate, found the end of the line");
  expect_error(parse_obj, "v 0 0 0 red\n", "line 1: expected a number or the end of the line, found 'red'");
  for (const std::string bad : {"x", "1.5", "1/x", "1/2/3/4", "3d", "99999999999999999999"}) {
    expect_error(parse_obj, kThree + "f 1 2 " + bad + "\n",
                 "line 4: expected a face corner (v, v/vt, v//vn or v/vt/vn), found '" + bad);
  }
}

TEST(Obj, RefusesIndicesOutOfRange) {
  expect_error(parse_obj, kThree + "f 1 2 0\n",
               "line 4: a face names vertex 0, but 3 vertices come before it");
  expect_error(parse_obj, kThree + "f 1 2 -4\n", "line 4: a face names vertex -4");
  expect_error(parse_obj, kThree + "f 1 2 3\nf 1 2 4\n",
               "line 5: a face names vertex 4, but the file has only 3");
  expect_error(parse_obj, kThree + "f 1 2 1152921504606846976\n",
               "line 4: a face names vertex 1152921504606846976");
}

TEST(Obj, RefusesWhatIsNoObj) {
  expect_error(parse_obj, "<html>\n", "line 1: not an OBJ statement: '<html>'");
  expect_error(parse_obj, "3 0 1 2\n", "line 1: not an OBJ statement: '3'");
}

TEST(Obj, RefusesAnEmptyMesh) {
  expect_error(parse_obj, "", "it has no vertices");
  expect_error(parse_obj, kThree + "l 1 2 3\n", "3 vertices, but no triangles");
}

}  // namespace
}  // namespace selvage
