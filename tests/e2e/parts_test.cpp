// SPDX-License-Identifier: MIT
//
// The user's own parts, through the whole system: a name brings back its triangles, no more and no fewer, and
// the whole is still the same mesh.
#include "server/ingest/parts.h"

#include <algorithm>
#include <random>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "common/mesh/same_mesh.h"
#include "common/mesh_io/obj.h"
#include "server/ingest/ingest.h"
#include "tests/support/shapes.h"
#include "tests/support/unpack.h"

namespace selvage {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

std::shared_ptr<const Pack> pack_of(const TriangleSoup& soup, Parts parts,
                                    const SegmentOptions& segment = {}) {
  const IngestOptions options{.name = "parts", .bits = 20, .parts = std::move(parts), .segment = segment};
  auto model = ingest(soup, options, serial_for(), [](const std::string&, double) { return true; });
  EXPECT_TRUE(model) << model.error().message;
  auto pack = Pack::from_bytes(std::move(model->pack));
  EXPECT_TRUE(pack) << pack.error().message;
  return *pack;
}

/// The triangles whose part is among `wanted`, with no vertex that they do not use.
TriangleSoup triangles_of(const TriangleSoup& soup, const std::vector<std::uint32_t>& part_of_triangle,
                          const std::set<std::uint32_t>& wanted) {
  TriangleSoup picked;
  std::vector<VertexId> new_of_old(soup.positions.size(), kNone);
  for (TriangleId t = 0; t < soup.triangles.size(); ++t) {
    if (!wanted.contains(part_of_triangle[t])) continue;
    Triangle corners = soup.triangles[t];
    for (VertexId& v : corners) {
      if (new_of_old[v] == kNone) {
        new_of_old[v] = static_cast<VertexId>(picked.positions.size());
        picked.positions.push_back(soup.positions[v]);
      }
      v = new_of_old[v];
    }
    picked.triangles.push_back(corners);
  }
  return picked;
}

void expect_same(const TriangleSoup& expected, const Pack& pack, const std::string& regions) {
  Selection selection;
  if (!regions.empty())
    selection = resolve_names(pack.directory(), parse_region_list(regions).value()).value();
  const auto stitched = unpack(pack, selection);
  ASSERT_TRUE(stitched) << stitched.error().message;
  EXPECT_EQ(stitched->soup.positions.size(), expected.positions.size());
  const MeshComparison comparison = compare_meshes(expected, stitched->soup, pack.directory().grid.step / 2);
  EXPECT_TRUE(comparison.same) << regions << ": " << comparison.difference;
}

/// Every name gives exactly its triangles, and so does the whole.
void expect_exact(const TriangleSoup& soup, const Parts& parts, const SegmentOptions& segment = {}) {
  const auto pack = pack_of(soup, parts, segment);
  expect_same(soup, *pack, "");
  EXPECT_EQ(pack->directory().names.size(), parts.parts_of_name.size());
  for (const auto& [name, list] : parts.parts_of_name)
    expect_same(triangles_of(soup, parts.of_triangle, {list.begin(), list.end()}), *pack, "=" + name);
}

/// A car of a kind: a torus in three groups whose borders meet in rims, and a ball in two materials.
std::string car_obj() {
  const TriangleSoup torus = shapes::torus(24, 60), ball = shapes::translated(shapes::sphere(4), {9, 0, 0});
  std::ostringstream out;
  out.precision(17);
  for (const TriangleSoup* soup : {&torus, &ball}) {
    for (const Vec3& p : soup->positions) out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  }
  out << "o body\n";
  for (std::size_t t = 0; t < torus.triangles.size(); ++t) {
    if (t == 0) out << "g wheel_left wheels\n";
    if (t == 1000) out << "g wheel_right wheels\n";
    if (t == 1500) out << "g axle\n";
    const auto& [a, b, c] = torus.triangles[t];
    out << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  }
  out << "o Front Lamp\ng\n";
  const std::size_t first = torus.positions.size() + 1;
  for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
    if (t == 0) out << "usemtl glass\n";
    if (t == 700) out << "usemtl chrome, polished\n";
    const auto& [a, b, c] = ball.triangles[t];
    out << "f " << a + first << ' ' << b + first << ' ' << c + first << '\n';
  }
  return out.str();
}

