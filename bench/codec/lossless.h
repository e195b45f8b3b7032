// SPDX-License-Identifier: MIT
//
// Positions bit for bit, against general compressors of the raw floats.
#pragma once

#include "bench/support/corpus.h"
#include "common/codec/codec_tables.h"

namespace selvage::bench {

struct LosslessSizes {
  std::size_t ours = 0;  ///< region parts without their connectivity, in default segmentation, at 14 bits
  std::size_t xz = 0;    ///< xz -9 of the float32 positions in the file's order
  std::size_t zstd = 0;  ///< zstd -19 of the same
};
/// Coordinates that are no floats are rounded to floats first, for all alike.
LosslessSizes lossless_sizes(const Model& model, const CodecTables& tables);

}  // namespace selvage::bench
