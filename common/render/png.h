// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "common/base/result.h"
#include "common/render/image.h"

namespace selvage {

/// The image as an 8-bit RGB PNG file. The same image gives the same bytes.
Result<std::vector<std::byte>> encode_png(const Image& image);

/// Writes it to `path`, replacing a file that is there.
Result<void> write_png(const std::filesystem::path& path, const Image& image);

}  // namespace selvage
