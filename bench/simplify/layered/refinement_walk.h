// SPDX-License-Identifier: MIT
//
// One level of a region made from the next coarser one, vertex split by vertex split: the procedure that
// encoder and decoder share. A `Side` is asked for every symbol and says what it is; an encoder knows, and
// takes note.
//
// Vertices wait in a queue, at first all of them. The one at its head is split or left alone, by a symbol; a
// split makes four vertices join the queue if they are not in it: the old and the new one, and the two that a
// triangle came to. Nothing else can have become possible by it. When the queue is empty the level is done.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bench/simplify/layered/new_vertex.h"
#include "bench/simplify/layered/refinement_tables.h"
#include "bench/simplify/layered/split_mesh.h"
#include "common/codec/region_format.h"

namespace selvage::bench {

/// A region between two levels. Coordinates lack the low bits that the level in hand drops.
struct GrowingRegion {
  GrowingRegion(const CornerTable& base, std::uint32_t vertices, std::uint32_t triangles)
      : mesh(base, vertices, triangles), position(vertices), run(vertices),
        cotangent(4 * std::size_t{triangles}), history(vertices), is_queued(vertices),
        badness(triangles + 1), place(triangles + 1) {}

  SplitMesh mesh;
  std::vector<IntLanes> position;
  /// Finest boundary indices that a vertex stands for, of one loop and counted in it; none inside.
  struct BoundaryRun {
    std::uint32_t loop = 0, begin = 0, length = 0;
  };
  std::vector<BoundaryRun> run;
  std::vector<float> cotangent;      ///< by corner; of the triangle as it was when it last changed

  // Of the walk.
  std::vector<std::uint8_t> history, is_queued;
  std::vector<VertexId> queue;
  std::vector<float> badness;
  std::vector<std::uint32_t> place;
};

struct WantedSplit {
  SplitKind kind = SplitKind::None;
  std::uint32_t begin = 0, span = 0, boundary_run = 0;
};

template <class Side>
class RefinementWalk {
 public:
  RefinementWalk(GrowingRegion& region, const RefinementTables& tables, std::uint32_t vertices,
                 std::uint32_t triangles, bool is_finest, Side& side)
      : region_(region), mesh_(region.mesh), place_(tables), sizes_(size_tables(tables), Blends{}),
        vertices_(vertices), triangles_(triangles), is_finest_(is_finest), side_(side) {}

  /// False if the stream is corrupt.
  bool run() {
    const VertexId coarse = mesh_.vertex_count();
    region_.queue.resize(coarse);
    for (VertexId v = 0; v < coarse; ++v) region_.queue[v] = v, region_.history[v] = 0, region_.is_queued[v] = 1;
    measure_all();
    for (std::size_t head = 0; head < region_.queue.size(); ++head) {
      const VertexId v = region_.queue[head];
      region_.is_queued[v] = 0;
      if (!ask(v)) return false;
    }
    return mesh_.vertex_count() == vertices_ && mesh_.triangle_count() == triangles_;
  }

 private:
  static CodecTables size_tables(const RefinementTables& tables) {
    return {tables.models, {}, {}, tables.size};
  }

  void measure(std::uint32_t t) {
    const IntLanes a = at(4 * t), b = at(4 * t + 1), c = at(4 * t + 2);
    const FloatLanes ab = to_float(b - a), bc = to_float(c - b), ca = to_float(a - c);
    const FloatLanes normal = cross(ab, ca);
    const float area = __builtin_sqrtf(dot3(normal, normal));
    const float scale = area > 0 ? -1.0F / area : 0;
    region_.cotangent[4 * t] = dot3(ab, ca) * scale;
    region_.cotangent[4 * t + 1] = dot3(ab, bc) * scale;
    region_.cotangent[4 * t + 2] = dot3(bc, ca) * scale;
  }
  IntLanes at(CornerId c) const { return region_.position[mesh_.vertex(c)]; }

