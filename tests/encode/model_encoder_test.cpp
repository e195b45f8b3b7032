// SPDX-License-Identifier: MIT
#include "server/encode/model_encoder.h"

#include <gtest/gtest.h>

#include "common/pack/pack.h"
#include "tests/support/levelled_model.h"
#include "tests/support/shapes.h"

namespace selvage {
namespace {

LevelledModel two_halves(std::vector<double> ratios) {
  RepairedMesh mesh = repair(shapes::torus(24, 30)).value();
  std::vector<std::uint32_t> labels;
  for (const Vec3& p : mesh.positions) labels.push_back(p.x < 0);
  return levelled_model("torus", std::move(mesh), labels, ratios);
}

Bytes pack_of(EncodedModel encoded) { return assemble_pack(std::move(encoded.directory), encoded.parts); }

TEST(ModelEncoder, EncodesAnotherChoiceOfLevelsAsOneThatIsNew) {
  const LevelledModel fine = two_halves({0.5, 0.3}), coarse = two_halves({0.2});
  const RepairedMesh& mesh = fine.mesh;
  const Grid grid = make_grid(mesh.positions, 12);
  ModelSource source{mesh.table, mesh.positions, mesh.source_of_vertex, mesh.is_turned, fine.partition};
  const auto ignore = [] {};
  ModelEncoder encoder(source, grid, {});
  for (const LevelledMesh* levels :
       {&fine.levels, &coarse.levels, static_cast<const LevelledMesh*>(nullptr)}) {
    std::uint32_t done = 0;
    auto again = encoder.encode(levels, serial_for(), [&] { ++done; });
    ASSERT_TRUE(again);
    source.levels = levels;
    EXPECT_EQ(pack_of(std::move(*again)), pack_of(encode_model(source, grid, serial_for(), ignore).value()));
    const auto coarser = levels != nullptr ? levels->regions.size() - 1 : 0;
    EXPECT_EQ(done, 2 * (fine.region_count() + 1) + coarser * fine.region_count());
  }
}

}  // namespace
}  // namespace selvage
