// SPDX-License-Identifier: MIT
#include "bench/serve/first_regions.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include <sys/socket.h>
#include <unistd.h>

#include "bench/serve/closed_loop.h"
#include "client/fetch/model.h"

namespace selvage::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double squared_distance(const RegionEntry& a, const RegionEntry& b) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double apart =
        0.5 * (double(a.box_min[axis]) + a.box_max[axis] - b.box_min[axis] - b.box_max[axis]);
    sum += apart * apart;
  }
  return sum;
}

FetchedModel fetched(Result<Model>& model, const std::string& source, const std::vector<RegionId>& regions) {
  if (!model) throw std::runtime_error(source + ": " + model.error().message);
  Selection selection;
  selection.kind = Selection::Kind::Ids;
  selection.ids = regions;
  Fetch fetch = model->fetch(selection);
  auto result = fetch.wait();
  if (!result) throw std::runtime_error(source + ": " + result.error().message);
  if (result->regions != regions.size()) throw std::runtime_error(source + ": regions are missing");
  return std::move(*result);
}

}  // namespace

double fetch_seconds(const std::string& source, const std::vector<RegionId>& regions) {
  const auto start = Clock::now();
  auto model = Model::at(source);  // knows what it wants: hello, open and get in one flight
  (void)fetched(model, source, regions);
  return seconds_since(start);
}

RegionId random_region(const Directory& directory, std::mt19937& random) {
  return 1 + static_cast<RegionId>(random() % directory.real_region_count());
}

std::vector<RegionId> random_patch(const std::string& pack, const Directory& directory, double share,
                                   std::mt19937& random) {
  const RegionEntry& centre = directory.regions[random_region(directory, random)];
  std::vector<RegionId> ids;
  for (RegionId id = 1; id < directory.regions.size(); ++id) ids.push_back(id);
  std::ranges::sort(ids, {}, [&](RegionId id) { return squared_distance(directory.regions[id], centre); });
  const double wanted = share * static_cast<double>(directory.triangles);
  auto model = Model::open(pack);
  const auto first = [&](std::size_t count) {
    std::vector<RegionId> patch(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(count));
    std::ranges::sort(patch);
    return patch;
  };
  const auto excess = [&](std::size_t count) {
    return static_cast<double>(fetched(model, pack, first(count)).mesh.soup.triangles.size()) - wanted;
  };
  std::size_t least = 1, most = ids.size();  // the first with enough
  while (least < most) {
    const std::size_t middle = (least + most) / 2;
    (excess(middle) < 0 ? least = middle + 1 : most = middle);
  }
  const bool less_is_nearer = least > 1 && -excess(least - 1) < excess(least);
  return first(less_is_nearer ? least - 1 : least);
}

double download_seconds(const HostPort& server, const std::string& file) {
  const auto start = Clock::now();
  const int socket = connect_to(server.port, server.host);
  const std::string request = "GET /" + file + " HTTP/1.0\r\nHost: bench\r\n\r\n";
  if (::send(socket, request.data(), request.size(), MSG_NOSIGNAL) < 0)
    throw std::runtime_error("no request");
  std::vector<char> buffer(256 << 10);
  std::string head;
  for (ssize_t got; (got = ::recv(socket, buffer.data(), buffer.size(), 0)) > 0;) {
    if (head.size() < 20) head.append(buffer.data(), static_cast<std::size_t>(got));
  }
  ::close(socket);
  if (head.find(" 200 ") == std::string::npos) throw std::runtime_error("nginx says " + head.substr(0, 60));
  return seconds_since(start);
}

}  // namespace selvage::bench
