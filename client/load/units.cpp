// SPDX-License-Identifier: MIT
#include "client/load/units.h"

#include <charconv>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace selvage {
namespace {

using Units = std::initializer_list<std::pair<std::string_view, double>>;

/// A finite number that is not negative, with one of these units behind it, in the unit that counts 1.
std::optional<double> parse(std::string_view text, Units units) {
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc() || value < 0 || !std::isfinite(value)) return std::nullopt;
  const std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
  for (const auto& [unit, factor] : units) {
    if (rest == unit) return value * factor;
  }
  return std::nullopt;
}

std::optional<std::uint64_t> whole(std::optional<double> value) {
  if (!value || *value > 1e18) return std::nullopt;
  return static_cast<std::uint64_t>(std::llround(*value));
}

constexpr double kDay = 86'400;

}  // namespace

std::optional<double> parse_seconds(std::string_view text) {
  const auto seconds = parse(text, {{"us", 1e-6}, {"ms", 1e-3}, {"s", 1}, {"min", 60}, {"h", 3600}});
  return seconds && *seconds <= kDay ? seconds : std::nullopt;
}

std::optional<std::chrono::milliseconds> parse_time(std::string_view text) {
  const auto seconds = parse(text, {{"ms", 1e-3}, {"s", 1}, {"min", 60}, {"h", 3600}});
  if (!seconds || *seconds > kDay) return std::nullopt;
  return std::chrono::milliseconds(std::llround(1e3 * *seconds));
}

std::optional<std::uint64_t> parse_size(std::string_view text) {
  return whole(parse(text, {{"B", 1}, {"KB", 1e3}, {"MB", 1e6}, {"GB", 1e9}}));
}

std::optional<std::uint64_t> parse_rate(std::string_view text) {
  return whole(parse(text, {{"kbit", 1e3 / 8}, {"mbit", 1e6 / 8}, {"gbit", 1e9 / 8}}));
}

std::optional<double> parse_percent(std::string_view text) { return parse(text, {{"%", 1}}); }

std::optional<double> parse_plain_number(std::string_view text) { return parse(text, {{"", 1}}); }

}  // namespace selvage
