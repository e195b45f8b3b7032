// SPDX-License-Identifier: MIT
#include "server/encode/bundle_encoder.h"

#include <algorithm>

#include "common/coding/entropy_encoder.h"

namespace selvage {
namespace {

using Corners = std::array<std::uint32_t, 3>;  // in the bundle's own vertex numbers

struct HalfEdge {
  std::uint32_t tail, head;
  std::uint32_t triangle, tip;
  friend auto operator<=>(const HalfEdge&, const HalfEdge&) = default;
};

class BundleEncoder {
 public:
  BundleEncoder(const BundleTopology& topology, std::span<const BoundaryTriangle> triangles)
      : topology_(topology), triangles_(triangles), is_coded_(triangles.size(), false) {
    corners_.reserve(triangles.size());
    for (const BoundaryTriangle& t : triangles) corners_.push_back(to_local(t));
    for (std::uint32_t t = 0; t < corners_.size(); ++t) {
      for (int k = 0; k < 3; ++k)
        half_edges_.push_back({corners_[t][k], corners_[t][(k + 1) % 3], t, corners_[t][(k + 2) % 3]});
    }
    std::sort(half_edges_.begin(), half_edges_.end());
  }

  Bytes run() && {
    const bool has_turned = std::any_of(triangles_.begin(), triangles_.end(),
                                        [](const BoundaryTriangle& t) { return t.is_turned; });
    out_.symbol(models_.has_turned, has_turned);
    has_turned_ = has_turned;
    JoinGates gates(topology_);
    for (std::uint32_t seed = 0; seed < corners_.size(); ++seed) {
      if (is_coded_[seed]) continue;
      start_at(seed, gates);
      for (JoinGate gate; gates.pop(gate);) cross(gate, gates);
    }
    return out_.finish<1>();
  }

 private:
  Corners to_local(const BoundaryTriangle& triangle) const {
    Corners corners;
    for (int k = 0; k < 3; ++k)
      corners[k] =
          topology_.vertex(topology_.slot_of_region(triangle.corners[k].region), triangle.corners[k].index);
    return corners;
  }

  JoinSymbol symbol_of(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    if (z == topology_.before(x)) return JoinSymbol::AdvanceX;
    if (z == topology_.after(y)) return JoinSymbol::AdvanceY;
    return JoinSymbol::Other;
  }

  // A start is a gate in full, then what lies behind it. Any of the three edges will do: best one that a
  // strip could have come through, with the tip next to it.
  void start_at(std::uint32_t seed, JoinGates& gates) {
    Corners corners = corners_[seed];
    for (int k = 0; k < 3 && symbol_of(corners[1], corners[0], corners[2]) == JoinSymbol::Other; ++k) {
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    }
    const auto [y, x, z] = corners;
    vertex(x);
    vertex(y);
    const JoinSymbol symbol = symbol_of(x, y, z);
    out_.symbol(models_.start, static_cast<unsigned>(symbol));
    if (symbol == JoinSymbol::Other) vertex(z);
    note(seed);
    gates.add_triangle(corners, 0);
  }

  void cross(const JoinGate& gate, JoinGates& gates) {
    const HalfEdge* behind = find_behind(gate);
    const JoinSymbol symbol = behind == nullptr ? JoinSymbol::None : symbol_of(gate.x, gate.y, behind->tip);
    out_.symbol(models_.at(topology_, gate), static_cast<unsigned>(symbol));
    if (behind == nullptr) return;
    if (symbol == JoinSymbol::Other) vertex(behind->tip);
    note(behind->triangle);
    gates.add_behind(gate, behind->tip, symbol);
  }

  /// The uncoded triangle with the edge y -> x.
  const HalfEdge* find_behind(const JoinGate& gate) const {
    auto it = std::lower_bound(half_edges_.begin(), half_edges_.end(), HalfEdge{gate.y, gate.x, 0, 0});
    for (; it != half_edges_.end() && it->tail == gate.y && it->head == gate.x; ++it) {
      if (!is_coded_[it->triangle]) return &*it;
    }
    return nullptr;
  }

  void vertex(std::uint32_t v) {
    const std::uint32_t slot = topology_.slot_of(v);
    out_.number(models_.slot, topology_.own_slot() - slot);
    out_.bits(v - topology_.vertex(slot, 0), index_bits(topology_.vertex_count(slot)));
  }

  void note(std::uint32_t triangle) {
    is_coded_[triangle] = true;
    if (!has_turned_) return;
    out_.symbol(models_.turned[last_turned_], triangles_[triangle].is_turned);
    last_turned_ = triangles_[triangle].is_turned;
  }

  const BundleTopology& topology_;
  std::span<const BoundaryTriangle> triangles_;
  std::vector<Corners> corners_;
  std::vector<HalfEdge> half_edges_;
  std::vector<bool> is_coded_;
  bool has_turned_ = false, last_turned_ = false;
  EntropyEncoder out_;
  JoinModels models_;
};

}  // namespace

Bytes encode_bundle(const BundleTopology& topology, std::span<const BoundaryTriangle> triangles) {
  return BundleEncoder(topology, triangles).run();
}

}  // namespace selvage
