// SPDX-License-Identifier: MIT
//
// Wavefront OBJ: vertices (`v`) and faces (`f` in all its forms: v, v/vt, v//vn, v/vt/vn, indices counted
// from the end when negative), and what their author called them (`g`, `o`, `usemtl`; 16 groups at once and
// 255 bytes a name are kept). Everything else of the format is stepped over and noted.
#pragma once

#include <cstddef>
#include <span>

#include "common/base/result.h"
#include "common/mesh_io/mesh_file.h"

namespace selvage {

/// Safe on hostile input; memory stays within a small multiple of `bytes`. A face may name vertices that come
/// later. Words that are no statement of the format are an error unless they look like one (some vendor's
/// own), which is noted.
Result<MeshFile> parse_obj(std::span<const std::byte> bytes);

}  // namespace selvage
