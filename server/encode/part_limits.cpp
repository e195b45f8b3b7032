// SPDX-License-Identifier: MIT
#include "server/encode/part_limits.h"

#include <algorithm>
#include <limits>
#include <string>

#include "common/coding/symbol_models.h"

namespace selvage {
namespace {

std::uint64_t open_edges(const CornerTable& table, const Partition& partition, RegionId region) {
  std::uint64_t count = 0;
  for (TriangleId t : partition.triangles_of(region)) {
    for (CornerId c = 3 * t; c < 3 * t + 3; ++c) {
      const CornerId across = table.opposite[c];
      count += across == kNone || partition.region_of_vertex[table.vertex(across)] != region;
    }
  }
  return count;
}

/// So many vertices, triangles or boundary indices as one byte of a part may stand for.
bool is_backed(std::uint64_t count, const Bytes& part) { return count <= kMaxSymbolsPerByte * part.size(); }

Result<void> check_part(const std::string& what, const Bytes& part, bool is_backed) {
  if (part.size() > std::numeric_limits<std::uint32_t>::max()) {
    return fail(ErrorCode::LimitExceeded, what + " takes " + std::to_string(part.size()) +
                                              " bytes, and a part has less than 4 GiB; cut the model into "
                                              "smaller regions");
  }
  if (!is_backed) {
    return fail(
        ErrorCode::LimitExceeded,
        what + " holds more than its " + std::to_string(part.size()) +
            " bytes may stand for: too many vertices in one place; use more grid bits, or merge them");
  }
  return {};
}

}  // namespace

Result<void> check_region_sizes(const CornerTable& table, const Partition& partition,
                                std::uint32_t most_symbols) {
  for (RegionId region = 1; region <= partition.region_count; ++region) {
    const std::uint64_t triangles = partition.triangles_of(region).size();
    // Edges need counting only where they could matter.
    if (4 * triangles <= most_symbols) continue;
    const std::uint64_t edges = open_edges(table, partition, region);
    if (triangles + edges <= most_symbols) continue;
    return fail(ErrorCode::LimitExceeded,
                "region " + std::to_string(region) + " has " + std::to_string(triangles) + " triangles and " +
                    std::to_string(edges) + " open edges, together more than the " +
                    std::to_string(most_symbols) +
                    " that one region may have; cut the model into smaller regions (--max-region)");
  }
  return {};
}

Result<void> check_parts(std::span<const RegionEntry> regions, std::span<const Bytes> parts) {
  auto part = parts.begin();
  for (RegionId id = 0; id < regions.size(); ++id) {
    const RegionEntry& entry = regions[id];
    const std::string name = "region " + std::to_string(id);
    for (auto level = entry.levels.rbegin(); level != entry.levels.rend(); ++level) {
      if (level->is_repeat) continue;
      const bool backs = is_backed(std::max(level->vertices, level->triangles), *part);
      if (auto ok = check_part(name, *part++, backs); !ok) return ok;
    }
    if (entry.bundle_triangles == 0) continue;
    // A bundle's coder may leave out its last byte.
    const bool backs = entry.bundle_triangles <= kMaxSymbolsPerByte * (part->size() + 1);
    if (auto ok = check_part("the bundle of " + name, *part++, backs); !ok) return ok;
  }
  return {};
}

}  // namespace selvage
