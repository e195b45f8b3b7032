// SPDX-License-Identifier: MIT
//
// The Princeton Segmentation Benchmark on disk: DIR/off/N.off and DIR/seg/N/N_K.seg, one segment number a
// line and triangle. Any subset of the models will do.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/segment/scores.h"
#include "common/base/result.h"
#include "common/mesh/corner_table.h"

namespace selvage::bench {

struct PsbModel {
  int id = 0;
  std::string category;
  CornerTable mesh;
  std::vector<Vec3> positions;
  std::vector<Labels> humans;
};

/// The ids of the models in the folder, ascending.
std::vector<int> list_psb(const std::filesystem::path& folder);
Result<PsbModel> read_psb(const std::filesystem::path& folder, int id);

}  // namespace selvage::bench
