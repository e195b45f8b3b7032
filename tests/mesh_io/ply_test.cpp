// SPDX-License-Identifier: MIT
#include "common/mesh_io/ply.h"

#include <bit>

#include "tests/mesh_io/support.h"

namespace selvage {
namespace {

/// Binary PLY bodies, byte by byte, in either order.
class Body {
 public:
  explicit Body(bool is_big_endian) : is_big_endian_(is_big_endian) {}

  template <class Unsigned>
  Body& u(Unsigned value) {
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
      const std::size_t byte = is_big_endian_ ? sizeof(Unsigned) - 1 - i : i;
      text_.push_back(static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * byte)));
    }
    return *this;
  }
  Body& f(float value) { return u(std::bit_cast<std::uint32_t>(value)); }
  Body& d(double value) { return u(std::bit_cast<std::uint64_t>(value)); }
  const std::string& text() const { return text_; }

 private:
  bool is_big_endian_;
  std::string text_;
};

std::string header(const std::string& format, const std::string& elements) {
  return "ply\nformat " + format + " 1.0\ncomment made by hand\n" + elements + "end_header\n";
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kTriangleElements =
    "element vertex 3\n" + kXyz + "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kAsciiTriangle = header("ascii", kTriangleElements) + "0 0 0\n1 0 0\n0 1.5 0\n3 0 1 2\n";

std::string binary_triangle(bool is_big_endian) {
  Body body(is_big_endian);
  body.f(0).f(0).f(0).f(1).f(0).f(0).f(0).f(1.5f).f(0);
  body.u(std::uint8_t{3}).u(std::uint32_t{0}).u(std::uint32_t{1}).u(std::uint32_t{2});
  return header(is_big_endian ? "binary_big_endian" : "binary_little_endian", kTriangleElements) +
         body.text();
}

const TriangleSoup kTriangle = {{{0, 0, 0}, {1, 0, 0}, {0, 1.5, 0}}, {{0, 1, 2}}};

TEST(Ply, ReadsAscii) {
  const MeshFile file = parse_good(parse_ply, kAsciiTriangle);
  expect_same(file.soup, kTriangle);
  EXPECT_EQ(file.format, "PLY ascii");
  EXPECT_TRUE(file.notes.empty());
}

TEST(Ply, ReadsBothByteOrders) {
  for (bool is_big_endian : {false, true}) {
    const MeshFile file = parse_good(parse_ply, binary_triangle(is_big_endian));
    expect_same(file.soup, kTriangle);
    EXPECT_EQ(file.format, is_big_endian ? "PLY binary big-endian" : "PLY binary little-endian");
  }
}

TEST(Ply, ReadsLineEndsOfAllSystems) {
  for (const std::string end : {"\r\n", "\r"}) {
    std::string text;
    for (char c : kAsciiTriangle) text += c == '\n' ? end : std::string(1, c);
    expect_same(parse_good(parse_ply, text).soup, kTriangle);
  }
}

TEST(Ply, StepsOverEverythingElseAndSaysSo) {
  for (bool is_big_endian : {false, true}) {
    const std::string elements =
        "element camera 2\nproperty double fov\nproperty list ushort short pixels\n"
        "element vertex 3\nproperty uchar red\nproperty double z\nproperty short x\nproperty list uint "
        "double tags\n"
        "property int8 y\nelement face 2\nproperty uint16 flags\nproperty list int32 uint8 vertex_index\n"
        "property list uchar float texcoord\nelement nothing 1152921504606846976\n";
    Body body(is_big_endian);
    for (int i = 0; i < 2; ++i) body.d(0.5).u(std::uint16_t{2}).u(std::uint16_t{7}).u(std::uint16_t{8});
    for (int i = 0; i < 3; ++i) {
      body.u(std::uint8_t{255}).d(i + 0.25).u(static_cast<std::uint16_t>(-i)).u(std::uint32_t{1}).d(9.0);
      body.u(static_cast<std::uint8_t>(i * i));
    }
    for (int i = 0; i < 2; ++i) {
      body.u(std::uint16_t{1}).u(std::uint32_t{3});
      for (int k : {0, 1, 2}) body.u(static_cast<std::uint8_t>(k));
      body.u(std::uint8_t{1}).f(0.5f);
    }
    const std::string format = is_big_endian ? "binary_big_endian" : "binary_little_endian";
    const MeshFile file = parse_good(parse_ply, header(format, elements) + body.text());
    EXPECT_EQ(file.soup.positions, (std::vector<Vec3>{{0, 0, 0.25}, {-1, 1, 1.25}, {-2, 4, 2.25}}));
    EXPECT_EQ(triangles_of(file), "0 1 2 | 0 1 2");
    EXPECT_TRUE(has_note(file, "element camera dropped"));
    EXPECT_TRUE(has_note(file, "vertex attributes dropped: red tags"));
    EXPECT_TRUE(has_note(file, "face attributes dropped: flags texcoord"));
  }
}

TEST(Ply, TriangulatesPolygonsAsFansAndLeavesShortFacesOut) {
  const MeshFile file =
      parse_good(parse_ply, header("ascii", "element vertex 5\n" + kXyz +
                                                "element face 3\nproperty list uchar int vertex_indices\n") +
                                "0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n5 4 0 1 2 3\n2 0 1\n3 2 2 0\n");
  EXPECT_EQ(triangles_of(file), "4 0 1 | 4 1 2 | 4 2 3 | 2 2 0");
  EXPECT_EQ(file.polygons, 1u);
  EXPECT_TRUE(has_note(file, "1 polygons triangulated"));
  EXPECT_TRUE(has_note(file, "1 faces with fewer than three corners"));
}

TEST(Ply, UnrollsTriangleStrips) {
  const MeshFile file = parse_good(
      parse_ply, header("ascii", "element vertex 5\n" + kXyz +
                                     "element tristrips 1\nproperty list int int vertex_indices\n") +
                     "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n8 0 1 2 3 -1 2 3 4\n");
  EXPECT_EQ(triangles_of(file), "0 1 2 | 2 1 3 | 2 3 4");
}

TEST(Ply, KeepsUnreferencedVertices) {
  const MeshFile file =
      parse_good(parse_ply, header("ascii", "element vertex 4\n" + kXyz +
                                                "element face 1\nproperty list uchar int vertex_indices\n") +
                                "0 0 0\n1 0 0\n9 9 9\n0 1 0\n3 0 1 3\n");
  EXPECT_EQ(file.soup.positions.size(), 4u);
}

TEST(Ply, ListItemsMayRunOverLines) {
  EXPECT_EQ(triangles_of(parse_good(parse_ply,
                                    header("ascii", kTriangleElements) + "0 0 0\n1 0 0\n0 1 0\n3 0\n1 2\n")),
            "0 1 2");
}

TEST(Ply, RefusesAFaceLineThatHoldsMoreThanTheHeaderDeclares) {
  expect_error(parse_ply, header("ascii", kTriangleElements) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0.5 0.5\n",
               "line 14: more values than the header declares (first '6')");
}

TEST(Ply, RefusesALineThatHoldsLess) {
  expect_error(parse_ply, header("ascii", kTriangleElements) + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n",
               "line 12: expected a finite coordinate, found the end of the line");
}

TEST(Ply, RefusesDataAfterTheLastElement) {
  expect_error(parse_ply, kAsciiTriangle + "3 0 1 2\n", "line 15: data after the last element");
  EXPECT_TRUE(parse(parse_ply, kAsciiTriangle + "\n\n"));
  const Error error = parse_bad(parse_ply, binary_triangle(false) + "xy");
  EXPECT_NE(error.message.find("2 bytes after the last element"), std::string::npos) << error.message;
  EXPECT_EQ(error.offset, binary_triangle(false).size());
}

TEST(Ply, RefusesNumbersThatAreNotFinite) {
  const auto with = [](const std::string& x) {
    return header("ascii", kTriangleElements) + "0 0 0\n" + x + " 0 0\n0 1 0\n3 0 1 2\n";
  };
  for (const std::string bad :
       {"nan", "inf", "-Infinity", "1e999", "1.2.3", "0x10", "1,5", "--1", "1e", "abc"}) {
    expect_error(parse_ply, with(bad), "line 12: expected a finite coordinate, found '" + bad);
  }
  EXPECT_EQ(parse_good(parse_ply, with("+1.25e+1")).soup.positions[1].x, 12.5);
  EXPECT_EQ(parse_good(parse_ply, with("1e-400")).soup.positions[1].x, 0);
}

TEST(Ply, RefusesBinaryNumbersThatAreNotFinite) {
  std::string text = binary_triangle(false);
  const std::size_t at = text.find("end_header\n") + 11 + 4;
  text.replace(at, 4, std::string("\0\0\x80\x7f", 4));
  const Error error = parse_bad(parse_ply, text);
  EXPECT_EQ(error.message, "a coordinate is not a finite number");
  EXPECT_EQ(error.offset, at);
}

TEST(Ply, RefusesIndicesOutOfRange) {
  for (const std::string bad : {"3", "-1", "4294967296"}) {
    expect_error(parse_ply, header("ascii", kTriangleElements) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 " + bad + "\n",
                 "line 14: a face names vertex " + bad + ", but the vertices are 0 to 2");
  }
  expect_error(parse_ply, header("ascii", kTriangleElements) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n",
               "line 14: expected an integer, found '1.5'");
}

TEST(Ply, RefusesAbsurdCountsBeforeAllocating) {
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string list = "element face 1\nproperty list uchar int vertex_indices\n";
    expect_error(parse_ply, header(format, "element vertex 1152921504606846976\n" + kXyz + list) + "0 0 0\n",
                 "declares 1152921504606846976 elements 'vertex'");
    expect_error(
        parse_ply,
        header(format, "element x 1152921504606846976\nproperty char c\nelement vertex 3\n" + kXyz + list),
        "more than the rest of the file can hold");
  }
  expect_error(parse_ply, header("ascii", "element vertex 99999999999999999999\n"),
               "expected the number of elements");
  expect_error(parse_ply, header("ascii", kTriangleElements) + "0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n",
               "claims 4000000000 items");
}

