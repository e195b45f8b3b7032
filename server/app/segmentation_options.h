// SPDX-License-Identifier: MIT
#pragma once

#include "server/segment/segment.h"

namespace CLI {
class App;
}

namespace selvage {

/// The options that say how a model is cut, as `build` and `segment` share them.
void add_segmentation_options(CLI::App& command, SegmentOptions& options);

}  // namespace selvage
