// SPDX-License-Identifier: MIT
//
// fetch_regions HOST:PORT/MODEL REGIONS: says what arrives, as a viewer would draw it.
#include <cstdio>

#include <selvage/client/fetch/model.h>

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: fetch_regions HOST:PORT/MODEL 1,3-5\n"), 2;
  auto selection = selvage::parse_region_list(argv[2]);
  auto model = selvage::Model::open(argv[1]);
  if (!model || !selection) {
    const auto& error = model ? selection.error() : model.error();
    return std::fprintf(stderr, "%s\n", error.to_string().c_str()), 1;
  }
  selvage::FetchEvents events;
  events.on_region = [](const selvage::ArrivedRegion& arrived) {
    std::printf("region %u: %u triangles\n", arrived.region, arrived.triangles);
  };
  events.on_update = [](const selvage::StitchUpdate& changes) {
    std::printf("stitched: %zu vertices and %zu patches changed\n", changes.vertices.size(),
                changes.patches.size());
  };
  auto fetch = model->fetch(*selection, events);
  fetch.reprioritise(0);  // say, because the regions came into view
  const auto fetched = fetch.wait();
  if (!fetched) return std::fprintf(stderr, "%s\n", fetched.error().to_string().c_str()), 1;
  std::printf("done: %u regions, %zu triangles\n", fetched->regions, fetched->mesh.soup.triangles.size());
}
