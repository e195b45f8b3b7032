// SPDX-License-Identifier: MIT
//
// From an uploaded file to a model of the store, as one straight path: check, read, ingest, write, move into
// place. The publisher gets the errors that selvage-pack would give.
#pragma once

#include <filesystem>

#include "common/base/parallel.h"
#include "common/net/messages.h"
#include "common/pack/pack.h"
#include "server/ingest/ingest.h"

namespace selvage {

struct PublishPaths {
  std::filesystem::path upload;     ///< the whole file; its extension is the format
  std::filesystem::path temporary;  ///< for the new pack; in the same file system as the target
  std::filesystem::path target;     ///< in the store
};

/// BadStream if the upload is not what was announced; what read_mesh and ingest() say of bad meshes, with the
/// publisher's name for the file; InvalidArgument if the name is in use by now; Cancelled. Whatever happens,
/// `target` is the old pack or the whole new one, which is on the disk before this returns.
Result<Published> publish_mesh(const Publish& request, const PublishPaths& paths, const ParallelFor& parallel,
                               const Progress& progress);

/// Whether the pack came from this very request, some time ago.
bool is_result_of(const Directory& directory, const Publish& request);

Published describe(const Publish& request, const Pack& pack);

Error name_in_use(const std::string& name);

}  // namespace selvage
