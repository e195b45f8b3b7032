// SPDX-License-Identifier: MIT
#include "common/samples/triangulate.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>

#include "common/samples/flip_edges.h"

namespace selvage {
namespace {

using Ring = std::vector<std::uint32_t>;  // point numbers; a bridge's ends are in it twice

/// Twice the area of abc: positive if it turns left.
double turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double squared_distance(const Point2& a, const Point2& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

class EarClipper {
 public:
  explicit EarClipper(std::span<const std::vector<Point2>> loops) {
    std::vector<Ring> rings;
    for (const auto& loop : loops) {
      Ring ring(loop.size());
      std::iota(ring.begin(), ring.end(), static_cast<std::uint32_t>(points_.size()));
      points_.insert(points_.end(), loop.begin(), loop.end());
      rings.push_back(std::move(ring));
    }
    ring_ = rings.front();
    bridge_holes({rings.begin() + 1, rings.end()});
  }

  TriangleSoup run() {
    TriangleSoup soup;
    for (const Point2& p : points_) soup.positions.push_back({p.x, p.y, 0});
    std::size_t at = 0, tried = 0;
    while (ring_.size() > 3 && tried < ring_.size()) {
      at %= ring_.size();
      if (!is_ear(at)) {
        ++at, ++tried;
        continue;
      }
      soup.triangles.push_back({before(at), ring_[at], after(at)});
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(at));
      at += 1;  // skipping one keeps the ears from forming a fan of slivers
      tried = 0;
    }
    if (ring_.size() == 3) soup.triangles.push_back({ring_[0], ring_[1], ring_[2]});
    return soup;
  }

 private:
  std::uint32_t before(std::size_t i) const { return ring_[(i + ring_.size() - 1) % ring_.size()]; }
  std::uint32_t after(std::size_t i) const { return ring_[(i + 1) % ring_.size()]; }

  /// Rightmost hole first, so that a bridge to the right meets the outer ring or a hole that is joined
  /// already.
  void bridge_holes(std::vector<Ring> holes) {
    const auto rightmost = [&](Ring& ring) {
      return std::ranges::max_element(ring, {}, [&](std::uint32_t p) { return points_[p].x; });
    };
    for (Ring& hole : holes) std::ranges::rotate(hole, rightmost(hole));
    std::ranges::stable_sort(holes, std::greater{}, [&](const Ring& hole) { return points_[hole[0]].x; });
    for (std::size_t h = 0; h < holes.size(); ++h) {
      const std::size_t at = find_bridge(holes[h][0], std::span(holes).subspan(h));
      Ring joined(ring_.begin(), ring_.begin() + static_cast<std::ptrdiff_t>(at) + 1);
      joined.insert(joined.end(), holes[h].begin(), holes[h].end());
      joined.push_back(holes[h][0]);
      joined.insert(joined.end(), ring_.begin() + static_cast<std::ptrdiff_t>(at), ring_.end());
      ring_ = std::move(joined);
    }
  }

  /// The nearest place in the ring that sees `from` past the ring and all holes left.
  std::size_t find_bridge(std::uint32_t from, std::span<const Ring> holes) const {
    std::vector<std::size_t> places(ring_.size());
    std::iota(places.begin(), places.end(), std::size_t{0});
    std::ranges::stable_sort(
        places, {}, [&](std::size_t i) { return squared_distance(points_[ring_[i]], points_[from]); });
    for (std::size_t i : places) {
      if (!opens_towards(i, points_[from]) || crosses(ring_, from, ring_[i])) continue;
      if (std::ranges::none_of(holes, [&](const Ring& hole) { return crosses(hole, from, ring_[i]); }))
        return i;
    }
    return 0;
  }

  /// Whether the inside of the ring at place `i` lies in the direction of `p`: a point on a bridge is there
  /// twice.
  bool opens_towards(std::size_t i, const Point2& p) const {
    const Point2 &a = points_[before(i)], &b = points_[ring_[i]], &c = points_[after(i)];
    const bool left_of_in = turn(a, b, p) > 0, left_of_out = turn(b, c, p) > 0;
    return turn(a, b, c) >= 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
  }

  bool crosses(const Ring& ring, std::uint32_t a, std::uint32_t b) const {
    const Point2 &p = points_[a], &q = points_[b];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t c = ring[i], d = ring[(i + 1) % ring.size()];
      if (c == a || c == b || d == a || d == b) continue;
      const Point2 &r = points_[c], &s = points_[d];
      if ((turn(p, q, r) > 0) != (turn(p, q, s) > 0) && (turn(r, s, p) > 0) != (turn(r, s, q) > 0))
        return true;
    }
    return false;
  }

  bool is_ear(std::size_t i) const {
    const std::uint32_t ia = before(i), ib = ring_[i], ic = after(i);
    const Point2 &a = points_[ia], &b = points_[ib], &c = points_[ic];
    if (turn(a, b, c) <= 1e-12 * squared_distance(a, c)) return false;
    return std::ranges::none_of(ring_, [&](std::uint32_t ip) {
      if (ip == ia || ip == ib || ip == ic) return false;
      const Point2& p = points_[ip];
      return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    });
  }

  std::vector<Point2> points_;
  Ring ring_;
};

}  // namespace

std::vector<Triangle> triangulate(std::span<const std::vector<Point2>> loops) {
  TriangleSoup soup = EarClipper(loops).run();
  flip_to_delaunay(soup);
  return std::move(soup.triangles);
}

}  // namespace selvage
