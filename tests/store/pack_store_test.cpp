// SPDX-License-Identifier: MIT
#include "server/store/pack_store.h"

#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include "tests/support/fake_pack.h"
#include "tests/support/temp_folder.h"

namespace selvage {
namespace {

class Store : public ::testing::Test {
 protected:
  TempFolder folder;
  std::unique_ptr<PackStore> store = std::move(PackStore::open_folder(folder.path()).value());
};

TEST_F(Store, OpensAPackByTheStemOfItsFile) {
  folder.put("row.selvage", fake_pack_bytes(7));
  const auto pack = store->open("row");
  ASSERT_TRUE(pack) << pack.error().message;
  EXPECT_EQ((*pack)->directory().real_region_count(), 7u);
}

TEST_F(Store, SharesWhatItHasOpen) {
  folder.put("row.selvage", fake_pack_bytes(7));
  EXPECT_EQ(store->open("row").value(), store->open("row").value());
}

TEST_F(Store, NoticesPacksThatAppearChangeAndGo) {
  EXPECT_TRUE(store->list()->empty());
  folder.put("row.selvage", fake_pack_bytes(7));
  EXPECT_EQ(store->list()->size(), 1u);
  const auto old = store->open("row").value();
  folder.put("row.selvage", fake_pack_bytes(8));
  EXPECT_EQ(store->open("row").value()->directory().real_region_count(), 8u);
  EXPECT_EQ(old->directory().real_region_count(), 7u);
  EXPECT_FALSE(old->bytes().empty());
  std::filesystem::remove(folder.path() / "row.selvage");
  EXPECT_EQ(store->open("row").error().code, ErrorCode::NotFound);
  EXPECT_TRUE(store->list()->empty());
}

TEST_F(Store, APackThatIsOverwrittenInPlaceIsDamagedForWhoHasItOpen) {
  folder.put("row.selvage", fake_pack_bytes(7));
  const auto old = store->open("row").value();
  const auto fresh = fake_pack_bytes(8);
  std::ofstream(folder.path() / "row.selvage", std::ios::binary)
      .write(reinterpret_cast<const char*>(fresh.data()), static_cast<std::streamsize>(fresh.size()));
  EXPECT_EQ(store->open("row").value()->directory().real_region_count(), 8u);
  EXPECT_TRUE(old->is_damaged());
  EXPECT_FALSE(store->open("row").value()->is_damaged());
}

TEST_F(Store, ADamagedPackDisturbsNobody) {
  auto torn = fake_pack_bytes(7);
  torn.resize(torn.size() - 1);
  folder.put("torn.selvage", torn);
  folder.put("empty.selvage", {});
  folder.put("row.selvage", fake_pack_bytes(7));
  const auto models = store->list().value();
  ASSERT_EQ(models.size(), 3u);
  EXPECT_EQ(models[0].name, "empty");
  EXPECT_FALSE(models[0].pack);
  EXPECT_TRUE(models[1].pack);
  ASSERT_FALSE(models[2].pack);
  EXPECT_EQ(models[2].pack.error().code, ErrorCode::BadStream);
  EXPECT_NE(models[2].pack.error().message.find("torn"), std::string::npos);
  EXPECT_EQ(models[2].pack.error().message.find(folder.path().string()), std::string::npos);
}

TEST_F(Store, ListsOnlyPacks) {
  folder.put("notes.txt", {});
  folder.put(".hidden.selvage", fake_pack_bytes(3));
  std::filesystem::create_directory(folder.path() / "folder.selvage");
  EXPECT_TRUE(store->list()->empty());
}

TEST_F(Store, NamesDoNotLeaveTheFolder) {
  std::filesystem::create_directory(folder.path() / "inner");
  folder.put("row.selvage", fake_pack_bytes(3));
  const auto inner = PackStore::open_folder(folder.path() / "inner").value()->open("../row");
  ASSERT_FALSE(inner);
  EXPECT_EQ(inner.error().code, ErrorCode::NotFound);
  for (std::string_view bad : {"", ".", "..", ".row", "a/b", "/etc/passwd", "a\\b"}) {
    EXPECT_FALSE(is_model_name(bad)) << bad;
  }
  EXPECT_FALSE(is_model_name(std::string_view("row\0x", 5)));
  EXPECT_FALSE(is_model_name(std::string(129, 'x')));
  for (std::string_view good : {"row", "a b", "v1.2", "häuschen"}) EXPECT_TRUE(is_model_name(good)) << good;
}

TEST_F(Store, ServesManyThreads) {
  for (int i = 0; i < 4; ++i) folder.put("row" + std::to_string(i) + ".selvage", fake_pack_bytes(20));
  std::vector<std::jthread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&, name = "row" + std::to_string(i % 2)] {
      for (int n = 0; n < 20; ++n) {
        EXPECT_TRUE(store->open(name));
        EXPECT_EQ(store->list()->size(), 4u);
      }
    });
  }
}

TEST(PackStore, NeedsAFolder) {
  const TempFolder folder;
  EXPECT_EQ(PackStore::open_folder(folder.path() / "none").error().code, ErrorCode::NotFound);
  folder.put("file", {});
  EXPECT_EQ(PackStore::open_folder(folder.path() / "file").error().code, ErrorCode::InvalidArgument);
}

TEST(PackStore, SaysSoWhenItsFolderIsGone) {
  auto folder = std::make_unique<TempFolder>();
  const auto store = PackStore::open_folder(folder->path()).value()->list();
  EXPECT_TRUE(store);
  auto gone = std::move(PackStore::open_folder(folder->path()).value());
  folder.reset();
  EXPECT_EQ(gone->list().error().code, ErrorCode::Io);
}

}  // namespace
}  // namespace selvage
