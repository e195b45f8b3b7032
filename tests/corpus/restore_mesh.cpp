// SPDX-License-Identifier: MIT
#include "tests/corpus/restore_mesh.h"

#include <algorithm>
#include <chrono>
#include <random>
#include <set>

#include <fmt/format.h>

#include "client/decode/bundle_decoder.h"
#include "client/session/blocking_client.h"
#include "client/stitch/part_collector.h"
#include "common/mesh/same_mesh.h"
#include "common/mesh_io/read_mesh.h"
#include "common/pack/pack.h"
#include "server/ingest/ingest.h"
#include "tests/support/test_server.h"

namespace selvage {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kModel = "model";

/// One client that fetches and checks; holds what arrived so far.
class Fetcher {
 public:
  Fetcher(BlockingClient& client, std::shared_ptr<const Manifest> manifest)
      : client_(client), manifest_(std::move(manifest)) {}

  /// Fetches what the selection needs and is not here yet.
  Result<void> fetch(const Selection& selection) {
    GetRequest request{manifest_, selection, {}};
    for (const auto& [hash, bytes] : held_) request.have.push_back(hash);
    auto stats = client_.get(request, [&](ReceivedPart part) -> Result<void> {
      held_[directory().find(part.id)->hash] = std::move(part.bytes);
      return {};
    });
    if (!stats) return forward_error(stats);
    return {};
  }

  /// Stitches the parts of a selection in random order.
  Result<StitchedMesh> stitch(const Selection& selection, std::mt19937& random) const {
    auto parts = select_parts(directory(), selection);
    if (!parts) return forward_error(parts);
    std::shuffle(parts->begin(), parts->end(), random);
    PartCollector collector(directory());
    for (const PartId& id : *parts) {
      const auto held = held_.find(directory().find(id)->hash);
      if (held == held_.end()) return fail(ErrorCode::BadStream, "a part that was asked for did not come");
      if (auto ok = collector.add(id, held->second); !ok) return forward_error(ok);
    }
    return collector.mesh();
  }

  const Directory& directory() const { return manifest_->directory; }

 private:
  BlockingClient& client_;
  std::shared_ptr<const Manifest> manifest_;
  std::map<Hash, std::vector<std::byte>> held_;  ///< two parts of equal bytes have one hash and come once
};

/// The triangles that lie within a set of regions, loose vertices included, counted straight from the pack.
std::size_t count_between(const Pack& pack, const std::set<RegionId>& regions) {
  const Directory& directory = pack.directory();
  std::size_t count = 0;
  for (RegionId id : regions) {
    const RegionEntry& entry = directory.regions[id];
    count += entry.levels[0].triangles;
    if (entry.bundle.size == 0) continue;
    std::vector<BundleTopology::Region> topology;
    for (RegionId below : entry.lower_neighbours)
      topology.push_back({below, directory.regions[below].loop_lengths});
    topology.push_back({id, entry.loop_lengths});
    const auto triangles =
        decode_bundle(pack.part(entry.bundle), BundleTopology(std::move(topology)), entry.bundle_triangles)
            .value();
    count += static_cast<std::size_t>(
        std::count_if(triangles.begin(), triangles.end(), [&](const BoundaryTriangle& t) {
          return std::all_of(t.corners.begin(), t.corners.end(), [&](const BoundaryRef& corner) {
            return corner.region == kLooseRegion || regions.contains(corner.region);
          });
        }));
  }
  return count;
}

Selection random_subset(const Directory& directory, std::mt19937& random) {
  Selection selection{.kind = Selection::Kind::Ids};
  const unsigned percent = 10 + random() % 80;
  for (RegionId id = 1; id <= directory.real_region_count(); ++id) {
    if (random() % 100 < percent) selection.ids.push_back(id);
  }
  if (selection.ids.empty())
    selection.ids.push_back(1 + static_cast<RegionId>(random() % directory.real_region_count()));
  return selection;
}

/// What levels of detail must not make worse.
struct EdgeFaults {
  std::size_t borders = 0;  ///< edges with an odd number of triangles
  std::size_t repeats = 0;  ///< more than one triangle walking an edge in one direction, counted each
};
EdgeFaults faults_of(const std::vector<Triangle>& triangles) {
  std::vector<std::pair<VertexId, VertexId>> walked, edges;
  for (const Triangle& t : triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      walked.emplace_back(t[k], t[(k + 1) % 3]);
      edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
    }
  }
  EdgeFaults faults;
  std::sort(walked.begin(), walked.end());
  for (std::size_t i = 1; i < walked.size(); ++i) faults.repeats += walked[i] == walked[i - 1];
  std::sort(edges.begin(), edges.end());
  for (auto at = edges.begin(); at != edges.end();) {
    const auto end = std::upper_bound(at, edges.end(), *at);
    faults.borders += (end - at) % 2;
    at = end;
  }
  return faults;
}

