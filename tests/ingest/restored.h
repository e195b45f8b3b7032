// SPDX-License-Identifier: MIT
//
// The claim that repair loses nothing, as a checkable property.
#pragma once

#include "server/ingest/repair.h"

namespace selvage {

/// The soup's triangles as `mesh` remembers them: un-turned, in the file's vertices, at the file's places. A
/// triangle that the mesh does not hold is {kNone, kNone, kNone}; one that it holds twice fails the test.
std::vector<Triangle> restored_triangles(const RepairedMesh& mesh, std::size_t soup_triangle_count);

/// What must come back: the soup's triangles, without those that repeat an index.
std::vector<Triangle> expected_triangles(const TriangleSoup& soup);

/// Expects a valid table, maps of matching sizes, the file's positions, and exactly the file's triangles.
void expect_lossless(const RepairedMesh& mesh, const TriangleSoup& soup);

/// A soup of random triangles over few vertices, repeated indices included, so that everything which can be
/// wrong with connectivity is.
TriangleSoup random_soup(std::uint32_t seed);

}  // namespace selvage
