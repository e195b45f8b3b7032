// SPDX-License-Identifier: MIT
//
// The selvage user's wait against the wait for a whole file: the client library fetches one region, or a
// tenth of a model, over the same link that a web server sends Draco's file over.
#pragma once

#include <random>
#include <string>

#include "common/net/tcp_stream.h"
#include "common/pack/directory.h"

namespace selvage::bench {

/// Seconds from nothing, not even a connection, until the regions and what joins them are one mesh.
double fetch_seconds(const std::string& source, const std::vector<RegionId>& regions);

/// A region, any with the same chance.
RegionId random_region(const Directory& directory, std::mt19937& random);
/// A random region and those around it, nearest first: so many that, stitched, they are as near as can be to
/// `share` of the model's triangles. `pack` is the model's file.
std::vector<RegionId> random_patch(const std::string& pack, const Directory& directory, double share,
                                   std::mt19937& random);

/// Seconds from nothing until a web server has sent all of a file.
double download_seconds(const HostPort& server, const std::string& file);

}  // namespace selvage::bench
