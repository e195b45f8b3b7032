// SPDX-License-Identifier: MIT
//
// One level of a region made from the next coarser one, vertex split by vertex split: the procedure that
// encoder and decoder share. A `Side` is asked for every symbol and says what it is; an encoder knows, and
// takes note.
//
// Vertices wait in a queue, at first all of them. The one at its head is split or left alone, by a symbol; a
// split makes four vertices join the queue if they are not in it: the old and the new one, and the two that a
// triangle came to. Nothing else can have become possible by it. When the queue is empty the level is done.
//
// Whether a vertex is split is coded without a look at positions: how bad its edges' angles are said 0.1 bits
// a new vertex, and its star took half of the time. Which run it gives away goes by lengths; angles said 0.06
// bits more.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "bench/simplify/layered/growing_region.h"
#include "bench/simplify/layered/new_vertex.h"
#include "bench/simplify/layered/refinement_tables.h"
#include "common/codec/region_format.h"

namespace selvage::bench {

/// What becomes of a vertex.
struct SplitChoice {
  SplitKind kind = SplitKind::None;
  std::uint32_t begin = 0, span = 0;  ///< the run of its corners that the new vertex takes, see SplitMesh
  std::uint32_t boundary_run = 0;     ///< finest boundary indices that it takes, if on the border
};

template <class Side>
class RefinementWalk {
 public:
  RefinementWalk(GrowingRegion& region, const RefinementTables& tables, std::uint32_t vertices,
                 std::uint32_t triangles, bool is_finest, Side& side)
      : region_(region),
        mesh_(region.mesh),
        place_(tables),
        sizes_(size_tables(tables), Blends{}),
        vertices_(vertices),
        triangles_(triangles),
        is_finest_(is_finest),
        side_(side) {}

  /// False if the stream is corrupt.
  bool run() {
    std::vector<VertexId>& queue = region_.queue;
    queue.clear();
    for (VertexId v = 0; v < mesh_.vertex_count(); ++v) {
      GrowingRegion::VertexState& state = region_.state[v];
      state.history = GrowingRegion::NotAsked;
      state.is_queued = true;
      state.is_open = region_.run[v].length > 0;
      queue.push_back(v);
    }
    place_.start(log_size(mean_edge()));
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const VertexId v = queue[head];
      region_.state[v].is_queued = false;
      if (!(region_.state[v].is_open ? ask_open(v) : ask_closed(v))) return false;
    }
    return mesh_.vertex_count() == vertices_ && mesh_.triangle_count() == triangles_;
  }

 private:
  static constexpr std::uint32_t kFew = 8;  ///< triangles of a star, nearly always
  static constexpr float kNever = -std::numeric_limits<float>::infinity();

  static CodecTables size_tables(const RefinementTables& tables) {
    return {tables.models, {}, {}, tables.size};
  }

  IntLanes at(CornerId c) const { return region_.position[mesh_.vertex(c)]; }

