// SPDX-License-Identifier: MIT
//
// Where the tool's models come from: a pack on disk or a server. Either way parts are checked against their
// hashes, decoded on worker threads and stitched as they come.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

#include "client/session/client_session.h"
#include "client/stitch/stitcher.h"
#include "common/pack/pack.h"
#include "common/pack/selection.h"

namespace selvage {

struct FetchedModel {
  Directory directory;
  StitchedMesh mesh;
  std::size_t regions = 0;  ///< that were selected and are in `mesh`
  std::uint64_t directory_bytes = 0;
  std::uint64_t part_bytes = 0;
  std::uint32_t parts = 0;
  /// From before connecting, or opening the file, until ...
  std::chrono::duration<double> time_to_first_region{};  ///< ... a first region was decoded
  std::chrono::duration<double> time_to_mesh{};          ///< ... everything was decoded and stitched
};

struct FetchOptions {
  Selection selection;
  unsigned threads = 0;      ///< that decode; 0: all cores
  ClientOptions connection;  ///< to a server
};

/// Called on the calling thread with what has arrived so far.
using FetchProgress = std::function<void(std::uint32_t parts, std::uint32_t of_parts, std::uint64_t bytes)>;

/// Errors name the pack.
Result<FetchedModel> fetch_from_pack(const std::filesystem::path& pack, const FetchOptions& options);

/// `address` is HOST:PORT/MODEL. Errors name it.
Result<FetchedModel> fetch_from_server(const std::string& address, const FetchOptions& options,
                                       const FetchProgress& progress);

/// Whichever `source` is: a file that exists is a pack.
Result<FetchedModel> fetch(const std::string& source, const FetchOptions& options,
                           const FetchProgress& progress);

/// The directory alone, of either.
Result<Directory> fetch_directory(const std::string& source, const ClientOptions& connection);

/// The line that every written mesh carries where its format has comments.
std::string provenance(const Directory& directory);

}  // namespace selvage
