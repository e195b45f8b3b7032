// SPDX-License-Identifier: MIT
//
// Four numbers at once, by the vector extension that g++ and clang share: SSE2, NEON or WebAssembly SIMD
// where there is any, plain code elsewhere. Every operation is one IEEE or integer operation a lane, never
// fused, so all of them give the same bits.
#pragma once

#include <bit>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace selvage {

using IntLanes = std::int32_t __attribute__((vector_size(16)));
using FloatLanes = float __attribute__((vector_size(16)));

inline IntLanes splat(std::int32_t value) { return IntLanes{value, value, value, value}; }
inline FloatLanes splat(float value) { return FloatLanes{value, value, value, value}; }

inline FloatLanes to_float(IntLanes v) { return __builtin_convertvector(v, FloatLanes); }
inline FloatLanes absolute(FloatLanes v) {
  return std::bit_cast<FloatLanes>(std::bit_cast<IntLanes>(v) & 0x7FFFFFFF);
}
/// To the nearest integer, halves away from zero. For |v| < 2^31.
inline IntLanes rounded(FloatLanes v) {
  const IntLanes sign = std::bit_cast<IntLanes>(v) & splat(INT32_MIN);
  const auto half = std::bit_cast<FloatLanes>(sign | std::bit_cast<IntLanes>(splat(0.5F)));
  return __builtin_convertvector(v + half, IntLanes);
}

inline constexpr float kLogUnit = 1 << 20;

/// 8 times the binary logarithm of 4v + 1, linear between powers of two, times kLogUnit. For v >= 0.
inline IntLanes log_of_magnitudes(FloatLanes v) {
  return std::bit_cast<IntLanes>(v + 0.25F) - std::bit_cast<std::int32_t>(0.25F);
}
/// Bit i: whether lane i is negative, or true.
inline unsigned sign_bits(IntLanes v) {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps((__m128)v));
#else
  const IntLanes bits = v >> 31 & IntLanes{1, 2, 4, 8};
  return static_cast<unsigned>(bits[0] | bits[1] | bits[2] | bits[3]);
#endif
}

/// Lanes 0 to 2; the last lane of the result means nothing.
inline FloatLanes cross(FloatLanes a, FloatLanes b) {
  const FloatLanes a1 = __builtin_shufflevector(a, a, 1, 2, 0, 3),
                   b1 = __builtin_shufflevector(b, b, 1, 2, 0, 3);
  const FloatLanes c = a * b1 - a1 * b;
  return __builtin_shufflevector(c, c, 1, 2, 0, 3);
}

/// In lanes 0 and 1, for a and for b: lane 0 plus lane 2, plus lane 1.
inline FloatLanes sums_of_three(FloatLanes a, FloatLanes b) {
  const FloatLanes low = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                   high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  return low + high + __builtin_shufflevector(low, low, 2, 3, 2, 3);
}

}  // namespace selvage
