// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "server/app/segmentation_options.h"

namespace selvage {

/// `selvage-pack build`: a mesh file in, a pack out.
struct BuildCommand {
  std::filesystem::path pack;   ///< -o; empty: the model's stem with .selvage in the current folder ...
  std::filesystem::path store;  ///< --store; ... or in this folder
  std::string name, units;      ///< name empty: the model's stem
  std::map<std::string, std::string> metadata;
  int bits = 14;
  bool lossless = false;
  std::uint32_t levels = 2;          ///< of detail, the finest included ...
  std::vector<double> level_ratios;  ///< ... or, of those beside the finest, shares of the triangles ...
  std::vector<double> level_errors;  ///< ... or errors in model units
  unsigned threads = 0;
  bool json = false;
  SegmentationOptions segmentation;
};

/// Writes the pack and prints what it holds on stdout; notes about the input go to stderr.
Result<void> run(const BuildCommand& command);

}  // namespace selvage
