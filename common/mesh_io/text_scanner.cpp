// SPDX-License-Identifier: MIT
#include "common/mesh_io/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <type_traits>

namespace selvage {
namespace {

char to_lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// from_chars calls 1e-400 out of range as it does 1e400. The first is a fine coordinate: zero.
template <class Number>
bool is_underflow(const char* from, const char* to, Number& value) {
  long double wide = 0;
  const auto [stop, status] = std::from_chars(from, to, wide);
  if (status != std::errc{} || std::fabs(wide) > 1) return false;
  value = static_cast<Number>(wide);
  return true;
}

}  // namespace

TextScanner::TextScanner(std::span<const std::byte> bytes, const Syntax& syntax, std::uint64_t first_line)
    : begin_(reinterpret_cast<const char*>(bytes.data())),
      at_(begin_),
      end_(begin_ + bytes.size()),
      line_(first_line) {
  const auto mark = [this](std::string_view chars, Class c) {
    for (char each : chars) classes_[static_cast<unsigned char>(each)] = c;
  };
  mark("\n\r", Class::LineEnd);
  mark(syntax.blanks, Class::Blank);
  mark(syntax.punctuation, Class::Punctuation);
  if (syntax.comment != '\0') mark({&syntax.comment, 1}, Class::Comment);
  if (syntax.has_continuations) mark("\\", Class::Continuation);
}

bool TextScanner::at_line_end() {
  for (;;) {
    while (at_ != end_ && class_of(*at_) == Class::Blank) ++at_;
    if (at_ == end_ || class_of(*at_) == Class::LineEnd) return true;
    if (class_of(*at_) == Class::Comment) {
      while (at_ != end_ && class_of(*at_) != Class::LineEnd) ++at_;
      return true;
    }
    if (class_of(*at_) != Class::Continuation || !is_line_end(at_ + 1)) return false;
    ++at_;
    next_line();
  }
}

bool TextScanner::at_end() {
  while (at_line_end()) {
    if (at_ == end_) return true;
    next_line();
  }
  return false;
}

void TextScanner::next_line() {
  while (at_ != end_ && class_of(*at_) != Class::LineEnd) ++at_;
  if (at_ == end_) return;
  const bool is_cr_lf = *at_ == '\r' && end_ - at_ > 1 && at_[1] == '\n';
  at_ += is_cr_lf ? 2 : 1;
  ++line_;
}

bool TextScanner::ends_word(const char* at) const {
  if (at == end_) return true;
  const Class c = class_of(*at);
  if (c == Class::Continuation) return is_line_end(at + 1);
  return c != Class::Letter;
}

const char* TextScanner::word_end() const {
  if (class_of(*at_) == Class::Punctuation) return at_ + 1;
  const char* stop = at_ + 1;
  while (!ends_word(stop)) ++stop;
  return stop;
}

std::string_view TextScanner::peek() {
  if (at_line_end()) return {};
  return {at_, static_cast<std::size_t>(word_end() - at_)};
}

std::string_view TextScanner::word() {
  const std::string_view found = peek();
  at_ += found.size();
  return found;
}

template <class Number>
bool TextScanner::number(Number& value) {
  if (at_line_end()) return false;
  const bool has_plus = *at_ == '+' && end_ - at_ > 1 && at_[1] != '-';
  const char* from = at_ + (has_plus ? 1 : 0);
  const auto [stop, status] = std::from_chars(from, end_, value);
  if (!ends_word(stop)) return false;
  if constexpr (std::is_floating_point_v<Number>) {
    const bool is_small = status == std::errc::result_out_of_range && is_underflow(from, stop, value);
    if ((status != std::errc{} && !is_small) || !std::isfinite(value)) return false;
  } else if (status != std::errc{}) {
    return false;
  }
  at_ = stop;
  return true;
}

bool TextScanner::coordinate(double& value) { return number(value); }
bool TextScanner::coordinate(float& value) { return number(value); }
bool TextScanner::integer(std::int64_t& value) { return number(value); }

bool TextScanner::skip_string() {
  while (at_ != end_ && *at_ != '"') {
    if (*at_ == '\\' && end_ - at_ > 1 && at_[1] == '"') ++at_;
    if (class_of(*at_) == Class::LineEnd) {
      next_line();
    } else {
      ++at_;
    }
  }
  if (at_ == end_) return false;
  ++at_;
  return true;
}

tl::unexpected<Error> TextScanner::fail_here(std::string_view message, ErrorCode code) const {
  return fail(code, "line " + std::to_string(line_) + ": " + std::string(message));
}

tl::unexpected<Error> TextScanner::fail_expecting(std::string_view what) {
  const std::string_view found = peek();
  const std::string wanted = "expected " + std::string(what) + ", found ";
  if (!found.empty()) return fail_here(wanted + quote(found));
  return fail_here(wanted + (at_ == end_ ? "the end of the file" : "the end of the line"));
}

std::string quote(std::string_view text) {
  constexpr std::size_t kShown = 40;
  std::string shown(text.substr(0, kShown));
  for (char& c : shown)
    if (c < ' ' || c > '~') c = '?';
  return "'" + shown + (text.size() > kShown ? "...'" : "'");
}

bool equals_ignoring_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return to_lower(x) == to_lower(y); });
}

std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace selvage
