// SPDX-License-Identifier: MIT
#include "common/base/result.h"

#include <gtest/gtest.h>

#include "common/base/hash.h"

namespace selvage {
namespace {

Result<int> parse_answer(bool good) {
  if (!good) return fail(ErrorCode::BadFile, "not the answer", 7);
  return 42;
}

TEST(Result, CarriesValueOrError) {
  EXPECT_EQ(parse_answer(true).value(), 42);
  const auto failed = parse_answer(false);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::BadFile);
  EXPECT_EQ(failed.error().to_string(), "not the answer (at byte 7)");
}

TEST(Result, ForwardedErrorNamesItsContext) {
  auto failed = parse_answer(false);
  const Result<std::string> outer = forward_error(failed, "deep.txt");
  EXPECT_EQ(outer.error().message, "deep.txt: not the answer");
  EXPECT_EQ(outer.error().offset, 7u);
}

TEST(Hash, IsTruncatedSha256) {  // FIPS 180-2, "abc"
  const std::string text = "abc";
  EXPECT_EQ(hash_of(std::as_bytes(std::span(text))).to_hex(), "ba7816bf8f01cfea414140de5dae2223");
}

}  // namespace
}  // namespace selvage
