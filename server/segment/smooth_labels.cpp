// SPDX-License-Identifier: MIT
#include "server/segment/smooth_labels.h"

#include <algorithm>
#include <array>
#include <vector>

namespace selvage {
namespace {

constexpr int kRounds = 2, kBandEdges = 3, kSteps = 3, kMaxShares = 4;

struct Share {
  std::uint32_t label = kNone;
  float amount = 0;
};
/// Greatest first, unused ones last with label kNone.
using Shares = std::array<Share, kMaxShares>;

bool is_only(const Shares& shares, std::uint32_t label) {
  return shares[0].label == label && shares[1].label == kNone;
}

/// Vertices within kBandEdges edges of a border, breadth first from it.
std::vector<VertexId> find_band(const Neighbours& neighbours,
                                const std::vector<std::uint32_t>& label_of_vertex,
                                std::vector<std::uint32_t>& place_in_band) {
  std::vector<VertexId> band;
  for (VertexId v = 0; v < neighbours.vertex_count(); ++v) {
    bool is_at_border = false;
    for (VertexId u : neighbours[v]) is_at_border |= label_of_vertex[u] != label_of_vertex[v];
    if (!is_at_border) continue;
    place_in_band[v] = static_cast<std::uint32_t>(band.size());
    band.push_back(v);
  }
  std::size_t at = 0;
  for (int step = 1; step < kBandEdges; ++step) {
    for (const std::size_t end = band.size(); at < end; ++at) {
      for (VertexId u : neighbours[band[at]]) {
        if (place_in_band[u] != kNone) continue;
        place_in_band[u] = static_cast<std::uint32_t>(band.size());
        band.push_back(u);
      }
    }
  }
  return band;
}

/// A sum of shares, of any number of labels.
class ShareSum {
 public:
  void clear() { sum_.clear(); }
  void add(const Shares& shares, float weight) {
    for (const Share& share : shares) {
      if (share.label != kNone) add(share.label, share.amount * weight);
    }
  }
  /// The greatest ones, scaled to sum to 1.
  Shares greatest() {
    std::sort(sum_.begin(), sum_.end(), [](const Share& a, const Share& b) {
      return a.amount != b.amount ? a.amount > b.amount : a.label < b.label;
    });
    Shares shares;
    float total = 0;
    for (std::size_t i = 0; i < std::min<std::size_t>(kMaxShares, sum_.size()); ++i) total += sum_[i].amount;
    for (std::size_t i = 0; i < std::min<std::size_t>(kMaxShares, sum_.size()); ++i) {
      shares[i] = {sum_[i].label, sum_[i].amount / total};
    }
    return shares;
  }

 private:
  void add(std::uint32_t label, float amount) {
    for (Share& share : sum_) {
      if (share.label == label) {
        share.amount += amount;
        return;
      }
    }
    if (sum_.size() < kMaxLabels) sum_.push_back({label, amount});
  }
  // Beside a vertex of enormous valence only the first few labels are heard.
  static constexpr std::size_t kMaxLabels = 32;
  std::vector<Share> sum_;
};

void smooth_once(const Neighbours& neighbours, std::span<const float> kappa,
                 std::vector<std::uint32_t>& label_of_vertex) {
  std::vector<std::uint32_t> place_in_band(neighbours.vertex_count(), kNone);
  const std::vector<VertexId> band = find_band(neighbours, label_of_vertex, place_in_band);
  std::vector<Shares> shares(band.size()), smoothed(band.size());
  for (std::size_t i = 0; i < band.size(); ++i) shares[i][0] = {label_of_vertex[band[i]], 1};

  ShareSum sum;
  const auto weight = [&](VertexId v, VertexId w) {
    return 1 / (1 + std::max(0.0f, -5 * (kappa[v] + kappa[w])));
  };
  const auto is_settled = [&](std::span<const VertexId> around, std::uint32_t label) {
    return std::all_of(around.begin(), around.end(), [&](VertexId w) {
      return place_in_band[w] == kNone ? label_of_vertex[w] == label
                                       : is_only(shares[place_in_band[w]], label);
    });
  };
  for (int step = 0; step < kSteps; ++step) {
    for (std::size_t i = 0; i < band.size(); ++i) {
      const VertexId v = band[i];
      if (is_settled(neighbours[v], shares[i][0].label) && is_only(shares[i], shares[i][0].label)) {
        smoothed[i] = shares[i];  // as the mean would be, which is most of the time
        continue;
      }
      float weight_sum = 0;
      for (VertexId w : neighbours[v]) weight_sum += weight(v, w);
      sum.clear();
      sum.add(shares[i], 1);
      for (VertexId w : neighbours[v]) {
        const bool is_in_band = place_in_band[w] != kNone;
        sum.add(is_in_band ? shares[place_in_band[w]] : Shares{{{label_of_vertex[w], 1}}},
                weight(v, w) / weight_sum);
      }
      smoothed[i] = sum.greatest();
    }
    shares.swap(smoothed);
  }
  for (std::size_t i = 0; i < band.size(); ++i) label_of_vertex[band[i]] = shares[i][0].label;
}

}  // namespace

void smooth_labels(const Neighbours& neighbours, std::span<const float> kappa, Minima& labels) {
  for (int round = 0; round < kRounds; ++round) smooth_once(neighbours, kappa, labels.label_of_vertex);
}

}  // namespace selvage
