// SPDX-License-Identifier: MIT
#include "common/codec/bundle.h"

#include <algorithm>
#include <bit>

namespace selvage {
namespace {

std::uint64_t key_of(std::uint32_t tail, std::uint32_t head) { return std::uint64_t{tail} << 32 | head; }

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

void JoinGates::add_triangle(const std::array<std::uint32_t, 3>& corners, std::uint8_t history) {
  for (int k = 0; k < 3; ++k) add_edge(corners[k], corners[(k + 1) % 3], history);
}

void JoinGates::add_behind(const JoinGate& from, std::uint32_t z, JoinSymbol symbol) {
  const auto history = static_cast<std::uint8_t>((from.history << 2 | static_cast<int>(symbol)) & 15);
  add_edge(from.x, z, history);
  add_edge(z, from.y, history);
}

void JoinGates::add_edge(std::uint32_t tail, std::uint32_t head, std::uint8_t history) {
  if (topology_.slot_of(tail) == topology_.slot_of(head)) return;
  if (const auto waiting = open_.find(key_of(head, tail)); waiting != open_.end() && waiting->second > 0) {
    --waiting->second;
    return;
  }
  ++open_[key_of(tail, head)];
  stack_.push_back({tail, head, history});
}

bool JoinGates::pop(JoinGate& gate) {
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

AdaptiveModel<kJoinSymbols>& JoinModels::at(const BundleTopology& topology, const JoinGate& gate) {
  const std::uint32_t own = topology.own_slot();
  const bool touches_own = topology.slot_of(gate.x) == own || topology.slot_of(gate.y) == own;
  return symbol[gate.history * 2u + touches_own];
}

int index_bits(std::uint32_t count) { return count < 2 ? 0 : std::bit_width(count - 1); }

}  // namespace selvage
