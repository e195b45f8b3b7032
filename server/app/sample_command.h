// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "common/base/result.h"

namespace selvage {

/// `selvage-pack sample`: writes a model that the project generates itself, to try things with.
struct SampleCommand {
  std::string name;              ///< empty: list what there is
  std::filesystem::path output;  ///< empty: NAME.ply in the current folder
  std::uint32_t triangles = 0;   ///< about so many; 0: the sample's own default
};

Result<void> run(const SampleCommand& command);

}  // namespace selvage
