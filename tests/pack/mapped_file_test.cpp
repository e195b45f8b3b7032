// SPDX-License-Identifier: MIT
#include "common/pack/mapped_file.h"

#include <csignal>

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace selvage {
namespace {

class Mapped : public ::testing::Test {
 protected:
  Mapped() {
    survive_truncated_files();
    folder.put("file", std::vector<std::byte>(100'000, std::byte{7}));
  }
  std::unique_ptr<MappedFile> open() const {
    return std::move(MappedFile::open(folder.path() / "file").value());
  }
  TempFolder folder;
};

TEST_F(Mapped, OutlivesTheRemovalOfItsFile) {
  const auto file = open();
  std::filesystem::remove(folder.path() / "file");
  EXPECT_EQ(file->bytes().size(), 100'000u);
  EXPECT_EQ(file->bytes().back(), std::byte{7});
  EXPECT_FALSE(file->is_damaged());
}

TEST_F(Mapped, ReadsZerosWhereTheFileWasCutOff) {
  const auto file = open(), removed = open();
  std::filesystem::resize_file(folder.path() / "file", 10'000);
  EXPECT_EQ(file->bytes()[50], std::byte{7});
  EXPECT_FALSE(file->is_damaged());
  EXPECT_EQ(file->bytes().back(), std::byte{0});
  EXPECT_TRUE(file->is_damaged());
  EXPECT_FALSE(removed->is_damaged()) << "nobody has read there yet";
}

TEST_F(Mapped, PlacesOfMappingsAreUsedAgain) {
  for (int i = 0; i < 100; ++i) {
    folder.put("file", std::vector<std::byte>(100'000, std::byte{7}));
    const auto file = open();
    EXPECT_FALSE(file->is_damaged());
    std::filesystem::resize_file(folder.path() / "file", 0);
    EXPECT_EQ(file->bytes().front(), std::byte{0});
    EXPECT_TRUE(file->is_damaged());
  }
}

TEST(MappedFileDeathTest, OtherBusErrorsStillEndTheProcess) {
  survive_truncated_files();
  EXPECT_EXIT(std::raise(SIGBUS), ::testing::KilledBySignal(SIGBUS), "");
}

TEST_F(Mapped, EmptyAndMissingFilesAreNamed) {
  folder.put("empty", {});
  EXPECT_EQ(MappedFile::open(folder.path() / "empty").error().code, ErrorCode::Io);
  EXPECT_EQ(MappedFile::open(folder.path() / "none").error().code, ErrorCode::NotFound);
}

}  // namespace
}  // namespace selvage
