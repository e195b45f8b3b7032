// SPDX-License-Identifier: MIT
#include "client/decode/connectivity_decoder.h"

#include "common/codec/clers.h"
#include "common/codec/connectivity.h"
#include "common/codec/region_format.h"
#include "common/coding/entropy_decoder.h"

namespace selvage {
namespace {

tl::unexpected<Error> corrupt(const char* what) {
  return fail(ErrorCode::BadStream, std::string("region part: corrupt connectivity, ") + what);
}

/// A count and then that many ascending numbers below `limit`, each as a gap; nothing if they are not.
template <class ReadOne>
bool read_list(EntropyDecoder<1>& in, AdaptiveModel<33>& counts, std::uint32_t limit, ReadOne read_one) {
  const std::uint32_t count = in.number(counts);
  if (count > limit) return false;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!read_one() || !in.ok()) return false;
  }
  return true;
}

}  // namespace

Result<CornerTable> decode_connectivity(std::span<const std::byte> bytes, std::uint32_t symbols) {
  EntropyDecoder<1> in(bytes);
  ConnectivityModels models;

  // In step with encode_connectivity.
  std::vector<HandleSplit> splits;
  const bool splits_are_sound = read_list(in, models.counts, symbols, [&] {
    const std::uint32_t before = splits.empty() ? 0 : splits.back().split;
    const std::uint32_t gap = in.number(models.handle_gap), reach = in.number(models.handle_reach);
    const bool is_left = in.bits(1) != 0;
    if (gap >= symbols - before || reach >= before + gap) return false;
    splits.push_back({before + gap, before + gap - reach - 1, is_left});
    return true;
  });
  if (!splits_are_sound) return corrupt("impossible handle");

  ClersModels clers_models(ClersGrower::kContexts);
  ClersGrower grower(std::move(splits));
  for (std::uint32_t i = 0; i < symbols; ++i) {
    const auto symbol = static_cast<Clers>(in.symbol(clers_models[grower.context()]));
    if (!grower.grow(symbol) || !in.ok()) return corrupt("impossible symbol");
  }
  for (std::uint32_t gate = 0; gate < grower.open_gates(); ++gate) {
    if (in.symbol(models.is_closed) != 0 && !grower.close(gate))
      return corrupt("a component that does not close");
  }
  CornerTable grown = std::move(grower).take();

  std::vector<VertexId> virtual_vertices;
  const bool virtuals_are_sound = read_list(in, models.counts, grown.vertex_count(), [&] {
    const std::uint64_t before = virtual_vertices.empty() ? 0 : virtual_vertices.back();
    const std::uint64_t v = before + in.number(models.virtual_gap);
    if (v >= grown.vertex_count()) return false;
    virtual_vertices.push_back(static_cast<VertexId>(v));
    return true;
  });
  if (!virtuals_are_sound) return corrupt("impossible virtual vertex");
  if (!in.is_finished()) return corrupt("bytes left over or missing");
  auto connectivity = finish_connectivity(std::move(grown), virtual_vertices);
  if (!connectivity) return corrupt("virtual vertices that share a neighbour's fan");
  return std::move(connectivity->table);
}

}  // namespace selvage
