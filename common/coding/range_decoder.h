// SPDX-License-Identifier: MIT
//
// The decoder half of range_encoder.h. Safe on hostile bytes: past the end it reads zeros, and every symbol
// it gives is within its model. How many symbols are read is the caller's to bound, see kMaxSymbolsPerByte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/coding/symbol_models.h"

namespace selvage {

class RangeDecoder {
 public:
  RangeDecoder(std::span<const std::byte> bytes, std::span<const StartModel> start);

  unsigned symbol(unsigned model);
  /// Below `count`, which is at least 1.
  std::uint32_t uniform(std::uint32_t count);
  std::uint32_t number(unsigned length_model);

  /// False as soon as something came up that no encoder writes.
  bool ok() const { return is_sound_; }

  /// True if the bytes are exactly those that the encoder writes for what was read.
  bool is_finished() const;

 private:
  /// In which of `total` equal shares of the interval the stream lies.
  std::uint32_t share(std::uint32_t total);
  void narrow(std::uint32_t start, std::uint32_t size);
  std::uint32_t next_byte();

  SymbolModels models_;
  std::span<const std::byte> bytes_;
  std::size_t taken_ = 0;        ///< bytes looked at, those past the end included
  std::uint32_t window_ = 0;     ///< the last four of them
  std::uint32_t above_low_ = 0;  ///< how far the stream lies above the interval's low end
  std::uint32_t range_ = 0xFFFFFFFF;
  std::uint32_t unit_ = 0;  ///< of the share asked for last
  bool is_sound_ = true;
};

}  // namespace selvage
