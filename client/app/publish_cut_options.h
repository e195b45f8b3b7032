// SPDX-License-Identifier: MIT
#pragma once

#include "common/net/publish_cut.h"

namespace CLI {
class App;
}

namespace selvage {

/// The options of `publish` that say how the server is to cut the mesh, called as those of `selvage-pack
/// build`. `cut` must outlive the command.
void add_publish_cut_options(CLI::App& command, PublishCut& cut);

}  // namespace selvage
