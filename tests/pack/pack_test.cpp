// SPDX-License-Identifier: MIT
#include "common/pack/pack.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/fake_pack.h"

namespace selvage {
namespace {

TEST(Pack, RoundTripsItsDirectoryAndParts) {
  const auto pack = Pack::from_bytes(fake_pack_bytes(600));  // three directory pages
  ASSERT_TRUE(pack) << pack.error().message;
  const Directory& directory = (*pack)->directory();
  EXPECT_EQ(directory.name, "row");
  EXPECT_EQ(directory.real_region_count(), 600u);
  const RegionEntry& entry = directory.regions[300];
  EXPECT_EQ(entry.box_min, (GridPoint{300, 0, 0}));
  EXPECT_EQ(entry.lower_neighbours, (std::vector<RegionId>{299}));
  EXPECT_EQ(entry.loop_lengths, (std::vector<std::uint32_t>{4}));
  for (const RegionEntry& each : directory.regions) {
    for (const LevelEntry& level : each.levels)
      EXPECT_TRUE(check_part(level.part, (*pack)->part(level.part)));
    if (each.bundle.size > 0) {
      EXPECT_TRUE(check_part(each.bundle, (*pack)->part(each.bundle)));
    }
  }
}

TEST(Pack, ADirectoryCanBeReadPageByPageInAnyOrder) {
  const auto pack = Pack::from_bytes(fake_pack_bytes(150)).value();
  const Directory& whole = pack->directory();
  const auto bytes = pack->directory_bytes();
  auto paged = parse_summary(bytes.first(pack->header().summary_size), bytes.size());
  ASSERT_TRUE(paged) << paged.error().message;
  ASSERT_EQ(paged->pages.size(), 3u);
  EXPECT_EQ(paged->real_region_count(), 150u);
  EXPECT_FALSE(paged->has(5));
  for (std::uint32_t page : {2u, 0u, 0u, 1u}) {
    ASSERT_TRUE(read_page(*paged, page, pack->part(*paged->find({PartKind::Page, page, 0}))));
    EXPECT_TRUE(paged->pages[page].is_read);
  }
  for (RegionId id = 1; id <= 150; ++id) {
    EXPECT_EQ(paged->regions[id].levels[0].part.offset, whole.regions[id].levels[0].part.offset);
    EXPECT_EQ(paged->regions[id].bundle.offset, whole.regions[id].bundle.offset);
    EXPECT_EQ(paged->regions[id].bundle.hash, whole.regions[id].bundle.hash);
  }
  EXPECT_EQ(paged->find({PartKind::Page, 3, 0}), nullptr);
}

TEST(Pack, RefusesPagesThatTheSummaryDoesNotList) {
  const auto pack = Pack::from_bytes(fake_pack_bytes(600)).value();
  const auto bytes = pack->directory_bytes();
  const auto summary = bytes.first(pack->header().summary_size);
  Directory directory = parse_summary(summary, bytes.size()).value();
  const auto other = pack->part(pack->directory().pages[0].part);
  EXPECT_EQ(read_page(directory, 1, other).error().code, ErrorCode::BadStream);
  EXPECT_EQ(read_page(directory, 3, other).error().code, ErrorCode::BadStream);
  EXPECT_FALSE(directory.has(1));
  EXPECT_EQ(parse_summary(summary, bytes.size() - 1).error().code, ErrorCode::BadStream);
  EXPECT_EQ(parse_summary(summary, bytes.size() + 1).error().code, ErrorCode::BadStream);
  EXPECT_EQ(parse_summary(summary, bytes.size(), 600).error().code, ErrorCode::LimitExceeded);
}

TEST(Pack, OpensAFileAndNamesItInErrors) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("selvage_pack_test_" + std::to_string(::getpid()) + ".selvage");
  const Bytes bytes = fake_pack_bytes(2);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  EXPECT_TRUE(Pack::open(path));
  std::filesystem::resize_file(path, bytes.size() - 1);
  const auto truncated = Pack::open(path);
  ASSERT_FALSE(truncated);
  EXPECT_NE(truncated.error().message.find(path.string()), std::string::npos);
  std::filesystem::remove(path);
  EXPECT_EQ(Pack::open(path).error().code, ErrorCode::NotFound);
}

TEST(Pack, RefusesEveryTruncationAndExtraByte) {
  const Bytes bytes = fake_pack_bytes(3);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_FALSE(Pack::from_bytes(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length))));
  }
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(Pack::from_bytes(longer));
}

