// SPDX-License-Identifier: MIT
//
// STL, binary and ascii. The format has no vertex indices: corners with the same three float coordinates (0
// and -0 are the same) become one vertex, numbered by first appearance.
//
//     binary: 80 bytes of anything | u32 triangles | per triangle: 3 f32 normal, 9 f32 corners, u16 attribute
//
// Both kinds may begin with the word "solid". What decides is the size: a file exactly as long as its count
// says is binary.
#pragma once

#include <cstddef>
#include <span>

#include "common/base/result.h"
#include "common/mesh_io/mesh_file.h"

namespace selvage {

/// Safe on hostile input: the count is checked against the file's size before anything is allocated. Fewer
/// bytes behind the last triangle than one more would need are noted; more are an error.
Result<MeshFile> parse_stl(std::span<const std::byte> bytes);

/// Whether the size is exactly what the count of a binary file calls for.
bool is_exact_binary_stl(std::span<const std::byte> bytes);

}  // namespace selvage
