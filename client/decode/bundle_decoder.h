// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "common/base/result.h"
#include "common/codec/bundle.h"

namespace selvage {

/// The most heap memory that decode_bundle takes at once, the result included, whatever the bytes.
std::uint64_t decode_memory_bound(const BundleTopology& topology, std::uint32_t triangle_count);

/// Decodes one bundle. Needs only the directory: which regions it touches, their loop lengths, and how many
/// triangles it holds; not the regions themselves. Safe on hostile input: every corner it gives is within its
/// region's loops, every triangle has three different corners and touches the bundle's own region.
Result<std::vector<BoundaryTriangle>> decode_bundle(std::span<const std::byte> bytes,
                                                    const BundleTopology& topology,
                                                    std::uint32_t triangle_count,
                                                    const CodecTables& tables = shipped_tables());

}  // namespace selvage
