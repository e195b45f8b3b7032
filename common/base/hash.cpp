// SPDX-License-Identifier: MIT
#include "common/base/hash.h"

#include <algorithm>

#include <openssl/sha.h>

namespace selvage {

std::string Hash::to_hex() const {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string hex;
  hex.reserve(2 * kSize);
  for (std::uint8_t byte : bytes) {
    hex.push_back(kDigits[byte >> 4]);
    hex.push_back(kDigits[byte & 15]);
  }
  return hex;
}

Hash hash_of(std::span<const std::byte> data) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest;
  SHA256(reinterpret_cast<const unsigned char*>(data.data()), data.size(), digest.data());
  Hash hash;
  std::copy_n(digest.begin(), Hash::kSize, hash.bytes.begin());
  return hash;
}

}  // namespace selvage
