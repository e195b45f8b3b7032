// SPDX-License-Identifier: MIT
//
// VRML97 (.wrl): the triangles and polygons of every IndexedFaceSet, one after the other, in the file's order
// and in world coordinates (Transform nodes are applied). A Coordinate node that several face sets share by
// DEF and USE within one Transform gives one set of vertices, so that their surfaces stay joined.
//
// Not read, and refused as Unsupported rather than left out of the model: other solids (Box, Sphere, Cone,
// Cylinder, Extrusion, ElevationGrid), Inline, LOD, Switch, PROTO, USE of a node that holds geometry,
// mirroring or flattening scales, and VRML 1.0. Lines, points, text, appearance and the other attributes are
// dropped with a note.
#pragma once

#include <cstddef>
#include <span>

#include "common/base/result.h"
#include "common/mesh_io/mesh_file.h"

namespace selvage {

/// Safe on hostile input: keeps its own stack, bounded in depth, and memory stays within a small multiple of
/// `bytes`, however often a Coordinate is used again.
Result<MeshFile> parse_wrl(std::span<const std::byte> bytes);

}  // namespace selvage
