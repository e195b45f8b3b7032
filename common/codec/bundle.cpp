// SPDX-License-Identifier: MIT
#include "common/codec/bundle.h"

#include <algorithm>

namespace selvage {
namespace {

std::uint64_t key_of(std::uint32_t tail, std::uint32_t head) { return std::uint64_t{tail} << 32 | head; }

/// Below bundle_model::kRunContexts.
unsigned context_of(const JoinRuns& runs) {
  if (runs.side == JoinSymbol::None) return 0;
  unsigned context = runs.side == JoinSymbol::AdvanceY;
  for (std::size_t i = 0; i < kLongestRuns.size(); ++i)
    context = context * (i == 0 ? kLongestRuns[i] : kLongestRuns[i] + 1u) + runs.lengths[i] - (i == 0);
  return 1 + context;
}

std::uint8_t capped(std::uint8_t length, std::size_t run) { return std::min(length, kLongestRuns[run]); }

}  // namespace

BundleTopology::BundleTopology(std::vector<Region> regions) : regions_(std::move(regions)) {
  std::uint32_t total = 0;
  for (const Region& region : regions_) {
    base_.push_back(total);
    for (std::uint32_t length : region.loop_lengths) {
      loop_begin_.push_back(total);
      total += length;
    }
  }
  base_.push_back(total);
  loop_begin_.push_back(total);
}

std::uint32_t BundleTopology::slot_of(std::uint32_t vertex) const {
  return static_cast<std::uint32_t>(std::upper_bound(base_.begin(), base_.end(), vertex) - base_.begin() - 1);
}

std::uint32_t BundleTopology::slot_of_region(RegionId id) const {
  const auto it = std::lower_bound(regions_.begin(), regions_.end(), id,
                                   [](const Region& r, RegionId wanted) { return r.id < wanted; });
  return it != regions_.end() && it->id == id ? static_cast<std::uint32_t>(it - regions_.begin()) : kNone;
}

BoundaryRef BundleTopology::ref(std::uint32_t vertex) const {
  const std::uint32_t slot = slot_of(vertex);
  return {regions_[slot].id, vertex - base_[slot]};
}

BundleTopology::Loop BundleTopology::loop_of(std::uint32_t vertex) const {
  const auto end = std::upper_bound(loop_begin_.begin(), loop_begin_.end(), vertex);
  return {*(end - 1), *end - *(end - 1)};
}

std::uint32_t BundleTopology::after(std::uint32_t vertex) const {
  const Loop loop = loop_of(vertex);
  return vertex + 1 == loop.begin + loop.length ? loop.begin : vertex + 1;
}

std::uint32_t BundleTopology::before(std::uint32_t vertex) const {
  const Loop loop = loop_of(vertex);
  return vertex == loop.begin ? loop.begin + loop.length - 1 : vertex - 1;
}

JoinRuns JoinRuns::then(JoinSymbol symbol) const {
  if (symbol != JoinSymbol::AdvanceX && symbol != JoinSymbol::AdvanceY) return {};
  if (symbol == side)
    return {side, {capped(static_cast<std::uint8_t>(lengths[0] + 1), 0), lengths[1], lengths[2]}};
  return {symbol, {1, capped(lengths[0], 1), capped(lengths[1], 2)}};
}

JoinProgress::JoinProgress(const BundleTopology& topology)
    : topology_(topology),
      is_covered_(topology.total_vertices(), false),
      last_touched_(topology.slot_count(), kNone) {}

void JoinProgress::add_start(const std::array<std::uint32_t, 3>& corners) {
  add_triangle(corners);
  for (int k = 0; k < 3; ++k) add_gate(corners[k], corners[(k + 1) % 3], {});
}

void JoinProgress::add_behind(const JoinGate& from, std::uint32_t z, JoinSymbol symbol) {
  add_triangle({from.y, from.x, z});
  const JoinRuns runs = from.runs.then(symbol);
  add_gate(from.x, z, runs);
  add_gate(z, from.y, runs);
}

void JoinProgress::add_triangle(const std::array<std::uint32_t, 3>& corners) {
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t tail = corners[k], head = corners[(k + 1) % 3];
    last_touched_[topology_.slot_of(tail)] = tail;
    // The boundary triangle runs its loop edge against the loop's own direction.
    if (topology_.after(head) == tail) is_covered_[head] = true;
  }
}

/// An edge that meets a waiting gate closes it, others wait. Edges within one region are not gates: a region
/// triangle lies behind them, or nothing that a strip would reach.
void JoinProgress::add_gate(std::uint32_t tail, std::uint32_t head, const JoinRuns& runs) {
  if (topology_.slot_of(tail) == topology_.slot_of(head)) return;
  if (const auto waiting = open_.find(key_of(head, tail)); waiting != open_.end() && waiting->second > 0) {
    --waiting->second;
    return;
  }
  ++open_[key_of(tail, head)];
  stack_.push_back({tail, head, runs});
}

bool JoinProgress::pop(JoinGate& gate) {
  while (!stack_.empty()) {
    gate = stack_.back();
    stack_.pop_back();
    std::uint32_t& waiting = open_[key_of(gate.x, gate.y)];
    if (waiting == 0) continue;  // closed from its other side meanwhile
    --waiting;
    return true;
  }
  return false;
}

unsigned JoinProgress::model_of(const JoinGate& gate) const {
  const std::uint32_t own = topology_.own_slot();
  const unsigned own_end = topology_.slot_of(gate.x) == own ? 1 : topology_.slot_of(gate.y) == own ? 2 : 0;
  const bool x_is_covered = is_covered_[topology_.before(gate.x)], y_is_covered = is_covered_[gate.y];
  const unsigned covered = 2u * x_is_covered + y_is_covered;
  return bundle_model::kStep + (context_of(gate.runs) * 4u + covered) * 3u + own_end;
}

std::uint32_t circular_gap(std::uint32_t from, std::uint32_t to, std::uint32_t count) {
  const std::uint32_t up = to >= from ? to - from : to + count - from, down = count - up;
  return up <= down ? 2 * up : 2 * down - 1;
}

std::uint32_t circular_step(std::uint32_t from, std::uint32_t gap, std::uint32_t base, std::uint32_t count) {
  const std::uint64_t distance = (std::uint64_t{gap} + 1) / 2 % count;
  const std::uint64_t up = gap % 2 == 0 ? distance : count - distance;
  return base + static_cast<std::uint32_t>((from - base + up) % count);
}

}  // namespace selvage
