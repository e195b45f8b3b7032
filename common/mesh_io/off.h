// SPDX-License-Identifier: MIT
//
// OFF, the Object File Format of Geomview, in its text form:
//
//     OFF                       or COFF, NOFF, STOFF ... : colours, normals, texture coordinates follow each
//     vertex 8 6 12                    vertices, faces, edges (ignored); may stand on the line above 0 0 0 x
//     y z, and the rest of the line is not read 4 0 1 2 3                 corners, their indices, and the
//     rest of the line (a colour) is not read
//
// '#' starts a comment anywhere, also before the first line.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "common/base/result.h"
#include "common/mesh_io/mesh_file.h"

namespace selvage {

/// Safe on hostile input: the counts are checked against the bytes that could back them before anything is
/// allocated. The binary form and more than three dimensions (nOFF, 4OFF) are refused as Unsupported.
Result<MeshFile> parse_off(std::span<const std::byte> bytes);

/// Whether `word` is a first word of this format (OFF with any of its prefixes).
bool is_off_keyword(std::string_view word);

}  // namespace selvage
