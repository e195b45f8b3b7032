// SPDX-License-Identifier: MIT
#include "server/segment/geodesic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "server/segment/chunks.h"
#include "server/segment/one_ring.h"

namespace selvage {
namespace {

constexpr int kMaxTriangles = 1024;

// Four lines side by side, in the vector extension that GCC and Clang share.
constexpr int kLanes = 4;
using Floats = float __attribute__((vector_size(16)));
using Ints = std::int32_t __attribute__((vector_size(16)));

Floats choose(Ints first, Floats a, Floats b) { return first ? a : b; }

bool any(Ints mask) {
  using Halves = long long __attribute__((vector_size(16)));
  const auto halves = reinterpret_cast<Halves>(mask);
  return (halves[0] | halves[1]) != 0;
}

struct Vec2 {
  double x = 0, y = 0;
  friend Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
};

double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// The angles at v are summed in float, which is what bounds the evenness of directions: 1e-6.
void unfold_fan(const CornerTable& mesh, std::span<const Vec3> positions, VertexId v,
                std::vector<UnfoldedAtStart>& fan) {
  fan.clear();
  const Vec3 origin = positions[v];
  double sum = 0;
  for_each_corner_at(mesh, v, [&](CornerId c) {
    const Vec3 to_next = positions[mesh.vertex(next(c))] - origin;
    const Vec3 to_prev = positions[mesh.vertex(prev(c))] - origin;
    const double along = dot(to_next, to_prev), across = length(selvage::cross(to_next, to_prev));
    const double edge = length(to_next);
    sum += std::atan2(static_cast<float>(across), static_cast<float>(along));
    const double scale = edge > 0 ? 1 / edge : 0;
    fan.push_back({c, sum, edge, along * scale, across * scale});
  });
}

}  // namespace

/// Up to four lines on their way, in units of the length to walk.
class GeodesicTracer::Lines {
 public:
  Lines(const GeodesicTracer& tracer, const Vec3& origin, double length)
      : tracer_(tracer), origin_(origin), length_(length) {}

  /// Sets out on the next free lane, in the direction of cosine and sine seen from the edge to the next
  /// corner.
  void start(const UnfoldedAtStart& in, double angle, GeodesicEnd& end) {
    if (!(in.next_x > 0)) return;
    const float cosine = std::cos(static_cast<float>(angle)), sine = std::sin(static_cast<float>(angle));
    const double scale = 1 / length_;
    const Vec2 a{in.next_x * cosine * scale, -in.next_x * sine * scale};
    const Vec2 b{(in.prev_x * cosine + in.prev_y * sine) * scale,
                 (in.prev_y * cosine - in.prev_x * sine) * scale};
    const CornerId across = tracer_.mesh_.opposite[in.corner];
    if (const double reach = cross(a, b); reach >= b.y - a.y || across == kNone) {
      stop(end, in.corner, {}, a, b, reach >= b.y - a.y ? 1 : reach / (b.y - a.y));
      return;
    }
    a_x_[used_] = static_cast<float>(a.x), a_y_[used_] = static_cast<float>(a.y);
    b_x_[used_] = static_cast<float>(b.x), b_y_[used_] = static_cast<float>(b.y);
    entered_[used_] = across;
    ends_[used_] = &end;
    running_[used_++] = -1;
  }

  bool are_running() const { return any(running_); }

  /// Every line crosses one triangle. The last step stops those that have not arrived.
  void advance(bool is_last) {
    Floats row[kLanes];
    for (int i = 0; i < kLanes; ++i) std::memcpy(&row[i], &tracer_.entry_of_corner_[entered_[i]], 16);
    const Floats low01 = __builtin_shufflevector(row[0], row[1], 0, 4, 1, 5);
    const Floats low23 = __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5);
    const Floats high01 = __builtin_shufflevector(row[0], row[1], 2, 6, 3, 7);
    const Floats high23 = __builtin_shufflevector(row[2], row[3], 2, 6, 3, 7);
    const Floats x = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
    const Floats y = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
    const auto on_left = reinterpret_cast<Ints>(__builtin_shufflevector(high01, high23, 0, 1, 4, 5));
    const auto on_right = reinterpret_cast<Ints>(__builtin_shufflevector(high01, high23, 2, 3, 6, 7));

    const Floats edge_x = a_x_ - b_x_, edge_y = a_y_ - b_y_;
    const Floats apex_x = b_x_ + edge_x * x - edge_y * y, apex_y = b_y_ + edge_y * x + edge_x * y;
    // Which side is a coin toss, so values are chosen rather than branches taken.
    const Ints is_left = apex_y > 0;
    const Ints entered = is_left ? on_left : on_right;
    const Floats a_x = choose(is_left, a_x_, apex_x), a_y = choose(is_left, a_y_, apex_y);
    const Floats b_x = choose(is_left, apex_x, b_x_), b_y = choose(is_left, apex_y, b_y_);
    // The line leaves at reach / width; compared with 1 without dividing.
    const Floats reach = a_x * b_y - a_y * b_x, width = b_y - a_y;
    const Ints has_arrived = reach >= width;
    const Ints stops = running_ & (has_arrived | (entered == static_cast<std::int32_t>(kNone)) |
                                   (is_last ? Ints{-1, -1, -1, -1} : Ints{}));
    if (any(stops)) {
      for (int i = 0; i < kLanes; ++i) {
        if (stops[i] == 0) continue;
        stop(*ends_[i], entered_[i], {apex_x[i], apex_y[i]}, {b_x_[i], b_y_[i]}, {a_x_[i], a_y_[i]},
             has_arrived[i] ? 1.0 : double{reach[i]} / width[i]);
      }
      running_ &= ~stops;
    }
    a_x_ = a_x, a_y_ = a_y, b_x_ = b_x, b_y_ = b_y;
    // A lane without a line goes round in the first triangle, harmlessly.
    const Ints next_entered = entered & running_;
    std::memcpy(entered_.data(), &next_entered, 16);
  }

