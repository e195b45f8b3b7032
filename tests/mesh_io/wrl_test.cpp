// SPDX-License-Identifier: MIT
#include "common/mesh_io/wrl.h"

#include "tests/mesh_io/support.h"

namespace selvage {
namespace {

const std::string kHead = "#VRML V2.0 utf8\n";
const std::string kPoints = "Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] }";

std::string face_set(const std::string& fields) {
  return "Shape { geometry IndexedFaceSet { " + fields + " } }\n";
}

void expect_near(const MeshFile& file, const std::vector<Vec3>& positions) {
  ASSERT_EQ(file.soup.positions.size(), positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v)
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(file.soup.positions[v][axis], positions[v][axis], 1e-12);
}

TEST(Wrl, ReadsAFaceSetAndTriangulatesPolygons) {
  const MeshFile file =
      parse_good(parse_wrl, kHead + face_set("coord " + kPoints + " coordIndex [0, 1, 2, 3, -1, 0 2 1]"));
  EXPECT_EQ(file.soup.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(triangles_of(file), "0 1 2 | 0 2 3 | 0 2 1");
  EXPECT_EQ(file.polygons, 1u);
  EXPECT_EQ(file.format, "VRML97");
}

TEST(Wrl, TakesFieldsInAnyOrderAndTurnsClockwiseFaces) {
  const MeshFile file =
      parse_good(parse_wrl, kHead + face_set("coordIndex [0 1 2 -1]\nccw FALSE # turned\ncoord " + kPoints));
  EXPECT_EQ(triangles_of(file), "0 2 1");
}

TEST(Wrl, PutsSeveralShapesOneAfterTheOther) {
  const std::string shape = face_set("coord " + kPoints + " coordIndex [0 1 2 -1]");
  const MeshFile file = parse_good(parse_wrl, kHead + "Group { children [ " + shape + shape + " ] }");
  EXPECT_EQ(triangles_of(file), "0 1 2 | 4 5 6");
}

TEST(Wrl, DropsAppearanceAndAttributesAndNotesThem) {
  const MeshFile file = parse_good(
      parse_wrl, kHead + "WorldInfo { title \"a { \\\" # brace\" }\n" +
                     "Shape { appearance DEF A Appearance { material Material { diffuseColor 1 0 0 } }\n" +
                     "geometry IndexedFaceSet { coord " + kPoints +
                     " coordIndex [0 1 2 -1] normal Normal { vector [0 0 1] } solid FALSE } }\n" +
                     "Shape { appearance USE A geometry IndexedLineSet { coord " + kPoints +
                     " coordIndex [0 1 -1] } }\n");
  EXPECT_EQ(triangles_of(file), "0 1 2");
  EXPECT_EQ(file.soup.positions.size(), 4u);
  for (const char* type : {"Material", "Normal", "IndexedLineSet"}) EXPECT_TRUE(has_note(file, type)) << type;
}

TEST(Wrl, FaceSetsThatShareACoordinateShareVertices) {
  const MeshFile file =
      parse_good(parse_wrl, kHead + face_set("coord DEF P " + kPoints + " coordIndex [0 1 2 -1]") +
                                face_set("coord USE P coordIndex [0 2 3 -1]"));
  EXPECT_EQ(file.soup.positions.size(), 4u);
  EXPECT_EQ(triangles_of(file), "0 1 2 | 0 2 3");
}

TEST(Wrl, ACoordinateUsedUnderAnotherTransformIsCopied) {
  const MeshFile file =
      parse_good(parse_wrl, kHead + face_set("coord DEF P " + kPoints + " coordIndex [0 1 2 -1]") +
                                "Transform { translation 0 0 5 children " +
                                face_set("coord USE P coordIndex [0 2 3 -1]") + " }");
  EXPECT_EQ(triangles_of(file), "0 1 2 | 4 6 7");
  EXPECT_EQ(file.soup.positions[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(file.soup.positions[4], (Vec3{0, 0, 5}));
}

TEST(Wrl, AppliesNestedTransformsInnerFirst) {
  const std::string shape = face_set("coord Coordinate { point [1 0 0, 0 1 0, 0 0 1] } coordIndex [0 1 2]");
  expect_near(
      parse_good(parse_wrl,
                 kHead + "Transform { children [ Transform { translation 1 0 0 scale 2 3 4 children [" +
                     shape + "] } ] rotation 0 0 2 1.5707963267948966 translation 10 0 0 }"),
      {{10, 3, 0}, {7, 1, 0}, {10, 1, 4}});
}

TEST(Wrl, TurnsAndScalesAboutTheCenter) {
  const std::string shape = face_set("coord Coordinate { point [2 1 0, 1 2 0, 1 1 1] } coordIndex [0 1 2]");
  expect_near(parse_good(parse_wrl, kHead + "Transform { center 1 1 0 scale 2 1 1 " +
                                        "scaleOrientation 0 0 1 1.5707963267948966 children " + shape + "}"),
              {{2, 1, 0}, {1, 3, 0}, {1, 1, 1}});  // the stretch acts along y
}

TEST(Wrl, RefusesWhatWouldLoseGeometry) {
  for (const std::string node : {"Box { }", "Sphere { radius 2 }", "Inline { url \"a.wrl\" }", "LOD { }",
                                 "Switch { }", "Transform { scale 1 -1 1 }", "PROTO P [ ] { }"}) {
    expect_error(parse_wrl, kHead + node, "line 2: ", ErrorCode::Unsupported);
  }
  expect_error(parse_wrl,
               kHead + "DEF S " + face_set("coord " + kPoints + " coordIndex [0 1 2]") +
                   "Transform { children USE S }",
               "line 3: USE of a node that holds geometry is not supported", ErrorCode::Unsupported);
  expect_error(parse_wrl, "#VRML V1.0 ascii\nSeparator { }\n", "VRML 1.0 cannot be read",
               ErrorCode::Unsupported);
}

TEST(Wrl, RefusesBrokenFilesWithTheirLine) {
  expect_error(parse_wrl, "Shape { }\n", "line 1: not a VRML97 file");
  expect_error(parse_wrl, kHead + face_set("coord " + kPoints + "\ncoordIndex [0 1 4 -1]"),
               "line 3: a face names vertex 4, but its Coordinate has 4 points");
  expect_error(parse_wrl, kHead + face_set("coord " + kPoints + " coordIndex [0 1 -2]"),
               "line 2: not a vertex index: -2");
  expect_error(parse_wrl, kHead + face_set("coordIndex [0 1 2]"), "its Coordinate has 0 points");
  expect_error(parse_wrl, kHead + face_set("coord Coordinate { point [0 0 nan] }"),
               "line 2: expected a finite number, found 'nan'");
  expect_error(parse_wrl, kHead + face_set("coord Coordinate { point [0 0 0 1 1] }"),
               "line 2: expected a finite number, found ']'");
  expect_error(parse_wrl, kHead + face_set("coord USE P coordIndex [0 1 2]"),
               "line 2: USE of 'P', which no DEF before it names");
  expect_error(parse_wrl, kHead + face_set("ccw MAYBE"), "line 2: expected TRUE or FALSE, found 'MAYBE'");
  expect_error(parse_wrl, kHead + "Shape {\n\n", "the file ends inside Shape of line 2");
  expect_error(parse_wrl, kHead + "Shape { ] }", "a ']' that closes nothing");
  expect_error(parse_wrl, kHead + "}", "a '}' that closes nothing");
  expect_error(parse_wrl, kHead + "WorldInfo { title \"open",
               "the string that begins on line 2 does not end");
  expect_error(parse_wrl, kHead, "it has no vertices");
}

TEST(Wrl, BoundsDepthAndRepeatedCoordinates) {
  std::string deep = kHead;
  for (int i = 0; i < 300; ++i) deep += "Group { children ";
  expect_error(parse_wrl, deep, "nested too deep", ErrorCode::LimitExceeded);
  std::string points = "Coordinate { point [";
  for (int i = 0; i < 1000; ++i) points += "0 0 0 ";
  std::string repeated = kHead + face_set("coord DEF P " + points + "] } coordIndex [0 1 2]");
  for (int i = 0; i < 100; ++i)
    repeated += "Transform { children " + face_set("coord USE P coordIndex [0 1 2]") + "}";
  expect_error(parse_wrl, repeated, "repeated by USE too often", ErrorCode::LimitExceeded);
}

}  // namespace
}  // namespace selvage
