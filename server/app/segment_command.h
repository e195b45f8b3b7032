// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "common/base/result.h"
#include "common/render/camera.h"
#include "server/app/segmentation_options.h"

namespace selvage {

enum class SegmentFormat { Seg, Ply, Json };

/// `selvage-pack segment`: a mesh file in, a region for each of its triangles out, as file or picture.
struct SegmentCommand {
  SegmentationOptions segmentation;
  std::filesystem::path output;         ///< may be empty if anything else is wanted
  std::optional<SegmentFormat> format;  ///< by the output's extension otherwise
  std::filesystem::path png;
  UpAxis up = UpAxis::Y;
  int size = 640;          ///< pixels of one picture's width
  bool streaming = false;  ///< the sizes that `build` gives to large models
  bool hierarchy = false;  ///< print all merges with their saliency
  unsigned threads = 0;
  bool json = false;
};

/// Notes about the input go to stderr, counts to stdout.
Result<void> run(const SegmentCommand& command);

}  // namespace selvage