 private:
  /// The line ends at (share, 0) in the triangle of `c`, whose corners c, next, prev lie at the three places.
  void stop(GeodesicEnd& end, CornerId c, Vec2 at_c, Vec2 at_next, Vec2 at_prev, double share) {
    if (!(share > 0)) return;
    const Vec2 at = Vec2{share, 0} - at_c, to_next = at_next - at_c, to_prev = at_prev - at_c;
    const double area = cross(to_next, to_prev);
    double weight_next = 1.0 / 3, weight_prev = 1.0 / 3;  // a triangle without area: its middle
    if (area > 0) {
      const double scale = 1 / area;
      weight_next = std::clamp(cross(at, to_prev) * scale, 0.0, 1.0);
      weight_prev = std::clamp(cross(to_next, at) * scale, 0.0, 1.0);
    }
    const CornerTable& mesh = tracer_.mesh_;
    const Vec3 p = tracer_.positions_[mesh.vertex(c)];
    end.way = (p - origin_) + (tracer_.positions_[mesh.vertex(next(c))] - p) * weight_next +
              (tracer_.positions_[mesh.vertex(prev(c))] - p) * weight_prev;
    end.length = share * length_;
  }

  const GeodesicTracer& tracer_;
  Vec3 origin_;
  double length_;
  Floats a_x_{}, a_y_{}, b_x_{}, b_y_{};    // the edge in front of each line, a right of it and b left
  Ints running_{};                          // -1 where there is a line
  std::array<CornerId, kLanes> entered_{};  // the corner that faces that edge from beyond
  std::array<GeodesicEnd*, kLanes> ends_{};
  int used_ = 0;
};

GeodesicTracer::GeodesicTracer(const CornerTable& mesh, std::span<const Vec3> positions,
                               const ParallelFor& parallel)
    : mesh_(mesh),
      positions_(positions),
      entry_of_corner_(std::make_unique_for_overwrite<Entry[]>(mesh.corner_count())) {
  for_each_chunk(parallel, mesh.triangle_count(), [&](std::size_t begin, std::size_t end) {
    for (auto t = static_cast<TriangleId>(begin); t < end; ++t) {
      const auto [i, j, k] = mesh.triangle(t);
      const Vec3 corner[3] = {positions[i], positions[j], positions[k]};
      const Vec3 edge[3] = {corner[2] - corner[1], corner[0] - corner[2], corner[1] - corner[0]};
      const double double_area = length(selvage::cross(edge[0], edge[1]));
      for (std::uint32_t c = 0; c < 3; ++c) {
        const Vec3 &facing = edge[c], &to_apex = edge[(c + 2) % 3];  // from the next corner; to it from c
        const double squared = dot(facing, facing);
        // On an edge without length the apex stays at its end, where a line through it comes to rest.
        const double scale = squared > 0 ? 1 / squared : 0;
        entry_of_corner_[3 * t + c] = {
            static_cast<float>(-dot(to_apex, facing) * scale), static_cast<float>(double_area * scale),
            mesh.opposite[3 * t + (c + 1) % 3], mesh.opposite[3 * t + (c + 2) % 3]};
      }
    }
  });
}

void GeodesicTracer::shoot(VertexId v, double length, Scratch& scratch, std::span<GeodesicEnd> ends) const {
  std::vector<UnfoldedAtStart>& fan = scratch.fan;
  unfold_fan(mesh_, positions_, v, fan);
  const double step = fan.back().end_angle / static_cast<double>(ends.size());
  std::size_t in = 0;
  for (std::size_t j = 0; j < ends.size();) {
    Lines lines[2] = {{*this, positions_[v], length}, {*this, positions_[v], length}};
    for (Lines& four : lines) {
      for (int lane = 0; lane < kLanes && j < ends.size(); ++lane, ++j) {
        ends[j] = {};
        const double angle = (static_cast<double>(j) + 0.5) * step;
        while (in + 1 < fan.size() && fan[in].end_angle <= angle) ++in;
        four.start(fan[in], angle - (in == 0 ? 0 : fan[in - 1].end_angle), ends[j]);
      }
    }
    for (int triangle = 1; lines[0].are_running() || lines[1].are_running(); ++triangle) {
      lines[0].advance(triangle == kMaxTriangles);
      lines[1].advance(triangle == kMaxTriangles);
    }
  }
}

}  // namespace selvage
