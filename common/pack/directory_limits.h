// SPDX-License-Identifier: MIT
//
// What readers of a directory refuse, for those who make one.
#pragma once

#include <cstddef>
#include <cstdint>

namespace selvage {

/// Bytes of a name, units, or a metadata key or value.
inline constexpr std::size_t kMaxDirectoryText = 4096;
/// A client that reads a summary without its pages takes no more (parse_summary).
inline constexpr std::uint32_t kMaxRegions = 1u << 20;

}  // namespace selvage
