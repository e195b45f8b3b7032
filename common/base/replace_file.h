// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

#include "common/base/result.h"

namespace selvage {

/// Puts `content` at `path` whole or not at all: into a temporary file beside it, to the disk, then renamed
/// over it. A full disk, or any other failure, leaves what was there and no temporary file behind. Errors do
/// not name the path.
Result<void> replace_file(const std::filesystem::path& path, std::string_view content);

}  // namespace selvage
