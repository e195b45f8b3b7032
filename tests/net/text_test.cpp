// SPDX-License-Identifier: MIT
#include "common/net/text.h"

#include <gtest/gtest.h>

namespace selvage {
namespace {

TEST(Text, KnowsPrintableUtf8) {
  for (const char* good : {"", "bunny", "naïve", "石", "🦙", "\xF4\x8F\xBF\xBF"}) {
    EXPECT_TRUE(is_printable_utf8(good)) << good;
  }
}

TEST(Text, RefusesControlsOverlongFormsSurrogatesAndStrayBytes) {
  for (const char* bad : {"\n", "\x7F", "\xC2\x85", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80",
                          "\xF4\x90\x80\x80", "\x80", "\xE7\x9F", "\xC3(", "\xFF"}) {
    EXPECT_FALSE(is_printable_utf8(bad));
  }
}

TEST(Text, ShortensBetweenCharacters) {
  EXPECT_EQ(printable_utf8("石石", 5), "石");
  EXPECT_EQ(printable_utf8("a\tb\xFF", 10), "a?b?");
}

}  // namespace
}  // namespace selvage
