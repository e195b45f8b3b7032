// SPDX-License-Identifier: MIT
//
// The one hash of the system: SHA-256 truncated to 16 bytes. It names parts (cache, resume), proves that a
// part arrived whole, and its root over the directory pages is the pack's identity.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace selvage {

struct Hash {
  static constexpr std::size_t kSize = 16;
  std::array<std::uint8_t, kSize> bytes{};

  std::string to_hex() const;
  friend auto operator<=>(const Hash&, const Hash&) = default;
};

Hash hash_of(std::span<const std::byte> data);

}  // namespace selvage
