// SPDX-License-Identifier: MIT
#include "common/base/secret.h"

#include <openssl/crypto.h>
#include <openssl/sha.h>

namespace selvage {

Sha256 sha256_of(std::span<const std::byte> data) {
  Sha256 digest;
  SHA256(reinterpret_cast<const unsigned char*>(data.data()), data.size(), digest.data());
  return digest;
}

bool equal_in_constant_time(const Sha256& a, const Sha256& b) {
  return CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace selvage
