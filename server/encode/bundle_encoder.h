// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "common/codec/bundle.h"
#include "common/coding/byte_io.h"
#include "common/coding/range_encoder.h"

namespace selvage {

/// The boundary triangles of one bundle, in any order (docs/FORMAT.md, "Bundle part"). Every corner must be
/// in `topology`, every triangle must touch its own region. Mirror: client/decode/bundle_decoder.h.
Bytes encode_bundle(const BundleTopology& topology, std::span<const BoundaryTriangle> triangles,
                    const CodecTables& tables = shipped_tables(), RangeEncoder* symbols = nullptr);

}  // namespace selvage
