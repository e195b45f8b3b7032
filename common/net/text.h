// SPDX-License-Identifier: MIT
//
// Text that crosses the wire ends on terminals and in JSON: it is UTF-8 without control characters.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace selvage {

/// Well-formed UTF-8 (no overlong forms, no surrogates) without C0 and C1 control characters.
bool is_printable_utf8(std::string_view text);

/// The longest front of `text` that fits in `max_bytes`, with '?' for each byte that is no part of printable
/// UTF-8.
std::string printable_utf8(std::string_view text, std::size_t max_bytes);

}  // namespace selvage
