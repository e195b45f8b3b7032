// SPDX-License-Identifier: MIT
//
// A whole pack: header, directory, then every part decoded and stitched. Hashes are not checked, so that the
// decoders behind them see damage.
#include <span>
#include <vector>

#include "client/stitch/part_collector.h"
#include "common/pack/pack.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace selvage;
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto pack = Pack::from_bytes({bytes.begin(), bytes.end()});
  if (!pack) return 0;
  PartCollector collector((*pack)->directory());
  for (RegionId id = 0; id < (*pack)->directory().regions.size(); ++id) {
    const RegionEntry& entry = (*pack)->directory().regions[id];
    for (std::uint8_t level = 0; level < entry.levels.size(); ++level)
      (void)collector.add({PartKind::Region, id, level}, (*pack)->part(entry.levels[level].part));
    if (entry.bundle.size > 0) (void)collector.add({PartKind::Bundle, id}, (*pack)->part(entry.bundle));
  }
  (void)collector.mesh();
  return 0;
}
