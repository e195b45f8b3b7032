// SPDX-License-Identifier: MIT
//
// The one hash of the system: SHA-256 truncated to 16 bytes. It names parts (cache, resume), proves that a
// part arrived whole, and its root over the directory pages is the pack's identity.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
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

/// The same of data that comes in pieces.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(Hasher&&) noexcept;
  Hasher& operator=(Hasher&&) noexcept;

  void add(std::span<const std::byte> data);
  Hash finish();  ///< once

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// For secrets: the whole SHA-256, and a comparison that takes as long for all.
using Sha256 = std::array<std::uint8_t, 32>;
Sha256 sha256_of(std::span<const std::byte> data);
bool equal_in_constant_time(const Sha256& a, const Sha256& b);

}  // namespace selvage
