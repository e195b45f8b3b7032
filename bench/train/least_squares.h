// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace selvage::bench {

/// Weighted least squares by normal equations; a little of the identity keeps unseen directions at zero.
template <std::size_t N>
class LeastSquares {
 public:
  void add(const std::array<double, N>& x, double y, double weight) {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) a_[i][j] += weight * x[i] * x[j];
      a_[i][N] += weight * x[i] * y;
    }
    total_ += weight;
  }

  std::array<double, N> solve(double ridge) const {
    auto a = a_;
    for (std::size_t i = 0; i < N; ++i) a[i][i] += ridge;
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t r = 0; r < N; ++r) {
        if (r == i) continue;
        const double factor = a[r][i] / a[i][i];
        for (std::size_t c = i; c <= N; ++c) a[r][c] -= factor * a[i][c];
      }
    }
    std::array<double, N> x;
    for (std::size_t i = 0; i < N; ++i) x[i] = a[i][N] / a[i][i];
    return x;
  }

  double total() const { return total_; }

 private:
  std::array<std::array<double, N + 1>, N> a_{};
  double total_ = 0;
};

}  // namespace selvage::bench
