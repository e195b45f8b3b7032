// SPDX-License-Identifier: MIT
#include "bench/simplify/refinement_cost.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

namespace selvage::bench {
namespace {

using Rings = std::vector<std::vector<VertexId>>;

/// What is known of a vertex before it is coded.
struct Guess {
  Vec3 position, mean;
  std::array<Vec3, 3>
      steps;          ///< from `mean` towards other guesses: parallelograms, target, bending of the ring
  unsigned kind = 0;  ///< how much is known
  Vec3 normal, tangent;
  std::array<double, 5> logs;  ///< what residuals may be as large as
};

template <std::size_t N>
class LeastSquares {
 public:
  void add(const std::array<double, N>& x, double y) {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) a_[i][j] += x[i] * x[j];
      b_[i] += x[i] * y;
    }
  }
  std::array<double, N> solve() const {
    auto a = a_;
    auto b = b_;
    std::array<double, N> x{};
    for (std::size_t i = 0; i < N; ++i) a[i][i] += 1e-6 * (1 + a[i][i]);
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t row = i + 1; row < N; ++row) {
        const double factor = a[row][i] / a[i][i];
        for (std::size_t j = i; j < N; ++j) a[row][j] -= factor * a[i][j];
        b[row] -= factor * b[i];
      }
    }
    for (std::size_t i = N; i-- > 0;) {
      x[i] = b[i];
      for (std::size_t j = i + 1; j < N; ++j) x[i] -= a[i][j] * x[j];
      x[i] /= a[i][i];
    }
    return x;
  }

 private:
  std::array<std::array<double, N>, N> a_{};
  std::array<double, N> b_{};
};

constexpr unsigned kKinds = 8;

double log_of(double x) { return std::log2(x + 0.5); }

template <class Visit>
void around(const CornerTable& table, VertexId v, Visit visit) {
  const CornerId first = table.corner_of_vertex[v];
  CornerId c = first;
  do {
    visit(c);
    c = table.swing_ccw(c);
  } while (c != kNone && c != first);
}

Rings rings_of(const CornerTable& table) {
  Rings rings(table.vertex_count());
  for (VertexId v = 0; v < table.vertex_count(); ++v) {
    CornerId last = kNone;
    around(table, v, [&](CornerId c) {
      rings[v].push_back(table.vertex(next(c)));
      last = c;
    });
    if (table.swing_ccw(last) == kNone) rings[v].push_back(table.vertex(prev(last)));
  }
  return rings;
}

bool is_on_loop(const CornerTable& table, VertexId v) {
  bool is_open = false;
  around(table, v, [&](CornerId c) { is_open = is_open || table.swing_ccw(c) == kNone; });
  return is_open;
}

/// How many contracted edges lead to the vertex that is kept.
std::vector<unsigned> depths_of(const Refinement& region, const Rings& rings) {
  std::vector<unsigned> depth(rings.size(), kNone);
  std::vector<VertexId> queue;
  for (VertexId v = 0; v < rings.size(); ++v) {
    if (region.representative[v] == v) depth[v] = 0, queue.push_back(v);
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const VertexId w : rings[queue[i]]) {
      if (depth[w] != kNone || region.representative[w] != region.representative[queue[i]]) continue;
      depth[w] = depth[queue[i]] + 1;
      queue.push_back(w);
    }
  }
  return depth;
}

void add_flags(const Refinement& region, const Rings& rings, AdaptiveCode& code, RefinementBits& bits) {
  const std::vector<unsigned> depth = depths_of(region, rings);
  std::vector<bool> is_done(rings.size(), false);
  std::vector<VertexId> queue;
  std::vector<bool> is_queued(rings.size(), false);
  for (VertexId seed = 0; seed < rings.size(); ++seed) {
    if (!is_queued[seed]) queue.push_back(seed), is_queued[seed] = true;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const VertexId v = queue[i];
      unsigned kept = 0, gone = 0, kept_in_all = 0;
      for (const VertexId w : rings[v]) {
        if (is_done[w]) (depth[w] == 0 ? kept : gone) += 1;
        kept_in_all += depth[w] == 0;
        if (!is_queued[w]) queue.push_back(w), is_queued[w] = true;
      }
      is_done[v] = true;
      const bool is_loop = is_on_loop(region.table, v);
      const auto valence = static_cast<unsigned>(rings[v].size());
      const std::uint64_t context = (std::min(kept, 4u) * 5 + std::min(gone, 4u)) * 2 + is_loop;
      bits.kept_flags += code.bits(context * 16 + std::min(valence, 9u), depth[v] > 0, 2);
      if (depth[v] == 0) continue;
      // Flags come first, so that the target is one of those that are kept, or of those that are not.
      bits.targets += code.bits(1 << 20 | is_loop, depth[v] > 1, 2);
      const unsigned among = depth[v] > 1 ? valence - kept_in_all : kept_in_all;
      bits.targets += is_loop ? 1 : std::log2(std::max(among, 1u));
    }
    queue.clear();
  }
}

