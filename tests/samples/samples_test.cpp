// SPDX-License-Identifier: MIT
#include "common/samples/samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>

#include <gtest/gtest.h>

#include "common/mesh/check_corner_table.h"
#include "common/mesh/corner_table.h"

namespace selvage {
namespace {

CornerTable table_of(const TriangleSoup& soup) {
  return build_corner_table(soup.triangles, static_cast<std::uint32_t>(soup.positions.size()));
}

int euler_characteristic(const TriangleSoup& soup) {  // of a closed mesh
  return static_cast<int>(soup.positions.size()) - static_cast<int>(soup.triangles.size()) / 2;
}

int count_components(const TriangleSoup& soup) {
  std::vector<std::uint32_t> leader(soup.positions.size());
  std::iota(leader.begin(), leader.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (leader[v] != v) v = leader[v] = leader[leader[v]];
    return v;
  };
  for (const auto& [a, b, c] : soup.triangles) leader[find(a)] = leader[find(b)] = find(c);
  int components = 0;
  for (std::uint32_t v = 0; v < leader.size(); ++v) components += leader[v] == v;
  return components;
}

double volume(const TriangleSoup& soup) {
  double sum = 0;
  for (const auto& [a, b, c] : soup.triangles)
    sum += dot(soup.positions[a], cross(soup.positions[b], soup.positions[c])) / 6;
  return sum;
}

double smallest_angle_degrees(const TriangleSoup& soup) {
  double least = 180;
  for (const Triangle& t : soup.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vec3& p = soup.positions[t[k]];
      const Vec3 a = normalised(soup.positions[t[(k + 1) % 3]] - p),
                 b = normalised(soup.positions[t[(k + 2) % 3]] - p);
      least = std::min(least, std::acos(std::clamp(dot(a, b), -1.0, 1.0)) * 57.29578);
    }
  }
  return least;
}

struct Expected {
  const char* name;
  int euler, components;
  bool is_smooth;
};

void PrintTo(const Expected& e, std::ostream* out) { *out << e.name; }

constexpr Expected kExpected[] = {{"waterneck", 0, 1, true},
                                  {"bracket", -12, 1, false},
                                  {"assembly", 0, 19, false},
                                  {"dumbbell", 2, 1, true}};

class Samples : public testing::TestWithParam<Expected> {};

TEST_P(Samples, AreClosedManifoldsOfTheStatedTopologyAtAnyResolution) {
  for (std::uint32_t about : {0u, 8'000u, 9'999u, 23'456u}) {
    SCOPED_TRACE(about);
    const auto soup = make_sample(GetParam().name, about);
    ASSERT_TRUE(soup);
    const CornerTable table = table_of(*soup);
    const auto ok = check_corner_table(table);
    EXPECT_TRUE(ok) << ok.error().message;
    EXPECT_EQ(std::ranges::count(table.opposite, kNone), 0);
    EXPECT_EQ(euler_characteristic(*soup), GetParam().euler);
    EXPECT_EQ(count_components(*soup), GetParam().components);
  }
}

TEST_P(Samples, AreOrientedOutwards) { EXPECT_GT(volume(*make_sample(GetParam().name)), 0); }

TEST_P(Samples, AreTheSameOnEveryRun) {
  const auto one = make_sample(GetParam().name, 8'000), two = make_sample(GetParam().name, 8'000);
  EXPECT_EQ(one->positions, two->positions);
  EXPECT_EQ(one->triangles, two->triangles);
}

TEST_P(Samples, ComeCloseToTheNumberOfTrianglesAskedFor) {
  for (std::uint32_t about : {8'000u, 20'000u, 60'000u}) {
    const auto count = static_cast<double>(make_sample(GetParam().name, about)->triangles.size());
    const double slack = GetParam().is_smooth ? 1.1 : 1.6;
    EXPECT_GT(count, about / slack) << about;
    EXPECT_LT(count, about * slack) << about;
  }
}

TEST_P(Samples, HaveNoTrianglesWithoutArea) {
  const auto soup = make_sample(GetParam().name);
  for (const auto& [a, b, c] : soup->triangles) {
    const Vec3& p = soup->positions[a];
    ASSERT_GT(length(cross(soup->positions[b] - p, soup->positions[c] - p)), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Samples, testing::ValuesIn(kExpected),
                         [](const auto& p) { return p.param.name; });

TEST(SmoothSamples, HaveNoSlivers) {  // CAD triangles are thin by nature
  for (const char* name : {"waterneck", "dumbbell"})
    EXPECT_GT(smallest_angle_degrees(*make_sample(name, 20'000)), 12) << name;
}

TEST(SampleNames, CoverAllExpectations) {
  std::vector<std::string> expected;
  for (const Expected& e : kExpected) expected.push_back(e.name);
  EXPECT_EQ(sample_names(), expected);
  for (const std::string& name : sample_names()) EXPECT_NE(describe_sample(name), "");
}

TEST(SampleNames, RefuseOthersAndNameThemselves) {
  const auto none = make_sample("teapot");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::NotFound);
  EXPECT_NE(none.error().message.find("waterneck"), std::string::npos);
}

TEST(SampleNames, RefuseAbsurdSizes) {
  for (std::uint32_t about : {1u, 999u, 4'000'001u, 0xFFFFFFFFu})
    EXPECT_EQ(make_sample("dumbbell", about).error().code, ErrorCode::InvalidArgument);
}

}  // namespace
}  // namespace selvage
