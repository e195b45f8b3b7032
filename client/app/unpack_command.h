// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "client/app/selection_options.h"
#include "client/stitch/stitcher.h"
#include "common/pack/pack.h"

namespace selvage {

/// `selvage-client unpack`: what `get` does, straight from a pack.
struct UnpackCommand {
  std::filesystem::path pack;
  std::filesystem::path output;
  SelectionOptions selection;
  unsigned threads = 0;
};

Result<void> run(const UnpackCommand& command);

/// Checks, decodes and stitches what is selected, on `threads` threads (0: all cores).
Result<StitchedMesh> decode_pack(const Pack& pack, const Selection& selection, unsigned threads);

/// The line that every written mesh carries where its format has comments.
std::string provenance(const Directory& directory);

}  // namespace selvage
