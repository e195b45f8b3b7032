// SPDX-License-Identifier: MIT
//
// Numbers for the vertices of a mesh whose regions come and go. A number stays with its vertex as long as a
// region has it; copies of one vertex (a weld group) in several regions have one number.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "common/base/ids.h"
#include "common/codec/region_mesh.h"

namespace selvage {

/// Where a number's position comes from: of a weld group's copies, which may differ in precision, the one at
/// the finest level, then of the lowest region, then with the lowest number there.
struct VertexOwner {
  RegionId region = kNone;  ///< kNone: the number is free
  VertexId vertex = 0;      ///< in the region
};

class VertexNumbers {
 public:
  /// Numbers a region's vertices, the anchored ones as the present members of their groups. Needs a region
  /// that is not there.
  std::vector<VertexId> add(RegionId region, std::uint8_t level, const RegionMesh& mesh);
  /// Gives the numbers back that no other region uses. `numbers` and `mesh` are those of add().
  void remove(RegionId region, std::uint8_t level, const RegionMesh& mesh,
              const std::vector<VertexId>& numbers);

  const VertexOwner& owner(VertexId number) const { return owners_[number]; }
  /// All numbers are below.
  std::uint32_t bound() const { return static_cast<std::uint32_t>(owners_.size()); }

  /// What has happened since the last call: numbers that remove() gave back, and those that add() or remove()
  /// gave to another owner. May repeat, and may name numbers that have changed again.
  struct Changes {
    std::vector<VertexId> freed, passed_on;
  };
  Changes take_changes();

 private:
  /// A group's members lie together, its owner first.
  struct Member {
    std::uint32_t group = 0;
    std::uint8_t level = 0;
    RegionId region = 0;
    friend auto operator<=>(const Member&, const Member&) = default;
  };
  struct Copy {
    VertexId number, vertex;
  };

  VertexId take_number();
  void free(VertexId number);
  VertexId join_group(std::uint32_t group, RegionId region, std::uint8_t level, VertexId vertex);
  void leave_group(std::uint32_t group, RegionId region, std::uint8_t level);
  void pass_on(VertexId number, const VertexOwner& owner);

  std::vector<VertexOwner> owners_;  ///< by number
  std::vector<VertexId> free_;
  std::map<Member, Copy> copies_;
  Changes changes_;
};

}  // namespace selvage
