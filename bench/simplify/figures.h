// SPDX-License-Identifier: MIT
//
// What a simplifier makes of a mesh, in numbers.
#pragma once

#include <string>

#include "bench/simplify/peers.h"

namespace selvage::bench {

struct Figures {
  std::size_t triangles = 0;
  double hausdorff = 0, mean = 0;  // % of the diagonal
  double seconds = 0, megabytes = 0;
};

/// Repaired, in spatial order. False, and why on stderr, if the file is no mesh.
bool load(const std::string& path, BenchMesh& mesh);

/// CPU time is the least of the repeats.
Figures measure(const Simplifier& simplifier, const BenchMesh& mesh, double ratio, int repeats = 3);

/// Geometric means of one's figures over another's.
class Ratios {
 public:
  void add(const Figures& ours, const Figures& theirs);
  /// 1 each if nothing was added.
  Figures mean() const;

 private:
  Figures logarithms_;
  int count_ = 0;
};

}  // namespace selvage::bench
