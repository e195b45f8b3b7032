// SPDX-License-Identifier: MIT
//
// Models that the project makes itself, for its demo, tests and benchmarks: free of anybody's licence, there
// without a download, and in any resolution.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "common/mesh/triangle_soup.h"

namespace selvage {

/// In the order to show them in: waterneck, bracket, assembly, dumbbell.
std::vector<std::string> sample_names();

/// One sentence on what a sample is; empty for an unknown name.
std::string_view describe_sample(std::string_view name);

/// Makes a sample: closed, oriented outwards, manifold, y up. `about_triangles` is met to within a tenth or
/// so by the smooth models and more loosely by the others; 0 is the sample's own default. The same on every
/// run. Fails with NotFound for an unknown name, and with InvalidArgument beyond 1,000 to 4,000,000
/// triangles.
Result<TriangleSoup> make_sample(std::string_view name, std::uint32_t about_triangles = 0);

}  // namespace selvage
