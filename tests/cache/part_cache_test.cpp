// SPDX-License-Identifier: MIT
#include "client/cache/part_cache.h"

#include <chrono>
#include <fstream>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace selvage {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::byte>;

/// The `seed`th of many different parts.
Bytes part_bytes(std::uint32_t seed, std::size_t size = 1000) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 31 + (seed >> (i % 4 * 8)));
  return bytes;
}

PartRef ref_of(const Bytes& bytes) { return {0, static_cast<std::uint32_t>(bytes.size()), hash_of(bytes)}; }

PartCache open(const TempFolder& folder, std::uint64_t max_bytes = 1 << 20) {
  return PartCache::open(folder.path(), max_bytes).value();
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  return files;
}

TEST(PartCache, GivesBackWhatWasPut) {
  const TempFolder folder;
  const Bytes part = part_bytes(1);
  PartCache cache = open(folder);
  EXPECT_FALSE(cache.find(ref_of(part)));
  cache.put(hash_of(part), part);
  EXPECT_EQ(cache.find(ref_of(part)), part);
  EXPECT_EQ(open(folder).find(ref_of(part)), part);  // in another process, later
  EXPECT_FALSE(cache.find(ref_of(part_bytes(2))));
}

TEST(PartCache, BelievesNoFile) {
  const TempFolder folder;
  PartCache cache = open(folder);
  const Bytes part = part_bytes(1);
  const auto damage = [&](const Bytes& content) {
    cache.put(hash_of(part), part);
    const std::vector<fs::path> files = files_in(folder.path());
    ASSERT_EQ(files.size(), 1u);
    std::ofstream(files[0], std::ios::binary)
        .write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
    EXPECT_FALSE(cache.find(ref_of(part)));
    EXPECT_TRUE(files_in(folder.path()).empty()) << "the damaged file stays";
  };
  Bytes flipped = part;
  flipped[500] ^= std::byte{1};
  damage(flipped);
  damage(Bytes(part.begin(), part.end() - 1));
  damage({});
  Bytes longer = part;
  longer.push_back(std::byte{0});
  damage(longer);
}

TEST(PartCache, KeepsToItsBoundAndDropsWhatWasNotUsedForLongest) {
  const TempFolder folder;
  PartCache cache = open(folder, 64 << 12);
  const Bytes first = part_bytes(0);
  cache.put(hash_of(first), first);
  for (std::uint32_t i = 1; i <= 500; ++i) {
    const Bytes part = part_bytes(i);
    cache.put(hash_of(part), part);
    // File times tick in milliseconds: the part that stays in use is told from the rest by minutes.
    for (const fs::path& file : files_in(folder.path()))
      fs::last_write_time(file, fs::last_write_time(file) - std::chrono::minutes(1));
    ASSERT_TRUE(cache.find(ref_of(first))) << "after " << i;
    ASSERT_LE(files_in(folder.path()).size(), 64u);
  }
  EXPECT_TRUE(cache.find(ref_of(part_bytes(500))));
  EXPECT_FALSE(cache.find(ref_of(part_bytes(1))));
  EXPECT_GE(files_in(folder.path()).size(), 32u) << "evicts far more than it must";
}

TEST(PartCache, ShrinksToASmallerBound) {
  const TempFolder folder;
  {
    PartCache cache = open(folder, 1 << 20);
    for (std::uint32_t i = 0; i < 100; ++i) cache.put(hash_of(part_bytes(i)), part_bytes(i));
    EXPECT_EQ(files_in(folder.path()).size(), 100u);
  }
  const Bytes one_more = part_bytes(100);
  open(folder, 10 << 12).put(hash_of(one_more), one_more);
  EXPECT_LE(files_in(folder.path()).size(), 10u);
}

TEST(PartCache, LetsNoPartPushAllOthersOut) {
  const TempFolder folder;
  PartCache cache = open(folder, 1 << 20);
  const Bytes small = part_bytes(1), large = part_bytes(2, 1 << 19);
  cache.put(hash_of(small), small);
  cache.put(hash_of(large), large);
  EXPECT_TRUE(cache.find(ref_of(small)));
  EXPECT_FALSE(cache.find(ref_of(large)));
}

TEST(PartCache, RemovesWhatDeadProcessesLeft) {
  const TempFolder folder;
  open(folder);
  const fs::path stale = folder.path() / "parts" / ".tmp-1-1", fresh = folder.path() / "parts" / ".tmp-1-2";
  std::ofstream(stale) << "half";
  std::ofstream(fresh) << "half";
  fs::last_write_time(stale, fs::file_time_type::clock::now() - std::chrono::hours(2));
  open(folder).put(hash_of(part_bytes(1)), part_bytes(1));
  EXPECT_FALSE(fs::exists(stale));
  EXPECT_TRUE(fs::exists(fresh)) << "somebody is still writing it";
}

TEST(PartCache, IsSafeForThreadsAndProcesses) {
  const TempFolder folder;
  const auto work = [&](PartCache& cache, std::uint32_t offset) {
    bool is_sound = true;
    for (std::uint32_t i = 0; i < 400; ++i) {
      const Bytes part = part_bytes((i * 7 + offset) % 60);
      const auto found = cache.find(ref_of(part));
      is_sound &= !found || *found == part;
      if (!found) cache.put(hash_of(part), part);
    }
    return is_sound;
  };
  std::vector<pid_t> children;
  for (std::uint32_t child = 0; child < 3; ++child) {
    const pid_t pid = ::fork();
    if (pid == 0) {
      PartCache cache = open(folder, 40 << 12);
      ::_exit(work(cache, child) ? 0 : 1);
    }
    children.push_back(pid);
  }
  PartCache cache = open(folder, 40 << 12);
  {
    std::vector<std::jthread> threads;
    for (std::uint32_t i = 0; i < 3; ++i) threads.emplace_back([&, i] { EXPECT_TRUE(work(cache, 10 * i)); });
  }
  for (const pid_t pid : children) {
    int status = 0;
    ::waitpid(pid, &status, 0);
    EXPECT_EQ(status, 0);
  }
  // Each of the four could exceed the bound by a sixteenth; whoever comes next sees to it.
  EXPECT_LE(files_in(folder.path()).size(), 50u);
  const Bytes one_more = part_bytes(100);
  open(folder, 40 << 12).put(hash_of(one_more), one_more);
  EXPECT_LE(files_in(folder.path()).size(), 40u);
}

TEST(PartCache, SaysWhenAFolderWillNotDo) {
  const TempFolder folder;
  std::ofstream(folder.path() / "file") << "x";
  const auto cache = PartCache::open(folder.path() / "file");
  ASSERT_FALSE(cache);
  EXPECT_EQ(cache.error().code, ErrorCode::Io);
  EXPECT_NE(cache.error().message.find("file"), std::string::npos);
}

TEST(PartCache, DefaultFollowsXdg) {
  ::setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(default_cache_folder(), fs::path("/somewhere/selvage"));
  ::setenv("XDG_CACHE_HOME", "relative", 1);
  ::setenv("HOME", "/home/me", 1);
  EXPECT_EQ(default_cache_folder(), fs::path("/home/me/.cache/selvage"));
  ::unsetenv("HOME");
  EXPECT_FALSE(default_cache_folder());
}

}  // namespace
}  // namespace selvage
