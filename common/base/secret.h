// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace selvage {

/// How secrets are kept and compared: by the whole SHA-256 (a Hash is half of one), in a time that says nothing
/// about where two differ.
using Sha256 = std::array<std::uint8_t, 32>;
Sha256 sha256_of(std::span<const std::byte> data);
bool equal_in_constant_time(const Sha256& a, const Sha256& b);

}  // namespace selvage