class Positions {
 public:
  Positions(const Refinement& region, const Rings& rings) : region_(region), rings_(rings) {
    for (VertexId v = 0; v < rings.size(); ++v) is_known_.push_back(region.representative[v] == v);
  }

  /// Calls take(guess, vertex) for every new vertex, those with most neighbours known first.
  template <class Take>
  void run(Take take) {
    std::set<std::pair<double, VertexId>> open;
    const auto share = [&](VertexId v) {
      const auto known =
          std::count_if(rings_[v].begin(), rings_[v].end(), [&](VertexId w) { return is_known_[w]; });
      return -static_cast<double>(known) / static_cast<double>(rings_[v].size());
    };
    std::vector<double> key(rings_.size(), 0);
    for (VertexId v = 0; v < rings_.size(); ++v) {
      if (!is_known_[v]) open.emplace(key[v] = share(v), v);
    }
    while (!open.empty()) {
      const VertexId v = open.begin()->second;
      open.erase(open.begin());
      take(guess(v), v);
      is_known_[v] = true;
      for (const VertexId w : rings_[v]) {
        if (is_known_[w]) continue;
        open.erase({key[w], w});
        open.emplace(key[w] = share(w), w);
      }
    }
  }

 private:
  const Vec3& at(VertexId v) const { return region_.positions[v]; }

  Vec3 mean_known(VertexId v, unsigned& count) const {
    Vec3 sum{};
    count = 0;
    for (const VertexId w : rings_[v]) {
      if (is_known_[w]) sum += at(w), ++count;
    }
    return count > 0 ? sum * (1.0 / count) : sum;
  }

  Guess guess(VertexId v) const {
    Guess guess;
    guess.position = at(v);
    unsigned known = 0;
    guess.mean = mean_known(v, known);
    const Vec3& mean = guess.mean;
    Vec3 parallelograms{}, bending{};
    unsigned parallelogram_count = 0, bent = 0;
    around(region_.table, v, [&](CornerId c) {
      const VertexId a = region_.table.vertex(next(c)), b = region_.table.vertex(prev(c));
      const CornerId across = region_.table.opposite[c];
      if (!is_known_[a] || !is_known_[b]) return;
      guess.normal += cross(at(a) - mean, at(b) - mean);
      if (across == kNone || !is_known_[region_.table.vertex(across)]) return;
      parallelograms += at(a) + at(b) - at(region_.table.vertex(across));
      ++parallelogram_count;
    });
    double radius = 0, height = 0;
    for (const VertexId w : rings_[v]) {
      if (!is_known_[w]) continue;
      unsigned around_w = 0;
      const Vec3 middle = mean_known(w, around_w);
      if (around_w > 2) bending += at(w) - middle, ++bent;
      radius += length(at(w) - mean) / known;
    }
    const VertexId target = region_.representative[v];
    const bool has_target = target != v && target != kNone;
    if (parallelogram_count > 0) guess.steps[0] = parallelograms * (1.0 / parallelogram_count) - mean;
    if (has_target) guess.steps[1] = at(target) - mean;
    if (bent > 0) guess.steps[2] = bending * (1.0 / bent);
    set_frame(guess);
    for (const VertexId w : rings_[v]) {
      if (is_known_[w]) height += std::abs(dot(guess.normal, at(w) - mean)) / known;
    }
    guess.kind = known == 0                      ? 0
                 : known == rings_[v].size()     ? 1 + (parallelogram_count > 0)
                 : 2 * known >= rings_[v].size() ? 3 + (parallelogram_count > 0)
                                                 : 5 + (parallelogram_count > 0);
    guess.logs = {log_of(radius), log_of(height), log_of(length(guess.steps[2])),
                  log_of(std::abs(dot(guess.normal, guess.steps[0]))), 1};
    return guess;
  }

