// SPDX-License-Identifier: MIT
#include "common/coding/range_encoder.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace selvage {
namespace {

/// The interval [low, low + range) in units of the byte after the next three. Bytes that are out may still
/// rise by a carry.
class Interval {
 public:
  /// Narrows to the share [start, start + size) of `total`.
  void narrow(std::uint32_t start, std::uint32_t size, std::uint32_t total) {
    const std::uint32_t unit = range_ / total;
    low_ += std::uint64_t{unit} * start;
    range_ = unit * size;
    for (; range_ < kRangeLow; range_ <<= 8) put_byte();
  }

  /// The number in the interval that takes the fewest bytes, the lowest of them.
  Bytes finish() && {
    const int least = bytes_.empty() ? 1 : 0;
    for (int kept = least;; ++kept) {
      const std::uint64_t below = (std::uint64_t{1} << (32 - 8 * kept)) - 1;
      const std::uint64_t number = (low_ + below) & ~below;
      if (number - low_ >= range_) continue;
      low_ = number;
      for (int i = 0; i < kept; ++i) put_byte();
      if (kept == 0) carry();
      return std::move(bytes_);
    }
  }

 private:
  void put_byte() {
    carry();
    bytes_.push_back(static_cast<std::byte>(low_ >> 24));
    low_ = low_ << 8 & 0xFFFFFFFF;
  }

  void carry() {
    if (low_ >> 32 == 0) return;
    low_ &= 0xFFFFFFFF;
    std::size_t at = bytes_.size();
    do {
      --at;
      bytes_[at] = static_cast<std::byte>(std::to_integer<unsigned>(bytes_[at]) + 1);
    } while (bytes_[at] == std::byte{0});
  }

  std::uint64_t low_ = 0;
  std::uint32_t range_ = 0xFFFFFFFF;
  Bytes bytes_;
};

}  // namespace

void RangeEncoder::uniform(std::uint32_t value, std::uint32_t count) {
  plain_.push_back({tokens_.size(), value, count});
}

void RangeEncoder::number(unsigned length_model, std::uint32_t value) {
  const int length = std::bit_width(value);
  symbol(length_model, static_cast<unsigned>(std::min(length, kLongNumber)));
  if (length >= kLongNumber) uniform(static_cast<std::uint32_t>(length - kLongNumber), 1u << kLongNumberBits);
  if (length > 1) uniform(value - (1u << (length - 1)), 1u << (length - 1));
}

double RangeEncoder::plain_bits() const {
  double bits = 0;
  for (const Plain& plain : plain_) bits += std::log2(plain.count);
  return bits;
}

Bytes RangeEncoder::finish(std::span<const StartModel> start) const {
  SymbolModels models(start);
  Interval interval;
  auto plain = plain_.begin();
  const auto code_plain = [&](std::size_t token) {
    for (; plain != plain_.end() && plain->before_token == token; ++plain) {
      const auto [before, value, count] = *plain;
      // High half first; where it is the last one, fewer low halves are left.
      const std::uint32_t high = value >> 16, last = (count - 1) >> 16;
      if (last > 0) interval.narrow(high, 1, last + 1);
      interval.narrow(value & 0xFFFF, 1, high < last ? kMostChoices : ((count - 1) & 0xFFFF) + 1);
    }
  };
  for (std::size_t i = 0; i < tokens_.size(); ++i) {
    code_plain(i);
    const SymbolRange range = models.range(tokens_[i].model, tokens_[i].symbol);
    interval.narrow(range.start, range.frequency, kProbabilityOne);
    models.update(tokens_[i].model, tokens_[i].symbol);
  }
  code_plain(tokens_.size());
  return std::move(interval).finish();
}

}  // namespace selvage