  void measure_all() {
    std::int64_t sum = 0;
    for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t) {
      measure(t);
      const FloatLanes edge = absolute(to_float(at(4 * t) - at(4 * t + 1)));
      sum += static_cast<std::int64_t>(edge[0] + edge[1] + edge[2]);
    }
    place_.start(log_size(static_cast<std::uint64_t>(sum) / (mesh_.triangle_count() + 1)));
  }

  void push(VertexId v, std::uint8_t history) {
    region_.history[v] = history;
    if (region_.is_queued[v]) return;
    region_.is_queued[v] = 1;
    region_.queue.push_back(v);
  }

  bool ask(VertexId v) {
    using namespace refinement_model;
    const SplitMesh::Star star = mesh_.star(v);
    const float worst = look_at_spokes(v, star);
    const WantedSplit wanted = side_.wanted(v, star);
    WantedSplit split;
    const unsigned history = region_.history[v];
    const unsigned degree = std::clamp(star.size, 3u, 2 + kDegrees) - 3;
    if (star.is_open) {
      const unsigned runs = std::min(region_.run[v].length, kRuns) - 1;
      const unsigned open_degree = std::clamp(star.size, 1u, kDegrees) - 1;
      const unsigned kind = side_.symbol(kOpen + ((is_finest_ * kRuns + runs) * kHistories + history) * kDegrees + open_degree,
                                         static_cast<unsigned>(wanted.kind));
      if (kind > 3) return false;
      split.kind = static_cast<SplitKind>(kind);
      if (kind == 0) return refuse(v);
      if (split.kind != SplitKind::Inner && region_.run[v].length < 2) return false;
      const unsigned least = split.kind == SplitKind::Inner;
      split.span = span_of(kOpenSpan + kind * kDegrees + open_degree, wanted.span - least) + least;
      if (split.span > star.size) return false;
      if (split.kind == SplitKind::AtEnd) split.begin = star.size - split.span;
    } else {
      const unsigned badness = badness_class(worst);
      const unsigned context = ((is_finest_ * kHistories + history) * kDegrees + degree) * kBadnesses + badness;
      split.span = span_of(kClosed + context, wanted.span);
      if (split.span == 0) return refuse(v);
      split.kind = SplitKind::Inner;
      if (split.span >= star.size) return false;
    }
    if (split.kind == SplitKind::Inner && !choose_begin(star, wanted, split)) return false;
    if (split.kind != SplitKind::Inner && !choose_run(v, wanted, split)) return false;
    return grow(v, star, split);
  }

  bool refuse(VertexId v) {
    region_.history[v] = 1;
    return true;
  }

  std::uint32_t span_of(unsigned model, std::uint32_t wanted) {
    const unsigned symbol = side_.symbol(model, std::min(wanted, 15u));
    return symbol < 15 ? symbol : 15 + side_.number(refinement_model::kSpanExcess, wanted - 15);
  }

  /// Of each spoke how much it looks like one that a collapse has made; gives the worst one's.
  float look_at_spokes(VertexId v, const SplitMesh::Star& star) {
    const IntLanes centre = region_.position[v];
    float sum = 0;
    for (std::uint32_t i = 0; i < star.size; ++i) {
      const FloatLanes spoke = to_float(at(SplitMesh::next(star.corners[i])) - centre);
      const float square = dot3(spoke, spoke);
      region_.badness[i] = square;
      sum += square;
    }
    const float scale = sum > 0 ? static_cast<float>(star.size) / sum : 0;
    float worst = -100;
    CornerId before = star.is_open ? kNone : star.corners[star.size - 1];
    for (std::uint32_t i = 0; i < star.size; ++i) {
      const CornerId c = star.corners[i];
      float badness = region_.badness[i] * scale;
      if (before != kNone) {
        const float sharp =
            region_.cotangent[SplitMesh::prev(c)] + region_.cotangent[SplitMesh::next(before)];
        badness -= std::clamp(sharp, -2.0F, 2.0F);
        worst = std::max(worst, badness);
      }
      region_.badness[i] = badness;
      before = c;
    }
    return worst;
  }