TEST(Pack, SeesEveryFlippedBitThroughItsHashes) {
  const Bytes bytes = fake_pack_bytes(3);
  const auto minor_and_reserved = [](std::size_t at) {
    return (at >= 8 && at < 12) || (at >= 48 && at < kPackHeaderSize);
  };
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    if (minor_and_reserved(bit / 8)) continue;
    Bytes damaged = bytes;
    damaged[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
    const auto pack = Pack::from_bytes(std::move(damaged));
    bool is_noticed = !pack;
    for (RegionId id = 0; pack && id < (*pack)->directory().regions.size(); ++id) {
      const RegionEntry& entry = (*pack)->directory().regions[id];
      for (const LevelEntry& level : entry.levels)
        is_noticed |= !check_part(level.part, (*pack)->part(level.part));
      if (entry.bundle.size > 0) is_noticed |= !check_part(entry.bundle, (*pack)->part(entry.bundle));
    }
    EXPECT_TRUE(is_noticed) << "bit " << bit;
  }
}

TEST(Pack, RefusesANewerMajorVersionClearly) {
  Bytes bytes = fake_pack_bytes(1);
  bytes[8] = std::byte{2};
  const auto pack = Pack::from_bytes(bytes);
  ASSERT_FALSE(pack);
  EXPECT_EQ(pack.error().code, ErrorCode::Unsupported);
}

/// A directory of five regions with these names, written and parsed again.
Result<Directory> reparsed(const std::vector<NamedRegions>& names) {
  Directory directory = Pack::from_bytes(fake_pack_bytes(5)).value()->directory();
  directory.names = names;
  const DirectoryBytes written = write_directory(directory);
  return parse_directory(written.bytes, written.summary_size);
}

TEST(Directory, KeepsTheNamesOfParts) {
  const std::vector<NamedRegions> names = {
      {"", {{2, 2}}}, {"Big Wheel", {{1, 1}, {3, 5}}}, {"wheel", {{1, 5}}}, {"wheels", {{5, 5}}}};
  EXPECT_EQ(reparsed(names)->names, names);
  EXPECT_TRUE(reparsed({})->names.empty());
}

TEST(Directory, RefusesNamesThatCannotBe) {
  const std::vector<std::vector<NamedRegions>> impossible = {
      {{"a", {}}},                         // of no region
      {{"a", {{0, 1}}}},                   // of the loose region
      {{"a", {{1, 6}}}},                   // of a region that is not there
      {{"a", {{6, 6}}}},                   //
      {{"a", {{2, 4000000000u}}}},         //
      {{"a", {{1, 2}, {2, 3}}}},           // twice
      {{"a", {{1, 2}, {3, 3}}}},           // touching
      {{"a", {{3, 4}, {1, 1}}}},           // out of order
      {{"a", {{3, 2}}}},                   // backwards
      {{"b", {{1, 1}}}, {"a", {{1, 1}}}},  // unsorted
      {{"a", {{1, 1}}}, {"a", {{2, 2}}}},  // stated twice
      {{std::string(5000, 'x'), {{1, 1}}}},
  };
  for (std::size_t i = 0; i < impossible.size(); ++i) EXPECT_FALSE(reparsed(impossible[i])) << i;
}

TEST(Directory, RefusesEveryTruncationOfItsNames) {
  Directory directory = Pack::from_bytes(fake_pack_bytes(5)).value()->directory();
  directory.names = {{"left", {{1, 2}, {4, 5}}}, {"right", {{3, 3}}}};
  const DirectoryBytes written = write_directory(directory);
  Directory without = directory;
  without.names.clear();
  const std::uint32_t plain = write_directory(without).summary_size;
  for (std::uint32_t size = plain + 1; size < written.summary_size; ++size) {
    std::vector<std::byte> bytes(written.bytes.begin(), written.bytes.begin() + size);
    bytes.insert(bytes.end(), written.bytes.begin() + written.summary_size, written.bytes.end());
    EXPECT_FALSE(parse_directory(bytes, size)) << size;
  }
  std::vector<std::byte> longer = written.bytes;
  longer.insert(longer.begin() + written.summary_size, std::byte{0});
  EXPECT_FALSE(parse_directory(longer, written.summary_size + 1));
}

}  // namespace
}  // namespace selvage
