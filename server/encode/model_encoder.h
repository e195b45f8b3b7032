// SPDX-License-Identifier: MIT
//
// A partitioned model in, all parts of its pack out: regions in parallel, then the bundles between them.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "common/base/parallel.h"
#include "common/base/result.h"
#include "common/codec/codec_tables.h"
#include "common/coding/byte_io.h"
#include "common/coding/symbol_models.h"
#include "common/mesh/corner_table.h"
#include "common/mesh/grid.h"
#include "common/pack/directory.h"
#include "server/segment/partition.h"
#include "server/simplify/levels.h"

namespace selvage {

/// Borrowed for the call.
struct ModelSource {
  const CornerTable& table;         ///< oriented 2-manifold with boundary
  std::span<const Vec3> positions;  ///< by vertex
  std::span<const VertexId>
      source_of_vertex;                ///< vertices with the same source are welded again by the client
  const std::vector<bool>& is_turned;  ///< by triangle
  const Partition& partition;          ///< passes check_partition
  bool is_exact = false;               ///< keep positions bit for bit; all of them must be floats
  const LevelledMesh* levels =
      nullptr;  ///< of the same table and partition, on the grid; null: the finest only
};

/// The weld group of every vertex that shares its source with another, kNone for all others; empty if there
/// is none. These vertices must be pinned in all levels.
std::vector<std::uint32_t> find_weld_groups(const CornerTable& table,
                                            std::span<const VertexId> source_of_vertex);

struct EncodedModel {
  Directory directory;  ///< grid, counts and regions; part sizes and hashes still open, see assemble_pack
  std::vector<Bytes> parts;  ///< in assemble_pack's order
};

/// For training and benchmarks: other tables, and every part's symbols as they were coded. `on_symbols` may
/// be called from several threads at once.
struct EncodeHooks {
  const CodecTables& tables = shipped_tables();
  std::function<void(const PartId&, std::span<const Token>, double plain_bits)> on_symbols = nullptr;
};

/// Encodes a model with one choice of levels after another. What does not depend on them, the finest level
/// and the bundles, is encoded once.
class ModelEncoder {
 public:
  /// Borrows `grid` and what the others refer to; `source.levels` is not looked at.
  ModelEncoder(const ModelSource& source, const Grid& grid, const EncodeHooks& hooks);
  ~ModelEncoder();
  ModelEncoder(const ModelEncoder&) = delete;
  ModelEncoder& operator=(const ModelEncoder&) = delete;

  /// As encode_model, with `levels` or, if null, the finest only. `on_part_done` is also called for what was
  /// there already.
  Result<EncodedModel> encode(const LevelledMesh* levels, const ParallelFor& parallel,
                              const std::function<void()>& on_part_done);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// A level of a region that takes no less bytes than the one before is left out as its repeat.
/// `on_part_done` is called after each part, or what might have been one, possibly from several threads at
/// once. The result does not depend on `parallel`. LimitExceeded if it would hold what decoders refuse.
Result<EncodedModel> encode_model(const ModelSource& source, const Grid& grid, const ParallelFor& parallel,
                                  const std::function<void()>& on_part_done, const EncodeHooks& hooks = {});

}  // namespace selvage
