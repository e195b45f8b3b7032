// SPDX-License-Identifier: MIT
//
// The parts of a pack as inputs of the fuzz targets fuzz_region, fuzz_bundle and fuzz_pack: their seeds are
// made from the golden packs, so that they are never of an older format.
#pragma once

#include <map>
#include <string>

#include "common/coding/byte_io.h"
#include "common/pack/pack.h"

namespace selvage {

/// By "TARGET/NAME", of some regions of the pack. Parts that are large, or do not fit the targets' short
/// headers, are left out.
std::map<std::string, Bytes> fuzz_seeds(const Pack& pack, const std::string& name);

}  // namespace selvage
