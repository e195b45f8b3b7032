// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "common/mesh/vec3.h"
#include "server/simplify/level_source.h"
#include "server/simplify/levels.h"
#include "server/simplify/strips.h"

namespace selvage {

/// Where a vertex comes to lie whose coordinates lose their low bits: the middle of its cell, as
/// common/codec/region_format.h's drop_bits and restore_bits have it. At most half a cell's diagonal away.
Vec3 without_low_bits(const GridPoint& p, int dropped);

/// Fills in `dropped_bits` of all levels: as many as make no more of an error than the collapses made, region
/// by region. Rounding turns no triangle over: where it would, the regions that the triangle touches keep
/// more bits at their levels, up to all of them. Between regions at different levels, triangles smaller than
/// a cell may turn: kept from that, slivers of a scan would keep every bit of their neighbours' coarse
/// levels.
void set_precisions(const LevelSource& source, std::span<const Strip> strips, LevelledMesh& levels);

}  // namespace selvage
