// SPDX-License-Identifier: MIT
//
// Four numbers at once, by the vector extension that g++ and clang share: SSE2, NEON or WebAssembly SIMD
// where there is any, plain code elsewhere. Every operation is one IEEE or integer operation a lane, never
// fused, so all of them give the same bits.
#pragma once

#include <bit>
#include <cstdint>

namespace selvage {

using IntLanes = std::int32_t __attribute__((vector_size(16)));
using FloatLanes = float __attribute__((vector_size(16)));

inline IntLanes splat(std::int32_t value) { return IntLanes{value, value, value, value}; }
inline FloatLanes splat(float value) { return FloatLanes{value, value, value, value}; }

inline FloatLanes to_float(IntLanes v) { return __builtin_convertvector(v, FloatLanes); }
inline FloatLanes absolute(FloatLanes v) {
  return std::bit_cast<FloatLanes>(std::bit_cast<IntLanes>(v) & 0x7FFFFFFF);
}
inline IntLanes clamped(IntLanes v, IntLanes low, IntLanes high) {
  v = v < low ? low : v;
  return v > high ? high : v;
}

/// To the nearest integer, halves away from zero. Anything beyond 2^28 becomes 2^28.
inline IntLanes rounded(FloatLanes v) {
  constexpr float kMost = 1 << 28;
  v = v < -kMost ? splat(-kMost) : v;
  v = v > kMost ? splat(kMost) : v;
  const IntLanes sign = std::bit_cast<IntLanes>(v) & splat(INT32_MIN);
  const auto half = std::bit_cast<FloatLanes>(sign | std::bit_cast<IntLanes>(splat(0.5F)));
  return __builtin_convertvector(v + half, IntLanes);
}

/// 8 times the binary logarithm, linear between powers of two. For v >= 1.
inline FloatLanes log8(FloatLanes v) {
  const IntLanes above_one = std::bit_cast<IntLanes>(v) - std::bit_cast<std::int32_t>(1.0F);
  return to_float(above_one) * (1.0F / (1 << 20));
}

/// Lanes 0 to 2; the last lane of the result means nothing.
inline FloatLanes cross(FloatLanes a, FloatLanes b) {
  const FloatLanes a1 = __builtin_shufflevector(a, a, 1, 2, 0, 3),
                   b1 = __builtin_shufflevector(b, b, 1, 2, 0, 3);
  const FloatLanes c = a * b1 - a1 * b;
  return __builtin_shufflevector(c, c, 1, 2, 0, 3);
}

inline float sum_of_three(FloatLanes v) { return v[0] + v[1] + v[2]; }

}  // namespace selvage