  static unsigned badness_class(float worst) {
    constexpr float kSteps[] = {0.4F, 0.8F, 1.2F, 1.6F, 2.2F, 2.9F, 3.8F};
    unsigned n = 0;
    for (const float step : kSteps) n += worst > step;
    return n;
  }

  /// Which run of so many triangles: those with the worst spokes inside come first.
  bool choose_begin(const SplitMesh::Star& star, const WantedSplit& wanted, WantedSplit& split) {
    using namespace refinement_model;
    const std::uint32_t candidates = star.is_open ? star.size - split.span + 1 : star.size;
    float* score = scores_.make(candidates);
    const auto wrapped = [&](std::uint32_t i) { return i < star.size ? i : i - star.size; };
    for (std::uint32_t i = 0; i < candidates; ++i) {
      float sum = 0;
      for (std::uint32_t j = 1; j < split.span; ++j) sum += region_.badness[wrapped(i + j)];
      sum -= 0.5F * region_.badness[i];
      if (!star.is_open || i + split.span < star.size) sum -= 0.5F * region_.badness[wrapped(i + split.span)];
      score[i] = sum;
    }
    const auto comes_before = [&](std::uint32_t i, std::uint32_t j) {
      return score[i] > score[j] || (score[i] == score[j] && i < j);
    };
    std::uint32_t wanted_rank = 0;
    if (wanted.kind != SplitKind::None) {
      for (std::uint32_t i = 0; i < candidates; ++i) wanted_rank += comes_before(i, wanted.begin);
    }
    const unsigned model = kRank + (std::min(split.span, 8u) - 1) * 8 + std::clamp(candidates, 1u, 8u) - 1;
    std::uint32_t rank = candidates == 1 ? 0 : side_.symbol(model, std::min(wanted_rank, 15u));
    if (rank == 15) rank += side_.number(kRankExcess, wanted_rank - 15);
    if (rank >= candidates) return false;
    // Selection: ranks are small.
    std::uint32_t best = 0;
    for (std::uint32_t taken = 0;; ++taken) {
      best = kNone;
      for (std::uint32_t i = 0; i < candidates; ++i) {
        if (score[i] > -1e30F && (best == kNone || score[i] > score[best])) best = i;
      }
      if (taken == rank) break;
      score[best] = -2e30F;
    }
    split.begin = best;
    return true;
  }

  bool choose_run(VertexId v, const WantedSplit& wanted, WantedSplit& split) {
    using namespace refinement_model;
    const std::uint32_t run = region_.run[v].length;
    split.boundary_run = 1;
    if (run == 2) return true;
    const unsigned symbol = side_.symbol(kBoundaryRun + std::min(run, 8u) - 1, std::min(wanted.boundary_run - 1, 15u));
    split.boundary_run = symbol + 1;
    if (symbol == 15) split.boundary_run += side_.number(kRunExcess, wanted.boundary_run - 16);
    return split.boundary_run < run;
  }