  static void set_frame(Guess& guess) {
    const double l = length(guess.normal);
    guess.normal = l > 0 ? guess.normal * (1 / l) : Vec3{0, 0, 1};
    Vec3 along = guess.steps[1] - guess.normal * dot(guess.normal, guess.steps[1]);
    if (length(along) < 1e-9)
      along = cross(guess.normal, std::abs(guess.normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
    guess.tangent = along * (1 / length(along));
  }

  const Refinement& region_;
  const Rings& rings_;
  std::vector<bool> is_known_;
};

/// Magnitude in half octaves, a sign, and the rest as it is.
double residual_bits(double residual, double expected_log, std::uint64_t context, AdaptiveCode& code) {
  const auto magnitude = static_cast<std::uint32_t>(std::min(std::abs(residual) + 0.5, 1e9));
  unsigned symbol = magnitude;
  double rest = 0;
  if (magnitude >= 4) {
    const int width = std::bit_width(magnitude);
    symbol = 2 * static_cast<unsigned>(width) - 2 + (magnitude >> (width - 2) & 1);
    rest = width - 2;
  }
  const auto expected = static_cast<std::uint64_t>(std::clamp(2 * expected_log + 8, 0.0, 63.0));
  return code.bits(2 << 20 | context << 8 | expected, symbol, 64) + rest + (magnitude > 0);
}

}  // namespace

double AdaptiveCode::bits(std::uint64_t context, unsigned symbol, unsigned symbols) {
  std::vector<double>& counts = counts_[context];
  constexpr double kPrior = 0.05;
  if (counts.empty()) counts.assign(symbols + 1, kPrior), counts.back() = kPrior * symbols;
  const double bits = std::log2(counts.back() / counts[symbol]);
  counts[symbol] += 1;
  counts.back() += 1;
  return bits;
}

RefinementBits refinement_bits(std::span<const Refinement> regions) {
  RefinementBits bits;
  AdaptiveCode code;
  std::array<LeastSquares<3>, kKinds> blends;
  std::vector<Guess> guesses;
  for (const Refinement& region : regions) {
    const Rings rings = rings_of(region.table);
    bits.vertices += static_cast<std::uint32_t>(rings.size());
    add_flags(region, rings, code, bits);
    Positions(region, rings).run([&](const Guess& guess, VertexId) {
      for (int axis = 0; axis < 3; ++axis) {
        blends[guess.kind].add({guess.steps[0][axis], guess.steps[1][axis], guess.steps[2][axis]},
                               guess.position[axis] - guess.mean[axis]);
      }
      guesses.push_back(guess);
    });
  }
  bits.new_vertices = static_cast<std::uint32_t>(guesses.size());
  std::array<std::array<double, 3>, kKinds> blend;
  for (unsigned kind = 0; kind < kKinds; ++kind) blend[kind] = blends[kind].solve();
  std::vector<std::array<double, 3>> residuals;
  std::array<std::array<LeastSquares<5>, 3>, kKinds> sizes;
  for (const Guess& guess : guesses) {
    Vec3 left = guess.position - guess.mean;
    for (std::size_t i = 0; i < 3; ++i) left = left - guess.steps[i] * blend[guess.kind][i];
    residuals.push_back(
        {dot(left, guess.tangent), dot(left, cross(guess.normal, guess.tangent)), dot(left, guess.normal)});
    for (std::size_t axis = 0; axis < 3; ++axis)
      sizes[guess.kind][axis].add(guess.logs, log_of(std::abs(residuals.back()[axis])));
  }
  std::array<std::array<std::array<double, 5>, 3>, kKinds> size;
  for (unsigned kind = 0; kind < kKinds; ++kind) {
    for (std::size_t axis = 0; axis < 3; ++axis) size[kind][axis] = sizes[kind][axis].solve();
  }
  for (std::size_t i = 0; i < guesses.size(); ++i) {
    const Guess& guess = guesses[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double expected = 0;
      for (std::size_t j = 0; j < 5; ++j) expected += size[guess.kind][axis][j] * guess.logs[j];
      bits.positions += residual_bits(residuals[i][axis], expected, axis, code);
    }
  }
  return bits;
}

}  // namespace selvage::bench
