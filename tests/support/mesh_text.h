// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <string>

#include "common/mesh/triangle_soup.h"

namespace selvage {

/// The mesh as an OBJ file, coordinates to the last bit of a float.
inline std::string obj_text(const TriangleSoup& soup) {
  std::string text;
  char line[128];
  for (const Vec3& p : soup.positions) {
    std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", p.x, p.y, p.z);
    text += line;
  }
  for (const auto& triangle : soup.triangles) {
    std::snprintf(line, sizeof line, "f %u %u %u\n", triangle[0] + 1, triangle[1] + 1, triangle[2] + 1);
    text += line;
  }
  return text;
}

}  // namespace selvage