TEST(Ply, RefusesAnEmptyMesh) {
  const std::string list = "property list uchar int vertex_indices\n";
  expect_error(parse_ply, header("ascii", "element vertex 0\n" + kXyz + "element face 0\n" + list),
               "it has no vertices");
  expect_error(parse_ply, header("ascii", "element vertex 1\n" + kXyz) + "0 0 0\n",
               "1 vertices, but no triangles");
}

TEST(Ply, RefusesBrokenHeadersWithTheirLine) {
  expect_error(parse_ply, "plyx\n", "line 1: not a PLY file");
  expect_error(parse_ply, "ply\nformat ascii 2.0\n", "line 2: expected version 1.0, found '2.0'");
  expect_error(parse_ply, "ply\nformat middle_endian 1.0\n", "line 2: expected ascii, binary_little_endian");
  expect_error(parse_ply, "ply\nelement vertex 3\nend_header\n", "no format line");
  expect_error(parse_ply, "ply\nformat ascii 1.0\nproperty float x\n",
               "line 3: a property before the first element");
  expect_error(parse_ply, "ply\nformat ascii 1.0\nelement vertex -3\n",
               "line 3: expected the number of elements");
  expect_error(parse_ply, header("ascii", "element vertex 3\nproperty quad x\n"),
               "line 5: expected a PLY type");
  expect_error(parse_ply, header("ascii", "element v 1\nelement v 1\n"),
               "line 5: element 'v' is declared twice");
  expect_error(parse_ply, header("ascii", "elephant vertex 3\n"), "line 4: unknown statement 'elephant'");
  expect_error(parse_ply, "ply\nformat ascii 1.0\n", "no end_header line");
  expect_error(parse_ply, header("ascii", "element face 0\n"), "no element vertex");
  expect_error(parse_ply, header("ascii", "element vertex 1\nproperty float x\nproperty float y\n") + "0 0\n",
               "no properties x, y and z");
  expect_error(
      parse_ply,
      header("ascii", "element vertex 1\n" + kXyz + "element face 1\nproperty int n\n") + "0 0 0\n1\n",
      "no one list of integers named vertex_indices");
}

TEST(Ply, RefusesEveryTruncationOfABinaryFile) {
  for (bool is_big_endian : {false, true}) {
    const std::string whole = binary_triangle(is_big_endian);
    for (std::size_t length = 0; length < whole.size(); ++length) {
      EXPECT_FALSE(parse(parse_ply, std::string_view(whole).substr(0, length))) << length;
    }
  }
}

TEST(Ply, RefusesAsciiFilesThatLackLines) {
  const std::size_t body = kAsciiTriangle.find("end_header");
  for (std::size_t length = 0; length < kAsciiTriangle.size() - 2; ++length) {
    EXPECT_FALSE(parse(parse_ply, std::string_view(kAsciiTriangle).substr(0, length))) << length - body;
  }
}

}  // namespace
}  // namespace selvage