TEST(Parts, ObjGroupsComeBackExactly) {
  const MeshFile file = parse_obj(bytes_of(car_obj())).value();
  const Parts parts = parts_of_groups(file).value();
  std::vector<std::string> names;
  for (const auto& [name, list] : parts.parts_of_name) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"Front Lamp", "axle", "body", "chrome_ polished", "glass",
                                             "wheel_left", "wheel_right", "wheels"}));
  expect_exact(file.soup, parts);
}

TEST(Parts, LargeOnesBecomeSeveralRegionsOfOneName) {
  const MeshFile file = parse_obj(bytes_of(car_obj())).value();
  const Parts parts = parts_of_groups(file).value();
  const SegmentOptions small{.max_region_vertices = 60};
  EXPECT_GT(pack_of(file.soup, parts, small)->directory().real_region_count(), 20u);
  expect_exact(file.soup, parts, small);
}

TEST(Parts, NamesAddUpAndMixWithNumbers) {
  const MeshFile file = parse_obj(bytes_of(car_obj())).value();
  const Parts parts = parts_of_groups(file).value();
  const auto pack = pack_of(file.soup, parts);
  const auto& glass = parts.parts_of_name.at("glass");
  const auto& axle = parts.parts_of_name.at("axle");
  const RegionId axle_region = pack->directory().find_name("axle")->ranges.at(0).first;
  expect_same(triangles_of(file.soup, parts.of_triangle, {glass[0], axle[0]}), *pack,
              "glass," + std::to_string(axle_region));
}

