// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

#include "common/base/result.h"

namespace selvage {

/// Puts `content` at `path` whole or not at all: into a temporary file beside it, to the disk, then renamed
/// over it. A full disk, or any other failure, leaves what was there and no temporary file behind; so does,
/// on most file systems, the end of the process at any moment. Errors do not name the path.
Result<void> replace_file(const std::filesystem::path& path, std::string_view content);

enum class IfExists { Replace, Refuse };

/// The same with more care: `temporary` is where the file is written first, in the same file system and
/// nobody else's business; InvalidArgument if there is a file at `path` and that is to be refused, however
/// late it came; and when this returns the file's name is on the disk, too, and outlives a loss of power.
Result<void> place_file(const std::filesystem::path& path, std::string_view content,
                        const std::filesystem::path& temporary, IfExists if_exists);

/// Puts on the disk which files the folder holds.
Result<void> sync_folder(const std::filesystem::path& folder);

}  // namespace selvage
