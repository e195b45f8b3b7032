// SPDX-License-Identifier: MIT
#include "common/coding/range_decoder.h"

#include "common/coding/range_encoder.h"

namespace selvage {

RangeDecoder::RangeDecoder(std::span<const std::byte> bytes, std::span<const StartModel> start)
    : models_(start), bytes_(bytes) {
  for (int i = 0; i < 4; ++i) above_low_ = above_low_ << 8 | next_byte();
}

std::uint32_t RangeDecoder::next_byte() {
  const std::uint32_t byte = taken_ < bytes_.size() ? std::to_integer<std::uint32_t>(bytes_[taken_]) : 0;
  ++taken_;
  window_ = window_ << 8 | byte;
  return byte;
}

std::uint32_t RangeDecoder::share(std::uint32_t total) {
  unit_ = range_ / total;
  const std::uint32_t at = above_low_ / unit_;
  if (at < total) return at;
  is_sound_ = false;  // in the few units that division leaves over
  above_low_ = 0;
  return 0;
}

void RangeDecoder::narrow(std::uint32_t start, std::uint32_t size) {
  above_low_ -= unit_ * start;
  range_ = unit_ * size;
  for (; range_ < kRangeLow; range_ <<= 8) above_low_ = above_low_ << 8 | next_byte();
}

unsigned RangeDecoder::symbol(unsigned model) {
  const unsigned symbol = models_.find(model, share(kProbabilityOne));
  const SymbolRange range = models_.range(model, symbol);
  narrow(range.start, range.frequency);
  models_.update(model, symbol);
  return symbol;
}

// In step with RangeEncoder::finish.
std::uint32_t RangeDecoder::uniform(std::uint32_t count) {
  const std::uint32_t last = (count - 1) >> 16;
  std::uint32_t high = 0;
  if (last > 0) {
    high = share(last + 1);
    narrow(high, 1);
  }
  const std::uint32_t low = share(high < last ? kMostChoices : ((count - 1) & 0xFFFF) + 1);
  narrow(low, 1);
  return high << 16 | low;
}

std::uint32_t RangeDecoder::number(unsigned length_model) {
  int length = static_cast<int>(symbol(length_model));
  if (length == kLongNumber) length += static_cast<int>(uniform(1u << kLongNumberBits));
  if (length > 32) is_sound_ = false, length = 0;
  return length < 2 ? static_cast<std::uint32_t>(length) : (1u << (length - 1)) + uniform(1u << (length - 1));
}

bool RangeDecoder::is_finished() const {
  if (!is_sound_) return false;
  // The encoder's choice again, with the interval's ends counted from the window.
  const std::int64_t low = std::int64_t{window_} - above_low_;
  const std::size_t put_out = taken_ - 4;
  for (int kept = put_out == 0 ? 1 : 0;; ++kept) {
    const std::int64_t below = (std::int64_t{1} << (32 - 8 * kept)) - 1;
    const std::int64_t number = (low + below) & ~below;
    if (number - low >= std::int64_t{range_}) continue;
    return number == std::int64_t{window_} && bytes_.size() == put_out + static_cast<std::size_t>(kept);
  }
}

}  // namespace selvage