  bool grow(VertexId v, const SplitMesh::Star& star, const WantedSplit& split) {
    const unsigned new_triangles = split.kind == SplitKind::Inner ? 2 : 1;
    if (mesh_.vertex_count() == vertices_ || mesh_.triangle_count() + new_triangles > triangles_) return false;
    const auto wrapped = [&](std::uint32_t i) { return i < star.size ? i : i - star.size; };
    NewRing ring;
    ring.split = region_.position[v];
    if (split.span == 0) return grow_ear(v, star, split, ring);
    const CornerId first = star.corners[split.begin], last = star.corners[wrapped(split.begin + split.span - 1)];
    const VertexId w1 = mesh_.vertex(SplitMesh::next(first)), w2 = mesh_.vertex(SplitMesh::prev(last));
    add_tip(ring, SplitMesh::prev(first));
    ring.point[ring.points++] = region_.position[w1];
    for (std::uint32_t i = 0; i < split.span; ++i) {
      const CornerId c = star.corners[wrapped(split.begin + i)];
      if (ring.points < NewRing::kMost) {
        add_tip(ring, c);
        ring.point[ring.points++] = at(SplitMesh::prev(c));
      }
    }
    add_tip(ring, SplitMesh::next(last));
    ring.is_open = split.kind != SplitKind::Inner;
    if (split.kind == SplitKind::AtEnd) {
      for (unsigned i = ring.points; i > 0; --i) ring.point[i] = ring.point[i - 1];
      ring.point[0] = ring.split;
      ++ring.points;
    } else {
      ring.point[ring.points++] = ring.split;
    }
    const VertexId u = add_vertex(v, star, split, ring);
    for (std::uint32_t i = 0; i < split.span; ++i)
      measure(star.corners[wrapped(split.begin + i)] / 4);
    push(v, 2);
    push(u, 3);
    if (split.kind != SplitKind::AtStart) push(w1, region_.history[w1]);
    if (split.kind != SplitKind::AtEnd) push(w2, region_.history[w2]);
    return true;
  }

  bool grow_ear(VertexId v, const SplitMesh::Star& star, const WantedSplit& split, NewRing& ring) {
    const bool is_at_end = split.kind == SplitKind::AtEnd;
    const CornerId facing =
        is_at_end ? SplitMesh::next(star.corners[star.size - 1]) : SplitMesh::prev(star.corners[0]);
    const VertexId w = mesh_.vertex(is_at_end ? SplitMesh::next(facing) : SplitMesh::prev(facing));
    ring.is_open = true;
    ring.point[0] = is_at_end ? ring.split : region_.position[w];
    ring.point[1] = is_at_end ? region_.position[w] : ring.split;
    ring.points = 2;
    ring.tip[ring.tips++] = ring.point[0] + ring.point[1] - at(facing);
    const VertexId u = add_vertex(v, star, split, ring);
    push(v, 2);
    push(u, 3);
    push(w, region_.history[w]);
    return true;
  }

  VertexId add_vertex(VertexId v, const SplitMesh::Star& star, const WantedSplit& split, const NewRing& ring) {
    Surroundings around{};
    const auto features = place_.look(ring, around);
    std::uint32_t tangential = 0, normal = 0;
    const IntLanes position = side_.position(sizes_, around, features, ring, tangential, normal);
    place_.note(tangential, normal);
    const std::uint32_t triangles = mesh_.triangle_count();
    const VertexId u = mesh_.split(v, star, split.kind, split.begin, split.span);
    region_.position[u] = position;
    for (std::uint32_t t = triangles; t < mesh_.triangle_count(); ++t) measure(t);
    side_.is_split(v, star, split, triangles);
    if (split.kind != SplitKind::Inner) {
      auto &old_run = region_.run[v], &new_run = region_.run[u];
      new_run = {old_run.loop, old_run.begin, split.boundary_run};
      old_run.length -= split.boundary_run;
      (split.kind == SplitKind::AtStart ? new_run : old_run).begin +=
          split.kind == SplitKind::AtStart ? old_run.length : split.boundary_run;
    }
    region_.is_queued[u] = 0;
    return u;
  }

  void add_tip(NewRing& ring, CornerId facing) {
    const CornerId across = mesh_.opposite(facing);
    if (across == kNone) return;
    // The edge that `facing` faces.
    ring.tip[ring.tips++] = at(SplitMesh::next(facing)) + at(SplitMesh::prev(facing)) - at(across);
  }

  GrowingRegion& region_;
  SplitMesh& mesh_;
  PlaceModel place_;
  Predictor sizes_;
  const std::uint32_t vertices_, triangles_;
  const bool is_finest_;
  Side& side_;
  Scratch<float> scores_;
};

}  // namespace selvage::bench
