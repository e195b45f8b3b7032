// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "common/mesh_io/mesh_file.h"
#include "common/net/messages.h"
#include "server/ingest/ingest.h"

namespace selvage {

/// What a publisher asks for, as ingest takes it. BadFile if the cut is by groups and the file has none.
Result<IngestOptions> ingest_options(const Publish& request, const MeshFile& file);

/// Equal for equal cuts and no others; empty for the usual one. Kept in packs, to know a repeated request by.
std::string to_text(const PublishCut& cut);

}  // namespace selvage
