// SPDX-License-Identifier: MIT
#include "client/fetch/decoding.h"

#include <atomic>
#include <mutex>
#include <semaphore>
#include <thread>

#include <gtest/gtest.h>

#include "common/mesh/same_mesh.h"
#include "common/pack/pack.h"
#include "common/pack/selection.h"
#include "tests/support/labelled_pack.h"
#include "tests/support/shapes.h"
#include "tests/support/unpack.h"

namespace selvage {
namespace {

/// All parts of a torus in regions.
struct Torus {
  explicit Torus(TriangleSoup mesh = shapes::torus(60, 40)) : soup(std::move(mesh)) {}

  TriangleSoup soup;
  std::shared_ptr<const Pack> pack =
      Pack::from_bytes(labelled_pack(soup, cube_labels(soup, 0.7), 14)).value();
  const Directory& directory = pack->directory();
  std::vector<PartId> ids = select_parts(directory, {}).value();
  PartCollector collector{directory};

  ReceivedPart part(const PartId& id) const {
    const auto bytes = pack->part(*directory.find(id));
    return {id, {bytes.begin(), bytes.end()}, {}};
  }
};

TEST(Decoding, IsTheSameOnAnyNumberOfThreads) {
  for (const unsigned threads : {0u, 1u, 2u}) {
    Torus torus;
    std::atomic<std::size_t> decoded = 0;
    Decoding decoding(torus.collector, threads, [&](const PartId&) { ++decoded; });
    for (const PartId& id : torus.ids) ASSERT_TRUE(decoding.add(torus.part(id)));
    ASSERT_TRUE(decoding.finish());
    EXPECT_EQ(decoded, torus.ids.size());
    EXPECT_TRUE(compare_meshes(torus.collector.mesh().soup, unpack(*torus.pack)->soup, 0).same);
  }
}

/// While the workers are stuck: what does not fit in the queue is decoded by who brings it.
TEST(Decoding, KeepsALimitToWhatWaits) {
  Torus torus(shapes::torus(300, 200));
  std::binary_semaphore may_go_on(0);
  const auto bringer = std::this_thread::get_id();
  std::atomic<int> by_bringer = 0;
  std::atomic<bool> is_stuck = false;
  Decoding decoding(torus.collector, 2, [&](const PartId&) {
    if (std::this_thread::get_id() == bringer) {
      ++by_bringer;
    } else if (!is_stuck.exchange(true)) {
      may_go_on.acquire();
    }
  });
  std::uint64_t waiting = 0, most = 0, brought = 0;
  std::mutex mutex;
  while (brought < (6u << 20)) {
    for (const PartId& id : torus.ids) {
      if (id.kind != PartKind::Region) continue;
      ReceivedPart part = torus.part(id);
      const std::uint64_t bytes = part.bytes.size();
      const auto consumed = std::make_shared<ConsumedBytes>([&, bytes] {
        const std::scoped_lock lock(mutex);
        waiting -= bytes;
      });
      part.receipt = Receipt(consumed, bytes);
      {
        const std::scoped_lock lock(mutex);
        waiting += bytes;
        most = std::max(most, waiting);
      }
      brought += bytes;
      ASSERT_TRUE(decoding.add(std::move(part)));
    }
  }
  EXPECT_LT(most, 5u << 20);
  EXPECT_GT(by_bringer, 0);
  may_go_on.release();
  EXPECT_TRUE(decoding.finish());
  EXPECT_EQ(waiting, 0u);
}

TEST(Decoding, KeepsTheFirstFailureAndTakesNoMore) {
  Torus torus;
  Decoding decoding(torus.collector, 1, [](const PartId&) { FAIL() << "nothing here decodes"; });
  ReceivedPart torn = torus.part(torus.ids[0]);
  torn.bytes.resize(3);
  EXPECT_TRUE(decoding.add(std::move(torn)));
  const auto more = decoding.add(torus.part(torus.ids[1]));
  ASSERT_FALSE(more);
  EXPECT_EQ(more.error().code, ErrorCode::BadStream);
  EXPECT_EQ(decoding.finish().error().message, more.error().message);
}

TEST(Decoding, DropsWhatIsNotNeededAnyMore) {
  Torus torus;
  Decoding decoding(torus.collector, 1, [](const PartId&) { FAIL() << "dropped before"; });
  decoding.drop_the_rest();
  EXPECT_TRUE(decoding.add(torus.part(torus.ids[0])));
  EXPECT_TRUE(decoding.finish());
}

}  // namespace
}  // namespace selvage
