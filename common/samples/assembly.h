// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "common/mesh/triangle_soup.h"

namespace selvage {

/// The bracket with a bolt, a washer and a nut at each of its six holes: 19 closed components, genus 19 in
/// all.
TriangleSoup make_assembly(std::uint32_t about_triangles);

}  // namespace selvage
