// SPDX-License-Identifier: MIT
#include "client/stitch/vertex_numbers.h"

#include <algorithm>
#include <utility>

namespace selvage {

std::vector<VertexId> VertexNumbers::add(RegionId region, std::uint8_t level, const RegionMesh& mesh) {
  std::vector<VertexId> numbers(mesh.positions.size(), kNone);
  for (const Anchor& anchor : mesh.anchors) {
    numbers[anchor.vertex] = join_group(anchor.group, region, level, anchor.vertex);
  }
  for (VertexId v = 0; v < numbers.size(); ++v) {
    if (numbers[v] != kNone) continue;
    numbers[v] = take_number();
    owners_[numbers[v]] = {region, v};
  }
  return numbers;
}

void VertexNumbers::remove(RegionId region, std::uint8_t level, const RegionMesh& mesh,
                           const std::vector<VertexId>& numbers) {
  std::vector<bool> is_anchored(numbers.size(), false);
  for (const Anchor& anchor : mesh.anchors) {
    is_anchored[anchor.vertex] = true;
    leave_group(anchor.group, region, level);
  }
  for (VertexId v = 0; v < numbers.size(); ++v) {
    if (!is_anchored[v]) free(numbers[v]);
  }
}

VertexNumbers::Changes VertexNumbers::take_changes() { return std::exchange(changes_, {}); }

VertexId VertexNumbers::take_number() {
  if (free_.empty()) {
    owners_.emplace_back();
    return bound() - 1;
  }
  const VertexId number = free_.back();
  free_.pop_back();
  return number;
}

void VertexNumbers::free(VertexId number) {
  owners_[number] = {};
  free_.push_back(number);
  changes_.freed.push_back(number);
}

VertexId VertexNumbers::join_group(std::uint32_t group, RegionId region, std::uint8_t level,
                                   VertexId vertex) {
  const auto first = copies_.lower_bound({group, 0, 0});
  const bool is_known = first != copies_.end() && first->first.group == group;
  const VertexId number = is_known ? first->second.number : take_number();
  const auto [copy, is_new] = copies_.try_emplace({group, level, region}, Copy{number, vertex});
  // Of several copies in one region the lowest counts, whatever the order of anchors.
  if (!is_new) copy->second.vertex = std::min(copy->second.vertex, vertex);
  const bool is_owner = copy == copies_.lower_bound({group, 0, 0});
  if (is_owner) pass_on(number, {region, copy->second.vertex});
  return number;
}

void VertexNumbers::leave_group(std::uint32_t group, RegionId region, std::uint8_t level) {
  const auto copy = copies_.find({group, level, region});
  if (copy == copies_.end()) return;  // another copy in the region has done it
  const VertexId number = copy->second.number;
  copies_.erase(copy);
  const auto first = copies_.lower_bound({group, 0, 0});
  if (first == copies_.end() || first->first.group != group) return free(number);
  if (owners_[number].region == region) pass_on(number, {first->first.region, first->second.vertex});
}

void VertexNumbers::pass_on(VertexId number, const VertexOwner& owner) {
  owners_[number] = owner;
  changes_.passed_on.push_back(number);
}

}  // namespace selvage
