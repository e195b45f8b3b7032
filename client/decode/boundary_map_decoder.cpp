// SPDX-License-Identifier: MIT
#include "client/decode/boundary_map_decoder.h"

#include <bit>
#include <numeric>
#include <string>
#include <vector>

#include "common/codec/region_format.h"

namespace selvage {
namespace {

using Decoder = EntropyDecoder;

tl::unexpected<Error> corrupt(const char* what) {
  return fail(ErrorCode::BadStream, std::string("region part: corrupt boundary map, ") + what);
}

/// One loop of the finest level: `vertex_of_index` receives the vertices of `coarse`, a loop of this one,
/// each for a run of indices.
Result<void> decode_loop(Decoder& in, std::span<const VertexId> coarse, std::span<VertexId> vertex_of_index) {
  const auto length = static_cast<std::uint32_t>(vertex_of_index.size());
  const auto kept = static_cast<std::uint32_t>(coarse.size());
  const std::uint32_t lead = in.number(region_model::kMapLead);
  const std::uint32_t first = in.bits(std::bit_width(kept - 1));
  if (kept > length || lead >= length || first >= kept) return corrupt("a loop that does not fit");
  std::uint32_t at = lead, left = length;
  for (std::uint32_t i = 0; i < kept; ++i) {
    std::uint64_t run = left;  // of the last vertex: what the others leave
    if (i + 1 < kept) {
      run = std::uint64_t{in.symbol(region_model::kMapRun)} + 1;
      if (run > kRunEscape) run += in.number(region_model::kMapExcess);
      if (run > left - (kept - 1 - i)) return corrupt("a run that is too long");
    } else if (lead >= run) {
      return corrupt("a lead that is too long");
    }
    const VertexId vertex = coarse[(first + i) % kept];
    for (std::uint64_t j = 0; j < run; ++j, at = at + 1 == length ? 0 : at + 1) vertex_of_index[at] = vertex;
    left -= static_cast<std::uint32_t>(run);
  }
  if (!in.ok()) return corrupt("bytes missing");
  return {};
}

}  // namespace

// In step with encode_boundary_map.
Result<void> decode_boundary_map(Decoder& in, std::span<const std::uint32_t> finest_loop_lengths,
                                 RegionMesh& mesh) {
  const BoundaryLoops& loops = mesh.loops;
  if (loops.lengths.size() != finest_loop_lengths.size()) return corrupt("another number of loops");
  std::vector<std::uint32_t> begin_of_loop(loops.lengths.size(), 0);
  std::vector<bool> is_taken(loops.lengths.size(), false);
  for (std::size_t i = 1; i < begin_of_loop.size(); ++i)
    begin_of_loop[i] = begin_of_loop[i - 1] + loops.lengths[i - 1];
  mesh.vertex_of_boundary.resize(
      std::accumulate(finest_loop_lengths.begin(), finest_loop_lengths.end(), std::size_t{0}));
  std::span<VertexId> rest(mesh.vertex_of_boundary);
  std::uint32_t expected_loop = 0;
  for (const std::uint32_t length : finest_loop_lengths) {
    const std::uint32_t loop =
        expected_loop + static_cast<std::uint32_t>(unfold_sign(in.number(region_model::kMapLoop)));
    if (loop >= is_taken.size() || is_taken[loop]) return corrupt("a loop that is not there or taken");
    is_taken[loop] = true;
    expected_loop = loop + 1;
    const auto coarse = std::span(loops.vertices).subspan(begin_of_loop[loop], loops.lengths[loop]);
    if (auto ok = decode_loop(in, coarse, rest.first(length)); !ok) return ok;
    rest = rest.subspan(length);
  }
  return {};
}

}  // namespace selvage
