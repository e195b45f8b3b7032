// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "common/base/hash.h"

namespace selvage {

/// hash_of() for data that comes in pieces.
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

}  // namespace selvage
