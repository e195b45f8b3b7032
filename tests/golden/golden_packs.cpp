// SPDX-License-Identifier: MIT
#include "tests/golden/golden_packs.h"

#include "tests/support/labelled_pack.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

/// Whole numbers: sines and cosines differ in the last bit from one library to the next.
TriangleSoup rounded(TriangleSoup soup) {
  for (Vec3& p : soup.positions) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<double>(static_cast<long>(p[axis] * 1000)) / 8;
  }
  return soup;
}

/// Coordinates that repeat, of both signs, in the sphere's box: exact packs share the grid of fuzz inputs.
TriangleSoup stairs() {
  TriangleSoup soup = shapes::grid(20, 20);
  for (Vec3& p : soup.positions) {
    const int i = static_cast<int>(p.x), j = static_cast<int>(p.y);
    p = {(i - 10) * 0.1, (j / 2 - 5) * 0.2, ((i / 4) * (j / 4) % 5) * 0.3 - 1};
  }
  return soup;
}

GoldenPack make(const char* name, const TriangleSoup& soup, double cell, int bits, bool is_exact = false) {
  GoldenPack golden{name, rounded(soup), {}, bits, is_exact};
  golden.labels = cube_labels(golden.soup, cell);
  return golden;
}

}  // namespace

std::vector<GoldenPack> golden_packs() {
  TriangleSoup pieces = shapes::grid_with_holes(12, 12, 4);
  shapes::append(pieces, shapes::chain_of_tori(2));
  shapes::append(pieces, shapes::tetrahedron());
  TriangleSoup defects = shapes::mobius_strip(12);
  defects.triangles.push_back(defects.triangles[3]);  // twice
  defects.triangles.push_back({defects.triangles[0][0], defects.triangles[9][1], defects.triangles[5][2]});
  std::swap(defects.triangles[7][0], defects.triangles[7][1]);  // turned
  GoldenPack repeats = make("repeats", stairs(), 130, 10), exact_repeats = repeats;
  exact_repeats.name = "exact_repeats";
  exact_repeats.is_exact = true;
  repeats.level_ratios = {0.3};
  GoldenPack levels = make("levels", shapes::torus(20, 50), 200, 13);
  levels.level_ratios = {0.4, 0.15};
  return {make("torus", shapes::torus(16, 40), 150, 12), make("pieces", pieces, 400, 14),
          make("defects", defects, 100, 11), make("exact", shapes::sphere(3), 90, 10, true), levels, repeats, exact_repeats};
}

}  // namespace selvage
