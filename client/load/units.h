// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>

namespace selvage {

/// "50ms", "2s", "5min". Nothing if it is no such time, or longer than a day.
std::optional<std::chrono::milliseconds> parse_time(std::string_view text);
/// The same with fractions and finer: "1.5ms", "200us".
std::optional<double> parse_seconds(std::string_view text);
/// "200B", "64KB", "1.5MB", "2GB": powers of ten.
std::optional<std::uint64_t> parse_size(std::string_view text);
/// Bits a second: "20mbit", "512kbit", "1gbit"; in bytes a second.
std::optional<std::uint64_t> parse_rate(std::string_view text);
/// "20%", as 20.
std::optional<double> parse_percent(std::string_view text);
/// A plain number, all of the text, not negative.
std::optional<double> parse_plain_number(std::string_view text);

}  // namespace selvage