TEST(Parts, AMaterialCalledLikeAGroupKeepsApart) {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\ng lamp\nf 1 2 3\ng body\nusemtl lamp\nf 2 4 3\n";
  const MeshFile file = parse_obj(bytes_of(text)).value();
  const Parts parts = parts_of_groups(file).value();
  EXPECT_EQ(parts.parts_of_name.at("lamp"), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(parts.parts_of_name.at("usemtl lamp"), (std::vector<std::uint32_t>{1}));
  expect_exact(file.soup, parts);
}

TEST(Parts, GroupsNeedAFileThatNamesThem) {
  const auto parts = parts_of_groups(MeshFile{.soup = shapes::triangle()});
  ASSERT_FALSE(parts);
  EXPECT_NE(parts.error().message.find("no g, o or usemtl"), std::string::npos);
}

TEST(Parts, ComponentsComeBackExactlyEvenAsDust) {
  TriangleSoup soup = shapes::torus(10, 20);
  for (int i = 0; i < 30; ++i)
    shapes::append(soup, shapes::translated(shapes::tetrahedron(), {double(5 + i), 0.3 * i, 0}));
  const Parts parts = parts_of_components(soup);
  EXPECT_EQ(parts.parts_of_name.size(), 31u);
  expect_exact(soup, parts);
}

TEST(Parts, SmallPiecesOfOnePartShareARegion) {
  TriangleSoup soup;
  std::string labels;
  for (int i = 0; i < 40; ++i) {
    shapes::append(soup, shapes::translated(shapes::tetrahedron(), {3.0 * i, 0, 0}));
    for (int t = 0; t < 4; ++t) labels += i % 2 == 0 ? "7\n" : "-8\n";
  }
  const Parts parts = parse_part_labels(bytes_of(labels), soup).value();
  EXPECT_EQ(pack_of(soup, parts)->directory().real_region_count(), 2u);
  expect_exact(soup, parts);
}

TEST(Parts, AnyLabelsOfTrianglesComeBackExactly) {
  std::mt19937 random(3);
  for (const TriangleSoup& soup : {shapes::torus(12, 30), shapes::grid_with_holes(16, 16, 4),
                                   shapes::mobius_strip(30), shapes::tetrahedron()}) {
    for (std::uint32_t count : {1u, 2u, 7u, 500u}) {
      std::string labels;
      for (std::size_t t = 0; t < soup.triangles.size(); ++t)
        labels += std::to_string(random() % count) + (t % 3 == 0 ? " " : "\n");
      SCOPED_TRACE(std::to_string(soup.triangles.size()) + " triangles, labels below " +
                   std::to_string(count));
      expect_exact(soup, parse_part_labels(bytes_of(labels), soup).value(),
                   {.max_region_vertices = count == 2 ? 12u : 0u});
    }
  }
}

TEST(Parts, LabelsOfVerticesGoThroughJoins) {
  const TriangleSoup soup = shapes::torus(20, 40);
  std::string labels;
  for (const Vec3& p : soup.positions) labels += p.x < 0 ? "1\n" : "2\n";
  const Parts parts = parse_part_labels(bytes_of(labels), soup).value();
  ASSERT_EQ(parts.of_vertex.size(), soup.positions.size());
  const auto pack = pack_of(soup, parts);
  EXPECT_EQ(pack->directory().source.cut_vertices, 0u);
  EXPECT_GT(pack->directory().boundary_triangles, 0u);
  expect_same(soup, *pack, "");
  std::size_t inside = 0;
  for (const Triangle& t : soup.triangles)
    inside += std::all_of(t.begin(), t.end(), [&](VertexId v) { return soup.positions[v].x < 0; });
  const auto half =
      unpack(*pack, resolve_names(pack->directory(), parse_region_list("label_1").value()).value()).value();
  EXPECT_EQ(half.soup.triangles.size(), inside);
}

TEST(Parts, LabelFilesSayWhatIsWrongAndWhere) {
  const TriangleSoup soup = shapes::grid(2, 2);  // 8 triangles, 9 vertices
  const auto message = [&](const std::string& text) {
    const auto parts = parse_part_labels(bytes_of(text), soup);
    return parts ? std::string() : parts.error().message;
  };
  EXPECT_EQ(message("1 2 3 4 5 6 7 8"), "");
  EXPECT_EQ(message("1\n2\n3\n4\n5\n6\n7\n8\n9\n"), "");
  EXPECT_EQ(message("# eight\n1\n2\r\n3\n\n4\n5\n6\n7\n8"), "");
  EXPECT_NE(message("1\n2\n").find("2 labels, but the model has 8 triangles and 9 vertices"),
            std::string::npos);
  EXPECT_NE(message(std::string(40, '\n')).find("0 labels"), std::string::npos);
  EXPECT_NE(message("1\n2\nred\n").find("line 3: expected a label, which is an integer, found 'red'"),
            std::string::npos);
  EXPECT_NE(message("1\n2.5\n").find("line 2"), std::string::npos);
  EXPECT_NE(message("99999999999999999999").find("line 1"), std::string::npos);
  std::string many;
  for (int i = 0; i < 100000; ++i) many += "1\n";
  EXPECT_NE(message(many).find("100000 labels"), std::string::npos);
}

/// Along a rim, groups differ by one from vertex to vertex on both sides, which costs next to nothing; a copy's
/// position, some seven bytes on this fine grid, is the price.
TEST(Parts, CutsCostLittle) {
  const TriangleSoup soup = shapes::torus(60, 60);
  std::string labels;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    labels += t < soup.triangles.size() / 2 ? "1\n" : "2\n";
  const auto pack = pack_of(soup, parse_part_labels(bytes_of(labels), soup).value());
  std::string one;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) one += "1\n";
  const auto whole = pack_of(soup, parse_part_labels(bytes_of(one), soup).value());
  const std::uint32_t copies = pack->directory().source.cut_vertices;
  EXPECT_GE(copies, 120u);
  EXPECT_LT(pack->bytes().size(), whole->bytes().size() + 12 * copies);
}

}  // namespace
}  // namespace selvage
