// SPDX-License-Identifier: MIT
#include "common/render/labels.h"

#include <algorithm>
#include <map>

namespace selvage {
namespace {

/// Distance in thirds of a sample to the nearest sample of another region, by the two sweeps of the 3-4
/// chamfer transform [Borgefors 1986]. Samples outside the picture count as another region.
class DistanceToBorder {
 public:
  DistanceToBorder(std::span<const RegionId> region, int width, int height)
      : region_(region), width_(width), height_(height), thirds_(region.size(), 1 << 28) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) relax(x, y, -1);
    for (int y = height; y-- > 0;)
      for (int x = width; x-- > 0;) relax(x, y, 1);
  }

  int thirds_at(int x, int y) const { return thirds_[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

  /// Takes over from the four neighbours that the sweep has visited: a row behind and one beside.
  void relax(int x, int y, int side) {
    take(x, y, x + side, y, 3);
    take(x, y, x, y + side, 3);
    take(x, y, x - 1, y + side, 4);
    take(x, y, x + 1, y + side, 4);
  }

  void take(int x, int y, int from_x, int from_y, int step) {
    const bool is_inside = from_x >= 0 && from_y >= 0 && from_x < width_ && from_y < height_;
    const bool is_same = is_inside && region_[index(from_x, from_y)] == region_[index(x, y)];
    int& thirds = thirds_[index(x, y)];
    thirds = std::min(thirds, is_same ? thirds_[index(from_x, from_y)] + step : step);
  }

  std::span<const RegionId> region_;
  int width_, height_;
  std::vector<int> thirds_;
};

}  // namespace

std::vector<LabelPlace> find_label_places(const VisibleTriangles& seen,
                                          std::span<const RegionId> region_of_triangle) {
  std::vector<RegionId> region(seen.triangle.size(), kNone);
  for (std::size_t i = 0; i < region.size(); ++i)
    if (seen.triangle[i] != kNone) region[i] = region_of_triangle[seen.triangle[i]];

  const DistanceToBorder distance(region, seen.width, seen.height);
  std::map<RegionId, LabelPlace> best;
  for (int y = 0; y < seen.height; ++y) {
    for (int x = 0; x < seen.width; ++x) {
      const RegionId r = region[static_cast<std::size_t>(y) * seen.width + x];
      if (r == kNone) continue;
      const double room = distance.thirds_at(x, y) / 3.0;
      const auto [place, is_new] = best.try_emplace(r, LabelPlace{r, x + 0.5, y + 0.5, room});
      if (room > place->second.room) place->second = {r, x + 0.5, y + 0.5, room};
    }
  }
  std::vector<LabelPlace> places;
  for (const auto& [r, place] : best) places.push_back(place);
  return places;
}

}  // namespace selvage
