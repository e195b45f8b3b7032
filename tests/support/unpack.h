// SPDX-License-Identifier: MIT
#pragma once

#include "client/stitch/part_collector.h"
#include "common/pack/pack.h"
#include "common/pack/selection.h"

namespace selvage {

/// Everything a selection gives, decoded and stitched straight from a pack.
inline Result<StitchedMesh> unpack(const Pack& pack, const Selection& selection = {}) {
  auto parts = select_parts(pack.directory(), selection);
  if (!parts) return forward_error(parts);
  PartCollector collector(pack.directory());
  for (const PartId& id : *parts) {
    if (auto ok = collector.add(id, pack.part(*pack.directory().find(id))); !ok) return forward_error(ok);
  }
  return collector.mesh();
}

}  // namespace selvage
