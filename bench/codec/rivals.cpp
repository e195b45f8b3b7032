// SPDX-License-Identifier: MIT
#include "bench/codec/rivals.h"

#include <cstdio>
#include <cstdlib>

#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>
#include <meshoptimizer.h>
#include <zstd.h>

namespace selvage::bench {
namespace {

[[noreturn]] void give_up(const char* what) {
  std::fprintf(stderr, "%s failed\n", what);
  std::exit(1);
}

}  // namespace

std::vector<char> draco_encode(const GridMesh& mesh, int level, int bits) {
  draco::Mesh input;
  input.set_num_points(static_cast<std::uint32_t>(mesh.positions.size()));
  draco::GeometryAttribute description;
  description.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  const int id = input.AddAttribute(description, true, static_cast<std::uint32_t>(mesh.positions.size()));
  draco::PointAttribute& positions = *input.attribute(id);
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const GridPoint& p = mesh.positions[v];
    const float value[3] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    positions.SetAttributeValue(draco::AttributeValueIndex(v), value);
  }
  for (const Triangle& t : mesh.triangles) {
    input.AddFace({draco::PointIndex(t[0]), draco::PointIndex(t[1]), draco::PointIndex(t[2])});
  }
  draco::ExpertEncoder encoder(input);
  encoder.SetSpeedOptions(10 - level, 10 - level);
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  const float origin[3] = {0, 0, 0};
  encoder.SetAttributeExplicitQuantization(id, bits, 3, origin, static_cast<float>((1 << bits) - 1));
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeToBuffer(&buffer).ok()) give_up("Draco's encoder");
  return {buffer.data(), buffer.data() + buffer.size()};
}

std::size_t draco_decode(const std::vector<char>& bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
  if (!mesh.ok()) give_up("Draco's decoder");
  return mesh.value()->num_faces();
}

std::size_t zstd_size(std::span<const std::byte> bytes) {
  std::vector<char> out(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 19);
  if (ZSTD_isError(size)) give_up("zstd");
  return size;
}

std::size_t meshoptimizer_size(const GridMesh& mesh) {
  const std::size_t vertices = mesh.positions.size(), indices = 3 * mesh.triangles.size();
  std::vector<unsigned> order(indices);
  meshopt_optimizeVertexCacheStrip(order.data(), mesh.triangles.front().data(), indices, vertices);
  struct Packed {
    std::uint16_t x, y, z, unused;
  };
  std::vector<Packed> packed(vertices), fetched(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const GridPoint& p = mesh.positions[v];
    packed[v] = {static_cast<std::uint16_t>(p.x), static_cast<std::uint16_t>(p.y),
                 static_cast<std::uint16_t>(p.z), 0};
  }
  meshopt_optimizeVertexFetch(fetched.data(), order.data(), indices, packed.data(), vertices, sizeof(Packed));
  std::vector<unsigned char> index_bytes(meshopt_encodeIndexBufferBound(indices, vertices));
  index_bytes.resize(
      meshopt_encodeIndexBuffer(index_bytes.data(), index_bytes.size(), order.data(), indices));
  std::vector<unsigned char> vertex_bytes(meshopt_encodeVertexBufferBound(vertices, sizeof(Packed)));
  vertex_bytes.resize(meshopt_encodeVertexBuffer(vertex_bytes.data(), vertex_bytes.size(), fetched.data(),
                                                 vertices, sizeof(Packed)));
  return zstd_size(std::as_bytes(std::span(index_bytes))) + zstd_size(std::as_bytes(std::span(vertex_bytes)));
}

}  // namespace selvage::bench
