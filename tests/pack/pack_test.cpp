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

}  // namespace
}  // namespace selvage
