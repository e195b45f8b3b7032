// SPDX-License-Identifier: MIT
//
// Words and numbers of a text file, and the line they stand on. The text readers share it, so that a message
// says "line 12: expected a coordinate, found 'abc'" whatever the format. Lines end with LF, CR LF or CR.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "common/base/result.h"

namespace selvage {

class TextScanner {
 public:
  struct Syntax {
    std::string_view blanks = " \t\v\f";
    std::string_view punctuation = {};  ///< each of these is a word by itself
    char comment = '\0';                ///< from here to the end of the line nothing counts
    bool has_continuations = false;     ///< a backslash at the end of a line joins the next one
  };

  /// Borrows `bytes`. `first_line` is the number of the line they begin on.
  TextScanner(std::span<const std::byte> bytes, const Syntax& syntax, std::uint64_t first_line = 1);

  /// Steps over blanks and a comment; whether nothing else is left on the line, or in the file.
  bool at_line_end();
  bool at_end();
  void next_line();

  /// The next word on this line, empty at its end. `peek` leaves it there.
  std::string_view word();
  std::string_view peek();

  /// The next word on this line as a finite number, or false and the word left where it is for
  /// fail_expecting.
  bool coordinate(double& value);
  bool coordinate(float& value);
  bool integer(std::int64_t& value);

  /// From inside a quoted string over its closing '"', even across lines; a backslash protects the character
  /// after it.
  bool skip_string();

  std::uint64_t line() const { return line_; }
  std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

  /// "line 12: <message>", at the line reached.
  tl::unexpected<Error> fail_here(std::string_view message, ErrorCode code = ErrorCode::BadFile) const;
  /// "line 12: expected <what>, found <the word that is there>".
  tl::unexpected<Error> fail_expecting(std::string_view what);

 private:
  enum class Class : std::uint8_t { Letter, Blank, LineEnd, Punctuation, Comment, Continuation };

  Class class_of(char c) const { return classes_[static_cast<unsigned char>(c)]; }
  bool is_line_end(const char* at) const { return at != end_ && class_of(*at) == Class::LineEnd; }
  bool ends_word(const char* at) const;
  const char* word_end() const;
  template <class Number>
  bool number(Number& value);

  const char* begin_;
  const char* at_;
  const char* end_;
  std::uint64_t line_;
  std::array<Class, 256> classes_{};
};

/// `text` for a message: unprintable bytes as '?', cut to a readable length.
std::string quote(std::string_view text);

/// Compares ASCII letters without regard to case.
bool equals_ignoring_case(std::string_view a, std::string_view b);

std::string_view as_text(std::span<const std::byte> bytes);

}  // namespace selvage
