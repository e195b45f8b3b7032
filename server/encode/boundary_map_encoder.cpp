// SPDX-License-Identifier: MIT
#include "server/encode/boundary_map_encoder.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "common/codec/region_format.h"

namespace selvage {
namespace {

/// Every boundary vertex's loop and place on it.
struct LoopPlace {
  std::uint32_t loop = 0, place = 0;
};

std::vector<LoopPlace> places_on_loops(const RegionMesh& mesh) {
  std::vector<LoopPlace> place_of_vertex(mesh.vertex_count());
  std::uint32_t index = 0;
  for (std::uint32_t loop = 0; loop < mesh.loops.lengths.size(); ++loop) {
    for (std::uint32_t place = 0; place < mesh.loops.lengths[loop]; ++place)
      place_of_vertex[mesh.loops.vertices[index++]] = {loop, place};
  }
  return place_of_vertex;
}

/// How many indices each vertex stands for, one after another around the loop, beginning at index `lead`.
std::vector<std::uint32_t> runs_around(std::span<const VertexId> vertex_of_index, std::uint32_t lead) {
  std::vector<std::uint32_t> runs;
  const auto length = static_cast<std::uint32_t>(vertex_of_index.size());
  for (std::uint32_t i = 0; i < length; ++i) {
    const std::uint32_t at = (lead + i) % length, before = (at + length - 1) % length;
    if (i == 0 || vertex_of_index[at] != vertex_of_index[before]) runs.push_back(0);
    ++runs.back();
  }
  return runs;
}

}  // namespace

// In step with decode_boundary_map.
void encode_boundary_map(const RegionMesh& mesh, std::span<const std::uint32_t> finest_loop_lengths,
                         EntropyEncoder& out) {
  const std::vector<LoopPlace> place_of_vertex = places_on_loops(mesh);
  std::uint32_t expected_loop = 0;
  std::span<const VertexId> rest(mesh.vertex_of_boundary);
  for (const std::uint32_t length : finest_loop_lengths) {
    const auto vertex_of_index = rest.first(length);
    rest = rest.subspan(length);
    std::uint32_t lead = 0;
    while (vertex_of_index[lead] == vertex_of_index[(lead + length - 1) % length]) ++lead;
    const auto [loop, place] = place_of_vertex[vertex_of_index[lead]];
    out.number(region_model::kMapLoop, fold_sign(static_cast<std::int32_t>(loop - expected_loop)));
    expected_loop = loop + 1;
    out.number(region_model::kMapLead, lead);
    out.bits(place, std::bit_width(mesh.loops.lengths[loop] - 1));
    const std::vector<std::uint32_t> runs = runs_around(vertex_of_index, lead);
    for (const std::uint32_t run : std::span(runs).first(runs.size() - 1)) {
      out.symbol(region_model::kMapRun, std::min(run - 1, kRunEscape));
      if (run - 1 >= kRunEscape) out.number(region_model::kMapExcess, run - 1 - kRunEscape);
    }
  }
}

}  // namespace selvage
