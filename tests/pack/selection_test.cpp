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

PartId page(std::uint32_t number) { return {PartKind::Page, number, 0}; }

TEST(Selection, PagesComeBeforeWhatTheyListAndWhatItsBundleTouches) {
  const auto pack = Pack::from_bytes(fake_pack_bytes(150)).value();
  const auto with = [&](Pages pages) {
    return with_pages(pack->directory(), {{PartKind::Region, 10, 0}, bundle(128)}, pages);
  };
  EXPECT_EQ(with(Pages::None), (std::vector<PartId>{{PartKind::Region, 10, 0}, bundle(128)}));
  const std::vector<PartId> needed{page(0), {PartKind::Region, 10, 0}, page(2), page(1), bundle(128)};
  EXPECT_EQ(with(Pages::Needed), needed);
  EXPECT_EQ(with(Pages::All), needed);
  EXPECT_EQ(with_pages(pack->directory(), {}, Pages::All), (std::vector<PartId>{page(0), page(1), page(2)}));
}

TEST(Selection, NeedsThePagesOfWhatIsSelected) {
  const auto pack = Pack::from_bytes(fake_pack_bytes(150)).value();
  const auto bytes = pack->directory_bytes();
  Directory directory = parse_summary(bytes.first(pack->header().summary_size), bytes.size()).value();
  const Selection some{.kind = Selection::Kind::Ids, .ids = {70}, .joins = Joins::None};
  const Selection box{.kind = Selection::Kind::Box, .box = {{70, 0, 0}, {71, 1, 1}}, .joins = Joins::None};
  for (const Selection& selection : {some, box}) {
    const auto early = select_regions(directory, selection);
    ASSERT_FALSE(early);
    EXPECT_EQ(early.error().code, ErrorCode::InvalidArgument);
    EXPECT_NE(early.error().message.find("page 1 "), std::string::npos) << early.error().message;
  }
  ASSERT_TRUE(read_page(directory, 1, pack->part(pack->directory().pages[1].part)));
  EXPECT_EQ(select_regions(directory, some).value(), (std::vector<RegionId>{70}));
  EXPECT_EQ(select_regions(directory, box).value(), (std::vector<RegionId>{69, 70, 71}));
  EXPECT_FALSE(select_regions(directory, {}));
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

/// Regions of row_of_five with levels: 0, 1 and, the same as 1, 2; region 5 has 0 alone.
Directory row_with_levels() {
  Directory directory = row_of_five();
  for (RegionId id = 1; id < 5; ++id) {
    auto& levels = directory.regions[id].levels;
    levels.push_back({.part = {.size = 7}, .vertices = 4, .triangles = 2, .deviation = 1, .dropped_bits = 2});
    levels.push_back(levels.back());
    levels.back().is_repeat = true;
  }
  return directory;
}

std::vector<int> levels_in(const Directory& directory, const Selection& selection) {
  std::vector<int> levels;
  const auto parts = select_parts(directory, selection).value();
  for (const PartId& part : parts) {
    if (part.kind == PartKind::Region) levels.push_back(part.level);
  }
  return levels;
}

TEST(Selection, GivesEveryRegionItsLevel) {
  const Directory directory = row_with_levels();
  EXPECT_EQ(levels_in(directory, {.level = 1}), (std::vector<int>{1, 1, 1, 1, 0}));
  EXPECT_EQ(levels_in(directory, {.level = 2}), (std::vector<int>{1, 1, 1, 1, 0}));
  Selection mixed{.level = 1};
  mixed.levels = {{2, 1}, {2, 0}, {3, 0}, {3, 2}, {4, 9}, {77, 0}};
  EXPECT_EQ(levels_in(directory, mixed), (std::vector<int>{1, 0, 0, 1, 0}));
}

TEST(Selection, ParsesLevels) {
  Directory directory = row_with_levels();
  directory.names = {{"a", {{1, 2}}}, {"b@1", {{4, 4}}}};
  const auto levels = [&](const char* text, std::uint8_t level) {
    Selection selection = parse_region_list(text).value();
    selection.level = level;
    return levels_in(directory, resolve_names(directory, selection).value());
  };
  EXPECT_EQ(levels("3@0,1-2@1", 0), (std::vector<int>{1, 1, 0}));
  EXPECT_EQ(levels("3,1-2@0", 1), (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(levels("a@1,b@1@0,2@0", 1), (std::vector<int>{1, 0, 0}));
  EXPECT_EQ(parse_region_list("a@b").value().names, (std::vector<std::string>{"a@b"}));
  for (const char* bad : {"1@256", "@1", "1-@1", "a@999"}) EXPECT_FALSE(parse_region_list(bad)) << bad;
}

}  // namespace
}  // namespace selvage