  /// About: of one edge a triangle, the sum over the axes.
  std::uint64_t mean_edge() const {
    std::int64_t sum = 0;
    for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t) {
      const IntLanes edge = at(4 * t) - at(4 * t + 1);
      sum += std::abs(edge[0]) + std::abs(edge[1]) + std::abs(edge[2]);
    }
    return static_cast<std::uint64_t>(sum) / (mesh_.triangle_count() + 1);
  }

  /// A triangle more at v, which may let it be split.
  void touch(VertexId v) {
    ++region_.state[v].degree;
    enqueue(v);
  }
  void enqueue(VertexId v) {
    if (region_.state[v].is_queued) return;
    region_.state[v].is_queued = true;
    region_.queue.push_back(v);
  }

  bool ask_closed(VertexId v) {
    using namespace refinement_model;
    GrowingRegion::VertexState& state = region_.state[v];
    const SplitChoice wanted = side_.wanted(v);
    const unsigned degree = std::clamp(state.degree, 3u, 2 + kDegrees) - 3;
    SplitChoice split{.kind = SplitKind::Inner};
    split.span =
        span_of(kClosed + (is_finest_ * kHistories + state.history) * kDegrees + degree, wanted.span);
    if (split.span == 0) {
      state.history = GrowingRegion::LeftAlone;
      return true;
    }
    if (split.span >= state.degree) return false;
    const SplitMesh::Star star = mesh_.star(v);
    return choose_begin(v, star, wanted, split) && grow(v, star, split);
  }

  bool ask_open(VertexId v) {
    using namespace refinement_model;
    GrowingRegion::VertexState& state = region_.state[v];
    const SplitChoice wanted = side_.wanted(v);
    const unsigned runs = std::min(region_.run[v].length, kRuns) - 1;
    const unsigned degree = std::clamp(state.degree, 1u, kDegrees) - 1;
    const unsigned context = ((is_finest_ * kRuns + runs) * kHistories + state.history) * kDegrees + degree;
    const unsigned kind = side_.symbol(kOpen + context, static_cast<unsigned>(wanted.kind));
    if (kind == 0) {
      state.history = GrowingRegion::LeftAlone;
      return true;
    }
    if (kind > 3) return false;
    SplitChoice split{.kind = static_cast<SplitKind>(kind)};
    const bool is_inner = split.kind == SplitKind::Inner;
    split.span = span_of(kOpenSpan + kind * kDegrees + degree, wanted.span - is_inner) + is_inner;
    if (split.span > state.degree) return false;
    const SplitMesh::Star star = mesh_.star(v);
    if (split.kind == SplitKind::AtEnd) split.begin = star.size - split.span;
    return (is_inner ? choose_begin(v, star, wanted, split) : choose_run(v, wanted, split)) &&
           grow(v, star, split);
  }

  std::uint32_t span_of(unsigned model, std::uint32_t wanted) {
    const unsigned symbol = side_.symbol(model, std::min(wanted, 15u));
    return symbol < 15 ? symbol : 15 + side_.number(refinement_model::kSpanExcess, wanted - 15);
  }

  /// Which run of so many triangles: those with the longest edges inside come first, and short ones at their
  /// ends, as a collapse draws edges out.
  bool choose_begin(VertexId v, const SplitMesh::Star& star, const SplitChoice& wanted, SplitChoice& split) {
    using namespace refinement_model;
    const std::uint32_t candidates = star.is_open ? star.size - split.span + 1 : star.size;
    if (candidates == 1) return true;
    // Squared lengths, in a closed star round and round.
    const std::uint32_t end = star.size <= kFew ? 2 * kFew + 1 : 2 * star.size;
    float* length = lengths_.make(end);
    if (star.size <= kFew) std::fill_n(length, end, 0.0F);
    const IntLanes centre = region_.position[v];
    for (std::uint32_t i = 0; i < star.size; ++i)
      length[i] = square(at(SplitMesh::next(star.corners[i])) - centre);
    if (star.is_open) {
      length[star.size] = square(at(SplitMesh::prev(star.corners[star.size - 1])) - centre);
    } else {
      std::copy_n(length, star.size <= kFew ? kFew : star.size, length + star.size);
    }
    return star.size <= kFew ? choose_of_few(length, candidates, wanted, split)
                             : choose_of_many(length, candidates, wanted, split);
  }

  /// Without jumps: how large stars and runs are cannot be guessed.
  bool choose_of_few(const float* length, std::uint32_t candidates, const SplitChoice& wanted,
                     SplitChoice& split) {
    std::array<float, kFew> score;
    for (std::uint32_t i = 0; i < kFew; ++i) score[i] = -0.5F * (length[i] + length[i + split.span]);
    for (std::uint32_t j = 1; j < kFew; ++j) {
      const float weight = j < split.span ? 1 : 0;
      for (std::uint32_t i = 0; i < kFew; ++i) score[i] += weight * length[i + j];
    }
    for (std::uint32_t i = 0; i < kFew; ++i) score[i] = i < candidates ? score[i] : kNever;
    std::array<std::int32_t, kFew> rank{};
    for (std::uint32_t j = 0; j < kFew; ++j) {
      for (std::uint32_t i = 0; i < kFew; ++i)
        rank[i] += (score[j] > score[i]) | ((score[j] == score[i]) & (j < i));
    }
    const auto chosen = static_cast<std::int32_t>(
        code_rank(candidates, split, static_cast<std::uint32_t>(rank[wanted.begin % kFew])));
    std::uint32_t bits = 0;
    for (std::uint32_t i = 0; i < kFew; ++i) bits |= static_cast<std::uint32_t>(rank[i] == chosen) << i;
    split.begin = static_cast<std::uint32_t>(std::countr_zero(bits | 1u << kFew));
    return split.begin < candidates;
  }

  bool choose_of_many(const float* length, std::uint32_t candidates, const SplitChoice& wanted,
                      SplitChoice& split) {
    float* score = scores_.make(candidates);
    for (std::uint32_t i = 0; i < candidates; ++i) {
      score[i] = -0.5F * (length[i] + length[i + split.span]);
      for (std::uint32_t j = 1; j < split.span; ++j) score[i] += length[i + j];
    }
    std::uint32_t wanted_rank = 0;
    for (std::uint32_t i = 0; i < candidates && wanted.kind != SplitKind::None; ++i)
      wanted_rank += score[i] > score[wanted.begin] || (score[i] == score[wanted.begin] && i < wanted.begin);
    std::uint32_t rank = code_rank(candidates, split, wanted_rank);
    if (rank >= candidates) return false;
    while (true) {
      split.begin = static_cast<std::uint32_t>(std::max_element(score, score + candidates) - score);
      if (rank-- == 0) return true;
      score[split.begin] = kNever;
    }
  }

  std::uint32_t code_rank(std::uint32_t candidates, const SplitChoice& split, std::uint32_t wanted_rank) {
    using namespace refinement_model;
    const unsigned model = kRank + (std::min(split.span, 8u) - 1) * 8 + std::min(candidates, 8u) - 1;
    const std::uint32_t rank = side_.symbol(model, std::min(wanted_rank, 15u));
    return rank < 15 ? rank : rank + side_.number(kRankExcess, wanted_rank - 15);
  }

  static float square(IntLanes step) {
    const FloatLanes at = to_float(step);
    return dot3(at, at);
  }

  bool choose_run(VertexId v, const SplitChoice& wanted, SplitChoice& split) {
    using namespace refinement_model;
    const std::uint32_t run = region_.run[v].length;
    split.boundary_run = 1;
    if (run < 2) return false;
    if (run == 2) return true;
    const unsigned symbol =
        side_.symbol(kBoundaryRun + std::min(run, 8u) - 1, std::min(wanted.boundary_run - 1, 15u));
    split.boundary_run = symbol + 1;
    if (symbol == 15) split.boundary_run += side_.number(kRunExcess, wanted.boundary_run - 16);
    return split.boundary_run < run;
  }

  bool grow(VertexId v, const SplitMesh::Star& star, const SplitChoice& split) {
    const unsigned new_triangles = split.kind == SplitKind::Inner ? 2 : 1;
    if (mesh_.vertex_count() == vertices_ || mesh_.triangle_count() + new_triangles > triangles_)
      return false;
    const auto wrapped = [&](std::uint32_t i) { return i < star.size ? i : i - star.size; };
    NewRing ring(region_.position[v], split.kind);
    if (split.span == 0) return grow_ear(v, star, split, ring);
    const CornerId first = star.corners[split.begin],
                   last = star.corners[wrapped(split.begin + split.span - 1)];
    const VertexId w1 = mesh_.vertex(SplitMesh::next(first)), w2 = mesh_.vertex(SplitMesh::prev(last));
    add_tip(ring, SplitMesh::prev(first));
    ring.add_point(region_.position[w1]);
    for (std::uint32_t i = 0; i < std::min(split.span, NewRing::kMost); ++i) {
      const CornerId c = star.corners[wrapped(split.begin + i)];
      add_tip(ring, c);
      ring.add_point(at(SplitMesh::prev(c)));
    }
    add_tip(ring, SplitMesh::next(last));
    add_vertex(v, star, split, ring);
    if (split.kind != SplitKind::AtStart) touch(w1);
    if (split.kind != SplitKind::AtEnd) touch(w2);
    return true;
  }

  bool grow_ear(VertexId v, const SplitMesh::Star& star, const SplitChoice& split, NewRing& ring) {
    const bool is_at_end = split.kind == SplitKind::AtEnd;
    const CornerId facing =
        is_at_end ? SplitMesh::next(star.corners[star.size - 1]) : SplitMesh::prev(star.corners[0]);
    const VertexId w = mesh_.vertex(is_at_end ? SplitMesh::next(facing) : SplitMesh::prev(facing));
    ring.add_point(region_.position[w]);
    ring.add_tip(region_.position[v] + region_.position[w] - at(facing));
    add_vertex(v, star, split, ring);
    touch(w);
    return true;
  }

  void add_vertex(VertexId v, const SplitMesh::Star& star, const SplitChoice& split, const NewRing& ring) {
    Surroundings around{};
    const auto features = place_.look(ring, around);
    std::uint32_t tangential = 0, normal = 0;
    const IntLanes position = side_.position(sizes_, around, features, tangential, normal);
    place_.note(tangential, normal);
    const std::uint32_t triangles = mesh_.triangle_count();
    const VertexId u = mesh_.split(v, star, split.kind, split.begin, split.span);
    region_.position[u] = position;
    side_.is_split(triangles);
    if (split.kind != SplitKind::Inner) {
      auto &old_run = region_.run[v], &new_run = region_.run[u];
      new_run = {old_run.loop, old_run.begin, split.boundary_run};
      old_run.length -= split.boundary_run;
      (split.kind == SplitKind::AtStart ? new_run : old_run).begin +=
          split.kind == SplitKind::AtStart ? old_run.length : split.boundary_run;
    }
    const std::uint32_t more = mesh_.triangle_count() - triangles;
    GrowingRegion::VertexState &old_state = region_.state[v], &new_state = region_.state[u];
    new_state = {split.span + more, GrowingRegion::New, false, split.kind != SplitKind::Inner};
    old_state.degree += more - split.span;
    old_state.history = GrowingRegion::Split;
    enqueue(v);
    enqueue(u);
  }

  void add_tip(NewRing& ring, CornerId facing) {
    const CornerId across = mesh_.opposite(facing);
    if (across == kNone) return;
    // The edge that `facing` faces.
    ring.add_tip(at(SplitMesh::next(facing)) + at(SplitMesh::prev(facing)) - at(across));
  }

  GrowingRegion& region_;
  SplitMesh& mesh_;
  PlaceModel place_;
  Predictor sizes_;
  const std::uint32_t vertices_, triangles_;
  const bool is_finest_;
  Side& side_;
  Scratch<float> lengths_, scores_;
};

}  // namespace selvage::bench
