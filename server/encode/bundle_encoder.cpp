// SPDX-License-Identifier: MIT
#include "server/encode/bundle_encoder.h"

#include <algorithm>

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
      : topology_(topology), triangles_(triangles), is_coded_(triangles.size(), false), progress_(topology) {
    corners_.reserve(triangles.size());
    for (const BoundaryTriangle& t : triangles) corners_.push_back(to_local(t));
    for (std::uint32_t t = 0; t < corners_.size(); ++t) {
      for (int k = 0; k < 3; ++k)
        half_edges_.push_back({corners_[t][k], corners_[t][(k + 1) % 3], t, corners_[t][(k + 2) % 3]});
    }
    std::sort(half_edges_.begin(), half_edges_.end());
  }

  Bytes run(std::span<const StartModel> start, RangeEncoder* symbols) && {
    has_turned_ = std::any_of(triangles_.begin(), triangles_.end(),
                              [](const BoundaryTriangle& t) { return t.is_turned; });
    out_.symbol(bundle_model::kHasTurned, has_turned_);
    start_at_own_edges();
    for (std::uint32_t seed = 0; seed < corners_.size(); ++seed) {
      if (!is_coded_[seed]) start_at_corners(seed);
    }
    Bytes bytes = out_.finish(start);
    if (symbols != nullptr) *symbols = std::move(out_);
    return bytes;
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

  void start_at_own_edges() {
    const std::uint32_t own = topology_.own_slot();
    std::uint32_t skipped = 0;
    for (std::uint32_t i = 0; i < topology_.vertex_count(own); ++i) {
      const std::uint32_t v = topology_.vertex(own, i);
      if (progress_.is_covered(v)) continue;
      const HalfEdge* seed = find_uncoded(topology_.after(v), v);
      if (seed == nullptr) {
        ++skipped;
        continue;
      }
      out_.symbol(bundle_model::kStart, static_cast<unsigned>(JoinStart::OwnEdge));
      out_.number(bundle_model::kStartSkip, skipped);
      vertex(bundle_model::kSlot, seed->tip);
      start({topology_.after(v), v, seed->tip}, seed->triangle);
      skipped = 0;
    }
  }

  void start_at_corners(std::uint32_t seed) {
    out_.symbol(bundle_model::kStart, static_cast<unsigned>(JoinStart::Corners));
    for (std::uint32_t v : corners_[seed]) vertex(bundle_model::kSlot, v);
    start(corners_[seed], seed);
  }

  void start(const Corners& corners, std::uint32_t triangle) {
    note(triangle);
    progress_.add_start(corners);
    for (JoinGate gate; progress_.pop(gate);) cross(gate);
  }

  void cross(const JoinGate& gate) {
    const HalfEdge* behind = find_uncoded(gate.y, gate.x);
    const JoinSymbol symbol = behind == nullptr ? JoinSymbol::None : symbol_of(gate.x, gate.y, behind->tip);
    out_.symbol(progress_.model_of(gate), static_cast<unsigned>(symbol));
    if (behind == nullptr) return;
    if (symbol == JoinSymbol::Other) vertex(bundle_model::kSlot1, behind->tip);
    note(behind->triangle);
    progress_.add_behind(gate, behind->tip, symbol);
  }

  /// An uncoded triangle with the edge tail -> head.
  const HalfEdge* find_uncoded(std::uint32_t tail, std::uint32_t head) const {
    auto it = std::lower_bound(half_edges_.begin(), half_edges_.end(), HalfEdge{tail, head, 0, 0});
    for (; it != half_edges_.end() && it->tail == tail && it->head == head; ++it) {
      if (!is_coded_[it->triangle]) return &*it;
    }
    return nullptr;
  }

  // In step with BundleDecoder::vertex.
  void vertex(unsigned slot_model, std::uint32_t v) {
    const std::uint32_t slot = topology_.slot_of(v), count = topology_.vertex_count(slot);
    out_.number(slot_model, topology_.own_slot() - slot);
    const std::uint32_t last = progress_.last_touched(slot);
    if (last == kNone) {
      out_.uniform(v - topology_.vertex(slot, 0), count);
    } else {
      out_.number(bundle_model::kTipGap, circular_gap(last, v, count));
    }
  }

  void note(std::uint32_t triangle) {
    is_coded_[triangle] = true;
    if (!has_turned_) return;
    out_.symbol(bundle_model::kTurned + last_turned_, triangles_[triangle].is_turned);
    last_turned_ = triangles_[triangle].is_turned;
  }

  const BundleTopology& topology_;
  std::span<const BoundaryTriangle> triangles_;
  std::vector<Corners> corners_;
  std::vector<HalfEdge> half_edges_;
  std::vector<bool> is_coded_;
  bool has_turned_ = false, last_turned_ = false;
  RangeEncoder out_;
  JoinProgress progress_;
};

}  // namespace

Bytes encode_bundle(const BundleTopology& topology, std::span<const BoundaryTriangle> triangles,
                    const CodecTables& tables, RangeEncoder* symbols) {
  return BundleEncoder(topology, triangles).run(tables.bundle, symbols);
}

}  // namespace selvage
