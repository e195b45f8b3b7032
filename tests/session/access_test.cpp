// SPDX-License-Identifier: MIT
#include "server/session/access.h"

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace selvage {
namespace {

/// printf %s secret | sha256sum; and of "hunter2".
const std::string kSecret = "sha256:2bb80d537b1da3e38bd30361aa855686bde0eacd7162fef6a25fe97bf527a25b";
const std::string kHunter = "sha256:f52fbd32b2b3b86ff88ef6c490628285f482af15ddcb29541f94bcf526a3f6c7";

TEST(Access, WithoutATableEverybodyReadsAndNobodyPublishes) {
  const auto access = AccessTable().access_of("");
  ASSERT_TRUE(access);
  EXPECT_TRUE(access->may_read);
  EXPECT_FALSE(access->may_publish);
}

TEST(Access, GivesATokenItsScopesAndName) {
  const auto table = AccessTable::parse("# who may\n\nviewer read " + kSecret + "\nmodeller read,publish " +
                                        kHunter + " # of the studio\n");
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->token_count(), 2u);
  const auto viewer = table->access_of("secret");
  ASSERT_TRUE(viewer);
  EXPECT_EQ(viewer->who, "viewer");
  EXPECT_TRUE(viewer->may_read);
  EXPECT_FALSE(viewer->may_publish);
  EXPECT_TRUE(table->access_of("hunter2")->may_publish);
}

TEST(Access, ATableShutsOutWhoHasNoToken) {
  const auto table = AccessTable::parse("viewer read " + kSecret);
  for (const char* token : {"", "Secret", "secret ", "x"}) {
    const auto access = table->access_of(token);
    ASSERT_FALSE(access) << token;
    EXPECT_EQ(access.error().code, ErrorCode::Unauthorised);
  }
}

TEST(Access, ATableMayLetAnonymousClientsRead) {
  const auto table = AccessTable::parse("anonymous read\nmodeller publish " + kHunter);
  EXPECT_TRUE(table->access_of("")->may_read);
  EXPECT_FALSE(table->access_of("hunter2")->may_read);
  EXPECT_FALSE(table->access_of("wrong"));
}

TEST(Access, BadLinesAreNamed) {
  const std::vector<std::string> bad_lines = {"viewer",
                                              "viewer write " + kSecret,
                                              "viewer read",
                                              "viewer read secret",
                                              "viewer read " + kSecret + " more",
                                              "viewer read " + kSecret.substr(0, 70),
                                              "viewer read sha256:" + std::string(64, 'g'),
                                              "anonymous read " + kSecret,
                                              "other read " + kHunter + "\nviewer read " + kHunter};
  for (const std::string& bad : bad_lines) {
    const std::string text = "# a comment\n" + bad + "\n";
    const auto table = AccessTable::parse(text);
    ASSERT_FALSE(table) << bad;
    EXPECT_EQ(table.error().code, ErrorCode::BadFile);
    EXPECT_TRUE(table.error().message.starts_with("line 2: ") ||
                table.error().message.starts_with("line 3: "))
        << table.error().message;
    EXPECT_EQ(table.error().message.find("secret"), std::string::npos) << "secrets stay out of logs";
  }
}

TEST(Access, FilesAreNamed) {
  const TempFolder folder;
  EXPECT_NE(AccessTable::read(folder.path() / "none").error().message.find("none"), std::string::npos);
}

}  // namespace
}  // namespace selvage
