// SPDX-License-Identifier: MIT
#include "common/base/replace_file.h"

#include <csignal>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace selvage {
namespace {

class ReplaceFile : public ::testing::Test {
 protected:
  ReplaceFile() { std::ofstream(path()) << "old"; }

  std::filesystem::path path() const { return folder.path() / "file"; }

  std::string content() const {
    std::ifstream file(path());
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void expect_no_other_file() const {
    const std::filesystem::directory_iterator files(folder.path()), end;
    EXPECT_EQ(std::distance(files, end), 1);
  }

  /// As a full disk: no file of this process grows beyond so many bytes.
  static void let_files_grow_to(rlim_t bytes) {
    rlimit limit{};
    ::getrlimit(RLIMIT_FSIZE, &limit);
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }

  TempFolder folder;
  const std::string large = std::string(100'000, 'x');
};

TEST_F(ReplaceFile, PutsTheNewInPlaceOfTheOld) {
  ASSERT_TRUE(replace_file(path(), large));
  EXPECT_EQ(content(), large);
  expect_no_other_file();
}

TEST_F(ReplaceFile, AFullDiskLeavesWhatWasThere) {
  std::signal(SIGXFSZ, SIG_IGN);
  let_files_grow_to(4096);
  const auto written = replace_file(path(), large);
  let_files_grow_to(RLIM_INFINITY);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::Io);
  EXPECT_EQ(content(), "old");
  expect_no_other_file();
}

TEST_F(ReplaceFile, TheEndOfTheProcessLeavesWhatWasThere) {
  const int file = ::open(folder.path().c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0600);
  if (file < 0) GTEST_SKIP() << "this file system knows no files without a name";
  ::close(file);
  ::testing::GTEST_FLAG(death_test_style) = "fast";  // the same folder
  const std::string there = path().string();
  const auto die_while_writing = [&] {
    std::signal(SIGXFSZ, SIG_DFL);
    let_files_grow_to(4096);
    (void)replace_file(there, large);
  };
  EXPECT_EXIT(die_while_writing(), ::testing::KilledBySignal(SIGXFSZ), "");
  EXPECT_EQ(content(), "old");
  expect_no_other_file();
}

}  // namespace
}  // namespace selvage
