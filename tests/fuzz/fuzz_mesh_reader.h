// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "common/base/result.h"
#include "common/mesh_io/mesh_file.h"

namespace selvage {

/// A reader may refuse anything; what it accepts keeps the promises of TriangleSoup, and what it refuses has
/// a message.
inline int fuzz_mesh_reader(Result<MeshFile> (*parse)(std::span<const std::byte>), const std::uint8_t* data,
                            std::size_t size) {
  const Result<MeshFile> file = parse(std::as_bytes(std::span(data, size)));
  if (!file) return file.error().message.empty() ? std::abort(), 0 : 0;
  for (const Vec3& p : file->soup.positions)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) std::abort();
  for (const Triangle& triangle : file->soup.triangles)
    for (std::uint32_t v : triangle)
      if (v >= file->soup.positions.size()) std::abort();
  if (file->soup.triangles.empty()) std::abort();
  return 0;
}

}  // namespace selvage
