// SPDX-License-Identifier: MIT
#include "client/decode/connectivity_decoder.h"

#include "common/codec/clers.h"
#include "common/codec/connectivity.h"
#include "common/codec/region_format.h"
#include <string>

namespace selvage {
namespace {

tl::unexpected<Error> corrupt(const char* what) {
  return fail(ErrorCode::BadStream, std::string("region part: corrupt connectivity, ") + what);
}

/// A count and then that many numbers, each read by `read_one`, which says whether it is sound.
template <class ReadOne>
bool read_list(EntropyDecoder& in, unsigned count_model, std::uint32_t limit, ReadOne read_one) {
  const std::uint32_t count = in.number(count_model);
  if (count > limit) return false;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!read_one() || !in.ok()) return false;
  }
  return true;
}

}  // namespace

Result<void> decode_connectivity(EntropyDecoder& in, std::uint32_t triangles, FanTable& table) {
  // In step with encode_connectivity. Symbols beyond the region's own triangles belong to fans around virtual
  // vertices: each such triangle has an edge on a boundary loop, so there are fewer of them than there are
  // edges.
  const std::int64_t extra = unfold_sign(in.number(region_model::kExtraSymbols));
  if (extra < -std::int64_t{triangles} || extra > 3 * std::int64_t{triangles} || !in.ok())
    return corrupt("more symbols than triangles allow");
  if (triangles + extra > FanTable::kMostTriangles) return corrupt("more triangles than a region may have");
  const auto symbols = static_cast<std::uint32_t>(triangles + extra);

  std::vector<HandleSplit> splits;
  const bool splits_are_sound = read_list(in, region_model::kHandleCount, symbols, [&] {
    const std::uint32_t before = splits.empty() ? 0 : splits.back().split;
    const std::uint32_t gap = in.number(region_model::kHandleGap),
                        reach = in.number(region_model::kHandleReach);
    const bool is_left = in.bits(1) != 0;
    if (gap >= symbols - before || reach >= before + gap) return false;
    splits.push_back({before + gap, before + gap - reach - 1, is_left});
    return true;
  });
  if (!splits_are_sound) return corrupt("impossible handle");

  ClersGrower grower(std::move(splits), symbols, table);
  for (std::uint32_t i = 0; i < symbols; ++i) {
    const unsigned symbol = in.symbol(region_model::kClers + grower.context());
    if (symbol >= kClersCount || !grower.grow(static_cast<Clers>(symbol)))
      return corrupt("impossible symbol");
  }
  if (!in.ok()) return corrupt("cut short");
  const std::uint32_t components = grower.finish();
  for (std::uint32_t gate = 0; gate < components; ++gate) {
    if (in.symbol(region_model::kIsClosed) != 0 && !grower.close(gate))
      return corrupt("a component that does not close");
  }

  std::vector<VertexId> virtual_vertices;
  const bool virtuals_are_sound = read_list(in, region_model::kVirtualCount, table.vertex_count(), [&] {
    const std::uint64_t before = virtual_vertices.empty() ? 0 : virtual_vertices.back();
    const std::uint64_t v = before + in.number(region_model::kVirtualGap);
    if (v >= table.vertex_count()) return false;
    virtual_vertices.push_back(static_cast<VertexId>(v));
    return true;
  });
  if (!virtuals_are_sound) return corrupt("impossible virtual vertex");
  if (!drop_virtual_fans(table, virtual_vertices)) return corrupt("virtual vertices out of order");
  return {};
}

}  // namespace selvage
