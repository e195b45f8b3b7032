// SPDX-License-Identifier: MIT
//
// A repaired mesh in, regions out: by shape (server/segment/segment.h) or by the user's own parts (parts.h).
// What `build` encodes and what `segment --streaming` writes is the same.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/base/parallel.h"
#include "server/ingest/parts.h"
#include "server/ingest/repair.h"
#include "server/segment/segment.h"
#include "server/segment/segmentation.h"

namespace selvage {

struct NamedSegmentation {
  Segmentation regions;
  std::map<std::string, std::vector<RegionId>> regions_of_name;  ///< ascending; empty by shape
};

/// `mesh` is cut along the parts if they are by triangle. Of the options, parts heed max_region_vertices
/// only.
NamedSegmentation segment_model(const RepairedMesh& mesh, const Parts& parts, const SegmentOptions& options,
                                const ParallelFor& parallel);

/// A region for each of the file's `count` triangles. A boundary triangle takes the region that two of its
/// corners share (triangle_labels.h). Of a triangle that repair dropped, and of one with loose corners only,
/// it is the region of the triangle before it in the file, or at the front the one after: files state
/// neighbours together.
std::vector<RegionId> regions_of_source_triangles(const RepairedMesh& mesh, const Segmentation& segmentation,
                                                  std::size_t count);

}  // namespace selvage
