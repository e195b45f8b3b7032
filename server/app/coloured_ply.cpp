// SPDX-License-Identifier: MIT
#include "server/app/coloured_ply.h"

#include "common/coding/byte_io.h"

namespace selvage {

std::string coloured_ply(const TriangleSoup& soup, std::span<const RegionId> region_of_triangle,
                         std::span<const Rgb> colour_of_region) {
  std::string ply =
      "ply\nformat binary_little_endian 1.0\ncomment regions of selvage-pack segment\nelement vertex " +
      std::to_string(soup.positions.size()) +
      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
      std::to_string(soup.triangles.size()) +
      "\nproperty list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nproperty int region\nend_header\n";
  ByteWriter body;
  for (const Vec3& p : soup.positions) {
    for (int axis = 0; axis < 3; ++axis) body.f64(p[axis]);
  }
  for (TriangleId t = 0; t < soup.triangles.size(); ++t) {
    body.u8(3);
    for (VertexId v : soup.triangles[t]) body.u32(v);
    const Rgb colour = colour_of_region[region_of_triangle[t]];
    body.u8(colour.r);
    body.u8(colour.g);
    body.u8(colour.b);
    body.u32(region_of_triangle[t]);
  }
  const Bytes bytes = std::move(body).take();
  ply.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return ply;
}

}  // namespace selvage