/// Every region at a level drawn for it. Replacing vertices maps cycles to cycles, so a mix has no more
/// border than the file, and none if the file is closed, however little of a manifold that is.
std::string check_mix(Fetcher& fetcher, const TriangleSoup& soup, std::mt19937& random) {
  const Directory& directory = fetcher.directory();
  Selection mix;
  for (RegionId id = 1; id <= directory.real_region_count(); ++id)
    mix.levels.push_back({id, static_cast<std::uint8_t>(random() % directory.level_count())});
  mix.kind = Selection::Kind::Ids;
  for (RegionId id = 1; id <= directory.real_region_count(); ++id) mix.ids.push_back(id);
  mix.joins = Joins::All;
  if (auto ok = fetcher.fetch(mix); !ok) return ok.error().to_string();
  const auto mesh = fetcher.stitch(mix, random);
  if (!mesh) return mesh.error().to_string();
  for (const Triangle& t : mesh->soup.triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return "a mix of levels has a triangle that is a line";
  }
  const EdgeFaults before = faults_of(soup.triangles), after = faults_of(mesh->soup.triangles);
  if (after.borders > before.borders) {
    return fmt::format("a mix of levels has {} border edges, the file {}", after.borders, before.borders);
  }
  const bool is_manifold = before.repeats == 0 && directory.source.cut_vertices == 0;
  if (is_manifold && after.repeats > 0)
    return fmt::format("a mix of levels walks {} edges twice in one direction", after.repeats);
  return {};
}

/// Empty if all is as it must be.
std::string check_fetches(Fetcher& fetcher, const Pack& pack, const TriangleSoup& soup,
                          std::mt19937& random) {
  const Directory& directory = fetcher.directory();
  for (int round = 0; round < 3 && directory.real_region_count() > 0; ++round) {
    const Selection subset = random_subset(directory, random);
    if (auto ok = fetcher.fetch(subset); !ok) return ok.error().to_string();
    const auto mesh = fetcher.stitch(subset, random);
    if (!mesh) return mesh.error().to_string();
    const std::size_t expected = count_between(pack, {subset.ids.begin(), subset.ids.end()});
    if (mesh->soup.triangles.size() != expected) {
      return fmt::format("{} regions gave {} triangles instead of {}", subset.ids.size(),
                         mesh->soup.triangles.size(), expected);
    }
  }
  if (auto ok = fetcher.fetch({}); !ok) return ok.error().to_string();
  const auto whole = fetcher.stitch({}, random);
  if (!whole) return whole.error().to_string();
  std::string difference = compare_meshes(soup, whole->soup, directory.grid.step / 2).difference;
  for (int round = 0; round < 4 && difference.empty() && directory.real_region_count() > 0; ++round)
    difference = check_mix(fetcher, soup, random);
  return difference;
}

}  // namespace

Result<Restoration> restore_mesh(const std::filesystem::path& path, std::uint32_t seed) {
  auto file = read_mesh(path);
  if (!file) return forward_error(file);
  const auto begin = Clock::now();
  IngestOptions options;
  options.name = kModel;
  options.levels = usual_levels(3);
  auto model = ingest(file->soup, options, threaded_for(0), [](const std::string&, double) { return true; });
  if (!model) return forward_error(model, path.string());
  Restoration result;
  result.pack_seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  result.pack_bytes = model->pack.size();
  result.regions = model->regions;

  TestServer server;
  server.folder().put(std::string(kModel) + ".selvage", model->pack);
  const auto fetch_begin = Clock::now();
  auto client = BlockingClient::connect(server.address());
  if (!client) return forward_error(client, "connect");
  auto manifest = client->open(kModel);
  if (!manifest) return forward_error(manifest, "open");
  result.vertices = (*manifest)->directory.vertices;
  result.triangles = (*manifest)->directory.triangles;
  const auto pack = Pack::from_bytes(std::move(model->pack)).value();
  Fetcher fetcher(*client, std::move(*manifest));
  std::mt19937 random(seed);
  result.failure = check_fetches(fetcher, *pack, file->soup, random);
  result.fetch_seconds = std::chrono::duration<double>(Clock::now() - fetch_begin).count();
  return result;
}

}  // namespace selvage
