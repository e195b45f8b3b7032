// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "common/mesh/triangle_soup.h"

namespace selvage {

/// A watering vessel with foot, body, neck, lip, spout and handle: smooth parts that meet in concave creases,
/// as the "Waterneck" that the dissertation segments (Ch. 4.3). Closed, genus 1 through the handle, y is up.
TriangleSoup make_waterneck(std::uint32_t about_triangles);

}  // namespace selvage
