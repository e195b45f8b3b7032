// SPDX-License-Identifier: MIT
#include "bench/codec/lossless.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <lzma.h>

#include "bench/codec/rivals.h"
#include "client/decode/region_decoder.h"
#include "server/encode/model_encoder.h"
#include "server/segment/segment.h"

namespace selvage::bench {
namespace {

/// By way of memory: g++ 12 loses the rounding of neighbouring values when it vectorises.
double as_float(double value) {
  volatile float rounded = static_cast<float>(value);
  return rounded;
}

std::vector<Vec3> float_positions(const RepairedMesh& mesh) {
  std::vector<Vec3> positions = mesh.positions;
  for (Vec3& p : positions) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = as_float(p[axis]);
  }
  return positions;
}

/// One position a vertex of the file, in its order.
std::vector<float> in_file_order(const RepairedMesh& mesh, const std::vector<Vec3>& positions) {
  std::vector<std::pair<VertexId, VertexId>> order;
  for (VertexId v = 0; v < positions.size(); ++v)
    order.emplace_back(mesh.source_of_vertex.empty() ? v : mesh.source_of_vertex[v], v);
  std::sort(order.begin(), order.end());
  std::vector<float> raw;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && order[i].first == order[i - 1].first) continue;
    for (int axis = 0; axis < 3; ++axis) raw.push_back(static_cast<float>(positions[order[i].second][axis]));
  }
  return raw;
}

std::size_t xz_size(std::span<const std::byte> bytes) {
  std::vector<std::uint8_t> out(lzma_stream_buffer_bound(bytes.size()));
  std::size_t size = 0;
  lzma_easy_buffer_encode(9, LZMA_CHECK_CRC32, nullptr, reinterpret_cast<const std::uint8_t*>(bytes.data()),
                          bytes.size(), out.data(), &size, out.size());
  return size;
}

void require_round_trip(const Model& model, const EncodedModel& encoded, const CodecTables& tables) {
  auto part = encoded.parts.begin();
  for (const RegionEntry& entry : encoded.directory.regions) {
    for (const LevelEntry& level : entry.levels) {
      const DecodeLimits limits{level.vertices, level.triangles, entry.box_min, entry.box_max,
                                encoded.directory.grid};
      if (const auto decoded = decode_region(*part++, limits, tables); !decoded) {
        std::fprintf(stderr, "%s: %s\n", model.name.c_str(), decoded.error().message.c_str());
        std::exit(1);
      }
    }
    if (entry.bundle_triangles > 0) ++part;
  }
}

}  // namespace

LosslessSizes lossless_sizes(const Model& model, const CodecTables& tables) {
  const RepairedMesh& mesh = model.mesh;
  const std::vector<Vec3> positions = float_positions(mesh);
  const Segmentation segmentation = segment(mesh.table, positions, {}, serial_for());
  const Partition partition =
      make_partition(mesh.table, segmentation.region_of_vertex, segmentation.region_count);
  const Grid grid = make_grid(positions, 14);
  const ModelSource source{mesh.table, positions, mesh.source_of_vertex, mesh.is_turned, partition, true};
  const EncodedModel encoded = encode_model(source, grid, serial_for(), [] {}, {tables}).value();
  require_round_trip(model, encoded, tables);
  LosslessSizes sizes;
  auto part = encoded.parts.begin();
  for (const RegionEntry& entry : encoded.directory.regions) {
    for (std::size_t i = 0; i < entry.levels.size(); ++i) sizes.ours += (part++)->size();
    if (entry.bundle_triangles > 0) ++part;
  }
  sizes.ours -= encoded.directory.connectivity_bytes;
  const std::vector<float> raw = in_file_order(mesh, positions);
  sizes.xz = xz_size(std::as_bytes(std::span(raw)));
  sizes.zstd = zstd_size(std::as_bytes(std::span(raw)));
  return sizes;
}

}  // namespace selvage::bench
