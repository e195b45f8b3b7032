// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "common/base/result.h"

namespace selvage {

/// `selvage-client verify`: checks every hash, decodes and stitches everything, and checks that the result is
/// a sound mesh of the size that the directory promises.
struct VerifyCommand {
  std::filesystem::path pack;
  bool json = false;
};

Result<void> run(const VerifyCommand& command);

}  // namespace selvage
