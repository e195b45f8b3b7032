// SPDX-License-Identifier: MIT
#include "client/decode/bundle_decoder.h"

#include "common/coding/entropy_decoder.h"

namespace selvage {
namespace {

class BundleDecoder {
 public:
  BundleDecoder(std::span<const std::byte> bytes, const BundleTopology& topology)
      : topology_(topology), in_(bytes) {}

  // In step with BundleEncoder::run.
  bool run(std::uint32_t triangle_count) {
    has_turned_ = in_.symbol(models_.has_turned) != 0;
    JoinGates gates(topology_);
    while (triangles_.size() < triangle_count) {
      if (!start(gates)) return false;
      for (JoinGate gate; gates.pop(gate);) {
        if (!cross(gate, gates) || triangles_.size() > triangle_count) return false;
      }
    }
    return in_.is_finished();
  }

  std::vector<BoundaryTriangle> take() && { return std::move(triangles_); }

 private:
  bool start(JoinGates& gates) {
    std::uint32_t x = 0, y = 0, z = 0;
    if (!vertex(x) || !vertex(y)) return false;
    const auto symbol = static_cast<JoinSymbol>(in_.symbol(models_.start));
    if (!tip(symbol, x, y, z) || !add(y, x, z)) return false;
    gates.add_triangle({y, x, z}, 0);
    return true;
  }

  bool cross(const JoinGate& gate, JoinGates& gates) {
    const auto symbol = static_cast<JoinSymbol>(in_.symbol(models_.at(topology_, gate)));
    if (symbol == JoinSymbol::None) return in_.ok();
    std::uint32_t z = 0;
    if (!tip(symbol, gate.x, gate.y, z) || !add(gate.y, gate.x, z)) return false;
    gates.add_behind(gate, z, symbol);
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
        return vertex(z);
      case JoinSymbol::None:
        break;
    }
    return false;
  }

  bool vertex(std::uint32_t& v) {
    const std::uint32_t below_own = in_.number(models_.slot);
    if (below_own > topology_.own_slot()) return false;
    const std::uint32_t slot = topology_.own_slot() - below_own;
    const std::uint32_t index = in_.bits(index_bits(topology_.vertex_count(slot)));
    if (index >= topology_.vertex_count(slot) || !in_.ok()) return false;
    v = topology_.vertex(slot, index);
    return true;
  }

  bool add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::uint32_t own = topology_.own_slot();
    const bool touches_own =
        topology_.slot_of(a) == own || topology_.slot_of(b) == own || topology_.slot_of(c) == own;
    if (a == b || b == c || c == a || !touches_own) return false;
    if (has_turned_) last_turned_ = in_.symbol(models_.turned[last_turned_]) != 0;
    triangles_.push_back(
        {{topology_.ref(a), topology_.ref(b), topology_.ref(c)}, has_turned_ && last_turned_});
    return in_.ok();
  }

  const BundleTopology& topology_;
  EntropyDecoder<1> in_;
  JoinModels models_;
  bool has_turned_ = false, last_turned_ = false;
  std::vector<BoundaryTriangle> triangles_;
};

}  // namespace

Result<std::vector<BoundaryTriangle>> decode_bundle(std::span<const std::byte> bytes,
                                                    const BundleTopology& topology,
                                                    std::uint32_t triangle_count) {
  if (triangle_count > kMaxSymbolsPerByte * bytes.size()) {
    return fail(ErrorCode::BadStream, "bundle part: more triangles than its bytes can hold");
  }
  BundleDecoder decoder(bytes, topology);
  if (!decoder.run(triangle_count)) return fail(ErrorCode::BadStream, "bundle part: corrupt joins");
  return std::move(decoder).take();
}

}  // namespace selvage
