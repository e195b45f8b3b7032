// SPDX-License-Identifier: MIT
#include "tests/support/labelled_shapes.h"

#include <algorithm>
#include <utility>

#include "common/samples/samples.h"
#include "tests/simplify/simplify_support.h"
#include "tests/support/shapes.h"

namespace selvage {

std::vector<LabelledShape> labelled_shapes() {
  std::vector<LabelledShape> all = {{"torus", shapes::torus(30, 90), 1.1},
                                    {"sphere", shapes::sphere(5), 0.4},
                                    {"grid", shapes::grid_with_holes(40, 40, 8), 7},
                                    {"cylinder", shapes::open_cylinder(24, 40), 5},
                                    {"tori", shapes::chain_of_tori(3), 2},
                                    {"box", box_with_handle(), 6},
                                    {"lamp", lamp(48), 2.2}};
  for (const auto& [sample, cells] : {std::pair("dumbbell", 6.0), std::pair("waterneck", 7.0),
                                      std::pair("bracket", 6.0), std::pair("assembly", 6.0)}) {
    TriangleSoup soup = make_sample(sample, 8000).value();
    double side = 0;
    for (const Vec3& p : soup.positions) side = std::max({side, p.x, p.y, p.z});
    all.push_back({sample, std::move(soup), side / cells});
  }
  return all;
}

}  // namespace selvage
