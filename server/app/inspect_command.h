// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "common/base/result.h"

namespace selvage {

/// `selvage-pack inspect`: what a pack holds and where its bytes go, without decoding it.
struct InspectCommand {
  std::filesystem::path pack;
  bool json = false;
};

Result<void> run(const InspectCommand& command);

}  // namespace selvage
