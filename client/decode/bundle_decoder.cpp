// SPDX-License-Identifier: MIT
#include "client/decode/bundle_decoder.h"

#include "common/coding/range_decoder.h"

namespace selvage {
namespace {

class BundleDecoder {
 public:
  BundleDecoder(std::span<const std::byte> bytes, const BundleTopology& topology,
                std::span<const StartModel> start)
      : topology_(topology), in_(bytes, start), progress_(topology) {}

  // In step with BundleEncoder::run.
  bool run(std::uint32_t triangle_count) {
    has_turned_ = in_.symbol(bundle_model::kHasTurned) != 0;
    while (triangles_.size() < triangle_count) {
      if (!start()) return false;
      for (JoinGate gate; progress_.pop(gate);) {
        if (!cross(gate) || triangles_.size() > triangle_count) return false;
      }
    }
    return in_.is_finished();
  }

  std::vector<BoundaryTriangle> take() && { return std::move(triangles_); }

 private:
  bool start() {
    std::uint32_t a = 0, b = 0, c = 0;
    switch (static_cast<JoinStart>(in_.symbol(bundle_model::kStart))) {
      case JoinStart::OwnEdge:
        if (!own_edge(a, b) || !vertex(bundle_model::kSlot, c)) return false;
        break;
      case JoinStart::Corners:
        if (!vertex(bundle_model::kSlot, a) || !vertex(bundle_model::kSlot, b) ||
            !vertex(bundle_model::kSlot, c))
          return false;
        break;
      default:
        return false;
    }
    if (!add(a, b, c)) return false;
    progress_.add_start({a, b, c});
    return true;
  }

  /// The own loop edge that so many uncovered ones come before, counted from the last one that a start named.
  bool own_edge(std::uint32_t& tail, std::uint32_t& head) {
    std::uint32_t skip = in_.number(bundle_model::kStartSkip);
    const std::uint32_t own = topology_.own_slot();
    for (; next_own_ < topology_.vertex_count(own); ++next_own_) {
      head = topology_.vertex(own, next_own_);
      if (progress_.is_covered(head)) continue;
      if (skip-- > 0) continue;
      tail = topology_.after(head);
      ++next_own_;
      return in_.ok();
    }
    return false;
  }

  bool cross(const JoinGate& gate) {
    const auto symbol = static_cast<JoinSymbol>(in_.symbol(progress_.model_of(gate)));
    if (symbol == JoinSymbol::None) return in_.ok();
    std::uint32_t z = 0;
    if (!tip(symbol, gate.x, gate.y, z) || !add(gate.y, gate.x, z)) return false;
    progress_.add_behind(gate, z, symbol);
    return true;
  }

  bool tip(JoinSymbol symbol, std::uint32_t x, std::uint32_t y, std::uint32_t& z) {
    switch (symbol) {
      case JoinSymbol::AdvanceX:
        z = topology_.before(x);
        return true;
      case JoinSymbol::AdvanceY:
        z = topology_.after(y);
        return true;
      case JoinSymbol::Other:
        return vertex(bundle_model::kSlot1, z);
      case JoinSymbol::None:
        break;
    }
    return false;
  }

  // In step with BundleEncoder::vertex.
  bool vertex(unsigned slot_model, std::uint32_t& v) {
    const std::uint32_t below_own = in_.number(slot_model);
    if (below_own > topology_.own_slot()) return false;
    const std::uint32_t slot = topology_.own_slot() - below_own, count = topology_.vertex_count(slot);
    const std::uint32_t last = progress_.last_touched(slot), base = topology_.vertex(slot, 0);
    if (count == 0) return false;
    if (last == kNone) {
      v = base + in_.uniform(count);
    } else {
      v = circular_step(last, in_.number(bundle_model::kTipGap), base, count);
    }
    return in_.ok();
  }

  bool add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::uint32_t own = topology_.own_slot();
    const bool touches_own =
        topology_.slot_of(a) == own || topology_.slot_of(b) == own || topology_.slot_of(c) == own;
    if (a == b || b == c || c == a || !touches_own) return false;
    if (has_turned_) last_turned_ = in_.symbol(bundle_model::kTurned + last_turned_) != 0;
    triangles_.push_back(
        {{topology_.ref(a), topology_.ref(b), topology_.ref(c)}, has_turned_ && last_turned_});
    return in_.ok();
  }

  const BundleTopology& topology_;
  RangeDecoder in_;
  JoinProgress progress_;
  std::uint32_t next_own_ = 0;
  bool has_turned_ = false, last_turned_ = false;
  std::vector<BoundaryTriangle> triangles_;
};

}  // namespace

std::uint64_t decode_memory_bound(const BundleTopology& topology, std::uint32_t triangle_count) {
  return 65536 + 256 * std::uint64_t{triangle_count} + topology.total_vertices();
}

Result<std::vector<BoundaryTriangle>> decode_bundle(std::span<const std::byte> bytes,
                                                    const BundleTopology& topology,
                                                    std::uint32_t triangle_count, const CodecTables& tables) {
  if (triangle_count > kMaxSymbolsPerByte * (bytes.size() + 1)) {
    return fail(ErrorCode::BadStream, "bundle part: more triangles than its bytes can hold");
  }
  BundleDecoder decoder(bytes, topology, tables.bundle);
  if (!decoder.run(triangle_count)) return fail(ErrorCode::BadStream, "bundle part: corrupt joins");
  return std::move(decoder).take();
}

}  // namespace selvage
