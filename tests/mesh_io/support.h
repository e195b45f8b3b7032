// SPDX-License-Identifier: MIT
//
// Files as strings, and what a parser should say about them.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "common/base/result.h"
#include "common/mesh_io/mesh_file.h"

namespace selvage {

using Parser = Result<MeshFile> (*)(std::span<const std::byte>);

/// From a heap block of exactly the text's size, so that a sanitizer sees a read past its end.
inline Result<MeshFile> parse(Parser parser, std::string_view text) {
  const std::vector<char> exact(text.begin(), text.end());
  return parser(std::as_bytes(std::span(exact)));
}

inline MeshFile parse_good(Parser parser, std::string_view text) {
  Result<MeshFile> file = parse(parser, text);
  EXPECT_TRUE(file) << file.error().to_string();
  return file ? std::move(*file) : MeshFile{};
}

inline Error parse_bad(Parser parser, std::string_view text) {
  const Result<MeshFile> file = parse(parser, text);
  EXPECT_FALSE(file) << "accepted: " << text;
  return file ? Error{} : file.error();
}

inline void expect_error(Parser parser, std::string_view text, std::string_view message_part,
                         ErrorCode code = ErrorCode::BadFile) {
  const Error error = parse_bad(parser, text);
  EXPECT_NE(error.message.find(message_part), std::string::npos) << "says: " << error.message;
  EXPECT_EQ(error.code, code) << error.message;
}

inline bool has_note(const MeshFile& file, std::string_view part) {
  return std::any_of(file.notes.begin(), file.notes.end(),
                     [&](const std::string& note) { return note.find(part) != note.npos; });
}

inline void expect_same(const TriangleSoup& a, const TriangleSoup& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.triangles, b.triangles);
}

/// "0 1 2 | 0 2 3", for short expectations.
inline std::string triangles_of(const MeshFile& file) {
  std::string text;
  for (const Triangle& t : file.soup.triangles) {
    text += (text.empty() ? "" : " | ") + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " +
            std::to_string(t[2]);
  }
  return text;
}

}  // namespace selvage
