// SPDX-License-Identifier: MIT
//
// From a triangle soup to a pack: the page to read first. Each line of ingest() is a stage that takes only
// what the lines above returned; progress and timing are taken here, the stages know nothing of either.
#pragma once

#include <chrono>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/base/parallel.h"
#include "common/coding/byte_io.h"
#include "common/mesh/triangle_soup.h"
#include "server/ingest/parts.h"
#include "server/ingest/repair.h"
#include "server/segment/segment.h"

namespace selvage {

/// What ends a level of detail: so few triangles, or no collapse that keeps the error.
struct LevelGoal {
  double ratio = 0;                                        ///< of the model's triangles
  double error = std::numeric_limits<double>::infinity();  ///< of the collapses, model units
  /// Over the bytes of the finest level and the joins: a level that takes more gets fewer triangles.
  double most_bytes = std::numeric_limits<double>::infinity();
};

/// The goals that make `count` levels of detail, the finest included: at an eighth of the triangles for two,
/// a quarter and a sixteenth for three, each at half of the one before for more. The second of two takes at
/// most a quarter of the bytes, give or take the directory's.
std::vector<LevelGoal> usual_levels(unsigned count);
/// One goal a share of the triangles, or an error in model units; where neither is given, the usual ones.
std::vector<LevelGoal> level_goals(unsigned count, std::span<const double> ratios,
                                   std::span<const double> errors);

struct IngestOptions {
  std::string name;                             ///< of the model, for people
  std::string units;                            ///< "mm", "m" ...; empty if unknown
  std::map<std::string, std::string> metadata;  ///< travels in the directory as it is
  int bits = 14;                                ///< grid bits along the longest side, 8..24
  Parts parts;             ///< the user's own, which then make the regions; none: the shape does
  SegmentOptions segment;  ///< large models get streaming sizes, see with_streaming_sizes
  bool lossless = false;   ///< keep float32 positions bit for bit besides the grid
  std::vector<LevelGoal> levels = usual_levels(2);  ///< beside the finest, each coarser than the one before
};

struct StageTime {
  std::string stage;
  std::chrono::duration<double> seconds;
};

struct IngestedModel {
  Bytes pack;
  RepairReport repair;
  std::vector<StageTime> times;
  std::uint32_t regions = 0;
  std::uint32_t names = 0;  ///< of parts
  std::uint32_t loose_vertices = 0;
};

/// Called now and then with a stage's name and how much of it is done, 0..1; returns false to cancel. Calls
/// come one at a time, possibly from several threads.
using Progress = std::function<bool(const std::string& stage, double done)>;

/// Deterministic: the same soup and options give the same bytes, whatever `parallel` is. Fails with BadFile
/// if no triangle is left after repair, InvalidArgument for options out of range, LimitExceeded if the pack
/// would hold what readers refuse (docs/FORMAT.md, "Limits"), Cancelled if `progress` says so.
Result<IngestedModel> ingest(const TriangleSoup& soup, const IngestOptions& options,
                             const ParallelFor& parallel, const Progress& progress);

}  // namespace selvage
