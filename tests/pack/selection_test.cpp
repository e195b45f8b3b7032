// SPDX-License-Identifier: MIT
#include "common/pack/selection.h"

#include <gtest/gtest.h>

#include "tests/support/fake_pack.h"

namespace selvage {
namespace {

const Directory& row_of_five() {
  static const auto pack = Pack::from_bytes(fake_pack_bytes(5)).value();
  return pack->directory();
}

std::vector<PartId> regions(std::initializer_list<RegionId> ids) {
  std::vector<PartId> parts;
  for (RegionId id : ids) parts.push_back({PartKind::Region, id, 0});
  return parts;
}

PartId bundle(RegionId id) { return {PartKind::Bundle, id, 0}; }

TEST(Selection, WithoutJoinsGivesJustTheRegions) {
  EXPECT_EQ(
      select_parts(row_of_five(), {.kind = Selection::Kind::Ids, .ids = {4, 2, 4}, .joins = Joins::None})
          .value(),
      regions({2, 4}));
}

TEST(Selection, ClosureAddsTheBundlesBetweenSelectedRegions) {
  auto expected = regions({1, 3, 4});
  expected.push_back(bundle(4));
  EXPECT_EQ(
      select_parts(row_of_five(), {.kind = Selection::Kind::Ids, .ids = {1, 3, 4}, .joins = Joins::Closure})
          .value(),
      expected);
}

TEST(Selection, AllJoinsReachToUnselectedNeighbours) {
  const auto parts =
      select_parts(row_of_five(), {.kind = Selection::Kind::Ids, .ids = {3}, .joins = Joins::All}).value();
  EXPECT_EQ(parts, (std::vector<PartId>{{PartKind::Region, 3, 0}, bundle(3), bundle(4)}));
}

TEST(Selection, BoxMeetsRegionsInModelUnits) {
  const Selection box{.kind = Selection::Kind::Box, .box = {{2.5, 0, 0}, {3.5, 1, 1}}, .joins = Joins::None};
  EXPECT_EQ(select_regions(row_of_five(), box).value(), (std::vector<RegionId>{2, 3}));
}

TEST(Selection, NamesARegionThatIsNotThere) {
  for (RegionId id : {0u, 6u}) {
    const auto missing = select_parts(row_of_five(), {.kind = Selection::Kind::Ids, .ids = {id}});
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::NotFound);
    EXPECT_NE(missing.error().message.find("no region " + std::to_string(id)), std::string::npos);
  }
}

TEST(Selection, ParsesListsAndBoxes) {
  EXPECT_EQ(parse_region_list("3,5-7")->ids, (std::vector<RegionId>{3, 5, 6, 7}));
  EXPECT_EQ(parse_region_list("4294967295")->ids, (std::vector<RegionId>{4294967295u}));
  for (const char* bad : {"", "3,", "7-5", "1-", "-1", "1-4000000000", "=", ",a"})
    EXPECT_FALSE(parse_region_list(bad)) << bad;
  EXPECT_EQ(parse_box("1,2,3,0,5,-6")->min.z, -6);
  for (const char* bad : {"", "1,2,3", "1,2,3,4,5,x", "1,2,3,4,5,inf"}) EXPECT_FALSE(parse_box(bad)) << bad;
}

TEST(Selection, ParsesNamesBesideNumbers) {
  const Selection listed = parse_region_list("wheel_left,3,Big Wheel,5-6,=7,a-1").value();
  EXPECT_EQ(listed.kind, Selection::Kind::Ids);
  EXPECT_EQ(listed.ids, (std::vector<RegionId>{3, 5, 6}));
  EXPECT_EQ(listed.names, (std::vector<std::string>{"wheel_left", "Big Wheel", "7", "a-1"}));
}

TEST(Selection, ResolvesNamesToTheirRegions) {
  Directory directory = row_of_five();
  directory.names = {{"a", {{1, 2}, {5, 5}}}, {"b", {{4, 4}}}};
  const Selection all = resolve_names(directory, parse_region_list("b,a,3").value()).value();
  EXPECT_EQ(select_regions(directory, all).value(), (std::vector<RegionId>{1, 2, 3, 4, 5}));
  const auto missing = resolve_names(directory, parse_region_list("c").value());
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::NotFound);
  EXPECT_NE(missing.error().message.find("'c'; there are a, b"), std::string::npos);
}

TEST(Selection, UnknownNamesAreAnsweredWithThoseMostLikeThem) {
  Directory directory = row_of_five();
  for (int i = 0; i < 30; ++i) directory.names.push_back({"bolt_" + std::to_string(i), {{1, 1}}});
  directory.names.push_back({"wheel_left", {{1, 1}}});
  const auto missing = resolve_names(directory, parse_region_list("Wheel_lift").value());
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("most like it are wheel_left, "), std::string::npos);
  EXPECT_NE(missing.error().message.find("and 21 others"), std::string::npos);
}

}  // namespace
}  // namespace selvage
