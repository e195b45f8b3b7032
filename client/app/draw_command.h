// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "client/app/selection_options.h"
#include "client/app/server_options.h"
#include "common/render/camera.h"

namespace selvage {

/// `selvage-client draw`: regions in colours with their numbers, as a PNG.
struct DrawCommand {
  std::string source;  ///< HOST:PORT/MODEL or a pack
  std::filesystem::path output;
  SelectionOptions selection;
  int steps = 0;   ///< > 0: the model as it arrives, in so many pictures (dissertation Fig. 5.6), instead of
                   ///< from four sides
  int size = 640;  ///< pixels of one picture's longer side
  UpAxis up = UpAxis::Y;
  bool labels = true;
  ServerOptions connection;
};

Result<void> run(const DrawCommand& command);

}  // namespace selvage
