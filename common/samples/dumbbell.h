// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "common/mesh/triangle_soup.h"

namespace selvage {

/// Two balls and a bar: the least that has three regions. Closed, genus 0, the bar along x.
TriangleSoup make_dumbbell(std::uint32_t about_triangles);

}  // namespace selvage
