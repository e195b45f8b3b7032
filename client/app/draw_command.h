// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "client/app/selection_options.h"
#include "client/app/source_options.h"
#include "common/render/camera.h"

namespace selvage {

/// `selvage-client draw`: regions in colours with their numbers, as a PNG.
struct DrawCommand {
  std::string source;  ///< HOST:PORT/MODEL, a URL, or a pack
  std::filesystem::path output;
  SelectionOptions selection;
  SourceOptions options;
  int steps = 0;  ///< > 0: the model as it arrives, in so many pictures (dissertation Fig. 5.6), instead of
                  ///< from four sides
  bool levels = false;  ///< every level, a mix of them and a seam in it, with the edges of triangles
  int size = 640;       ///< pixels of one picture's longer side
  UpAxis up = UpAxis::Y;
  bool labels = true;
};

Result<void> run(const DrawCommand& command);

}  // namespace selvage
