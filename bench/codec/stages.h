// SPDX-License-Identifier: MIT
//
// Where the time goes, by stage; thread CPU time.
#pragma once

#include "common/codec/codec_tables.h"
#include "common/coding/byte_io.h"
#include "common/mesh/corner_table.h"

namespace selvage::bench {

struct DecodeStages {
  double directory = 0;     ///< header, pages and their hashes
  double connectivity = 0;  ///< of all regions
  double regions = 0;       ///< all of them, connectivity included
  double joins = 0;
};
/// Of every part of a pack, one after the other.
DecodeStages decode_stages(const Bytes& pack, const CodecTables& tables);

struct EncodeStages {
  double connectivity = 0;
  double all = 0;
};
/// Of one mesh as one region.
EncodeStages encode_stages(const CornerTable& table, std::span<const GridPoint> positions,
                           const CodecTables& tables);

}  // namespace selvage::bench
