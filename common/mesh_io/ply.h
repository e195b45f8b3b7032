// SPDX-License-Identifier: MIT
//
// PLY, the Stanford polygon format: ascii, binary little-endian and binary big-endian; any scalar types; any
// other elements and properties, which are stepped over and noted; triangle strips (`tristrips`) as well as
// faces.
#pragma once

#include <cstddef>
#include <span>

#include "common/base/result.h"
#include "common/mesh_io/mesh_file.h"

namespace selvage {

/// Safe on hostile input: every count is checked against the bytes that could back it before anything is
/// allocated. An ascii record stands on one line (only the items of a list may run on): a line that holds
/// more or less than the header declares is an error, as are bytes after the last element.
Result<MeshFile> parse_ply(std::span<const std::byte> bytes);

}  // namespace selvage
