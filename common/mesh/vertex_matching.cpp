// SPDX-License-Identifier: MIT
#include "common/mesh/vertex_matching.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace selvage {
namespace {

using Verdict = VertexMatching::Verdict;
using Images = std::vector<VertexId>;  // of a cluster's vertices, in their order

double max_norm(const Vec3& a, const Vec3& b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

/// Vertices by colour and place: a chained hash table over cells as wide as the tolerance reaches, so a
/// look-up visits eight cells at most.
class NearbyVertices {
 public:
  NearbyVertices(const MatchSide& side, double tolerance) : side_(side) {
    double extent = 0;
    for (const Vec3& p : side.positions)
      extent = std::max({extent, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    cell_ = std::max({2 * tolerance, extent * 1e-9, std::numeric_limits<double>::min() * 1e9});
    const std::uint32_t count = side.stars.vertex_count();
    mask_ = std::bit_ceil(std::size_t{count} + 1) - 1;
    first_of_bucket_.assign(mask_ + 1, kNone);
    next_in_bucket_.assign(count, kNone);
    for (VertexId v = count; v-- > 0;) {
      if (!side.stars.is_used(v)) continue;
      const Vec3& p = side.positions[v];
      VertexId& first = first_of_bucket_[bucket(side.colours[v], {cell(p.x), cell(p.y), cell(p.z)})];
      next_in_bucket_[v] = first;
      first = v;
    }
  }

  /// Calls visit(vertex) for vertices of that colour within `reach` of `p`, lowest first in each cell, until
  /// it returns false or `patience` entries were looked at. False if patience ended.
  template <class Visit>
  bool visit(const Vec3& p, std::uint64_t colour, double reach, int patience, Visit&& visit) const {
    for (std::int64_t x = cell(p.x - reach); x <= cell(p.x + reach); ++x)
      for (std::int64_t y = cell(p.y - reach); y <= cell(p.y + reach); ++y)
        for (std::int64_t z = cell(p.z - reach); z <= cell(p.z + reach); ++z)
          for (VertexId v = first_of_bucket_[bucket(colour, {x, y, z})]; v != kNone; v = next_in_bucket_[v]) {
            if (patience-- == 0) return false;
            const Vec3& q = side_.positions[v];
            const bool is_here = cell(q.x) == x && cell(q.y) == y && cell(q.z) == z;  // not another cell's
            if (is_here && side_.colours[v] == colour && max_norm(p, q) <= reach && !visit(v)) return true;
          }
    return true;
  }

 private:
  std::int64_t cell(double coordinate) const {
    return static_cast<std::int64_t>(std::clamp(std::floor(coordinate / cell_), -9e18, 9e18));
  }
  std::size_t bucket(std::uint64_t colour, const std::array<std::int64_t, 3>& at) const {
    std::uint64_t h = colour;
    for (std::int64_t c : at) h = (std::rotl(h, 23) ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15u;
    return (h ^ (h >> 32)) & mask_;
  }

  const MatchSide& side_;
  double cell_;
  std::size_t mask_;
  std::vector<VertexId> first_of_bucket_, next_in_bucket_;
};

/// One way to go on from a choice: up to two vertices of a get images.
struct Option {
  std::array<VertexId, 2> vertices = {kNone, kNone}, images = {kNone, kNone};
  double distance = 0;
};

struct Choice {
  std::vector<Option> options;
  std::size_t next_option = 0;
  std::size_t matched_before = 0;  // length of the trail to return to
  std::size_t reached_before = 0;  // how much of the cluster was done
};

class Matcher {
 public:
  Matcher(const MatchSide& a, const MatchSide& b, double tolerance)
      : a_(a), b_(b), reach_(with_slack(a, tolerance)), nearby_(b, reach_) {
    image_.assign(a.stars.vertex_count(), kNone);
    preimage_.assign(b.stars.vertex_count(), kNone);
    cluster_of_vertex_.assign(a.stars.vertex_count(), kNone);
    flooded_in_.assign(a.stars.vertex_count(), 0);
    steps_left_ = 20'000'000 + 100 * std::int64_t{a.stars.triangle_count()};
  }

  VertexMatching run() {
    const Verdict verdict = match_all();
    return {verdict, std::move(image_), verdict == Verdict::Found ? kNone : culprit_,
            culprit_has_candidates_};
  }

 private:
  static double with_slack(const MatchSide& side, double tolerance) {
    if (!(tolerance > 0)) return 0;
    double extent = 0;
    for (const Vec3& p : side.positions)
      extent = std::max({extent, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return std::min(tolerance, 1e300) * (1 + 1e-9) + extent * 4 * std::numeric_limits<double>::epsilon();
  }

  Verdict match_all() {
    if (!match_single_candidates() || !follow_all_matched()) return Verdict::Impossible;
    gather_clusters();
    for (std::uint32_t cluster = 0; cluster < clusters_.size(); ++cluster)
      if (!search(cluster)) return gave_up_ ? Verdict::Undecided : Verdict::Impossible;
    return Verdict::Found;
  }

  // ---- Stages 1 and 2: what has no alternative ----------------------------------------------------------

  bool match_single_candidates() {
    for (VertexId v = 0; v < a_.stars.vertex_count(); ++v) {
      if (!a_.stars.is_used(v)) continue;
      VertexId only = kNone;
      bool is_ambiguous = false;
      const bool saw_all = nearby_.visit(a_.positions[v], a_.colours[v], reach_, 64, [&](VertexId candidate) {
        is_ambiguous = only != kNone;
        only = candidate;
        return !is_ambiguous;
      });
      if (!saw_all || is_ambiguous) continue;
      if (only == kNone || !match(v, only)) return blame(v, only != kNone);
    }
    return true;
  }

  bool follow_all_matched() {
    matched_.clear();
    for (VertexId v = 0; v < a_.stars.vertex_count(); ++v)
      if (image_[v] != kNone && has_open_triangle(v)) matched_.push_back(v);
    return follow_matched(0) || blame(last_followed_, true);
  }

  bool has_open_triangle(VertexId v) const {
    return std::ranges::any_of(
        a_.stars.at(v), [&](const Spoke& s) { return image_[s.next] == kNone || image_[s.third] == kNone; });
  }

  bool may_match(VertexId v, VertexId w) const {
    return a_.colours[v] == b_.colours[w] && max_norm(a_.positions[v], b_.positions[w]) <= reach_;
  }

  /// Gives `v` the image `w`, or says that it cannot have it.
  bool match(VertexId v, VertexId w) {
    if (image_[v] == w) return true;
    if (image_[v] != kNone || preimage_[w] != kNone || !may_match(v, w)) return false;
    image_[v] = w;
    preimage_[w] = v;
    matched_.push_back(v);
    return true;
  }

  /// Draws all conclusions from the matches on the trail after `done`. False where two contradict.
  bool follow_matched(std::size_t done) {
    for (; done < matched_.size(); ++done) {
      const VertexId v = last_followed_ = matched_[done];
      for (const Spoke& s : a_.stars.at(v)) {
        if (image_[s.next] != kNone && !follow_edge(v, s.next)) return false;
        if (image_[s.third] != kNone && !follow_edge(s.third, v)) return false;
      }
    }
    return true;
  }

  /// The triangles that walk a matched edge must be those that walk its image.
  bool follow_edge(VertexId from, VertexId to) {
    --steps_left_;
    const auto here = a_.stars.on_edge(from, to);
    const auto there = b_.stars.on_edge(image_[from], image_[to]);
    if (here.size() != there.size()) return false;
    if (here.size() == 1) return match(here[0].third, there[0].third);
    return follow_crowded_edge(here, there);
  }

  /// Several triangles walk the same edge the same way: a non-manifold edge, or copies of a triangle.
  bool follow_crowded_edge(std::span<const Spoke> here, std::span<const Spoke> there) {
    for (std::size_t i = 0; i < here.size(); ++i) {
      const VertexId third = here[i].third;
      if (i > 0 && here[i - 1].third == third) continue;
      const auto copies = std::ranges::count(here, third, &Spoke::third);
      if (image_[third] != kNone) {
        if (std::ranges::count(there, image_[third], &Spoke::third) != copies) return false;
        continue;
      }
      if (here.size() > 32) continue;  // quadratic; the search sees to these
      VertexId only = kNone;
      int candidates = 0;
      for (std::size_t j = 0; j < there.size(); ++j) {
        const VertexId candidate = there[j].third;
        if (j > 0 && there[j - 1].third == candidate) continue;
        if (preimage_[candidate] != kNone || !may_match(third, candidate)) continue;
        if (std::ranges::count(there, candidate, &Spoke::third) != copies) continue;
        only = candidate;
        ++candidates;
      }
      if (candidates == 0 || (candidates == 1 && !match(third, only))) return false;
    }
    return true;
  }

  // ---- Stage 3: clusters --------------------------------------------------------------------------------

  void gather_clusters() {
    for (VertexId v = 0; v < a_.stars.vertex_count(); ++v) {
      if (!a_.stars.is_used(v) || image_[v] != kNone || cluster_of_vertex_[v] != kNone) continue;
      const auto id = static_cast<std::uint32_t>(clusters_.size());
      clusters_.push_back(flood(v));
      for (VertexId w : clusters_.back()) cluster_of_vertex_[w] = id;
    }
  }

  /// The unmatched vertices that triangles between unmatched vertices connect to `start`, breadth first.
  std::vector<VertexId> flood(VertexId start) {
    ++flood_;
    std::vector<VertexId> found = {start};
    flooded_in_[start] = flood_;
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (const Spoke& s : a_.stars.at(found[i])) {
        for (VertexId w : {s.next, s.third}) {
          if (image_[w] != kNone || flooded_in_[w] == flood_) continue;
          flooded_in_[w] = flood_;
          found.push_back(w);
        }
      }
    }
    return found;
  }

  /// Finds images for a whole cluster, or says that there are none (or gives up, see gave_up_).
  bool search(std::uint32_t cluster) {
    const VertexId anchor = best_anchor(clusters_[cluster]);
    clusters_[cluster] = flood(anchor);  // so that each further vertex is met beside an earlier one
    if (take_nearest_free_place(cluster) || take_place_from_others(cluster)) return true;
    gave_up_ |= steps_left_ < 0;
    return blame(anchor, true);
  }

  /// The nearest place counts every vertex, so after quantisation it is the one that the cluster came
  /// from, or coincides with that, and nobody is left without.
  bool take_nearest_free_place(std::uint32_t cluster) {
    const std::vector<VertexId>& vertices = clusters_[cluster];
    double nearest = std::numeric_limits<double>::infinity();
    Images best;
    for (const Option& option : options_of_anchor(vertices[0])) {
      if (option.distance >= nearest || (!best.empty() && vertices.size() > kLargeCluster)) break;
      if (preimage_[option.images[0]] != kNone) continue;
      Images images = try_place(vertices, option);
      const double distance = distance_to(vertices, images);
      if (!images.empty() && distance < nearest) nearest = distance, best = std::move(images);
    }
    assign(vertices, best);
    return !best.empty();
  }

  /// An augmenting path [Berge 1957] over clusters and places, breadth first: somebody takes a free place,
  /// whose old place somebody else takes, and so on back to `cluster`. That none exists is a proof.
  bool take_place_from_others(std::uint32_t cluster) {
    struct Wish {
      std::uint32_t cluster;  // would take a place ...
      Images images;          // ... which is here
    };
    std::unordered_map<std::uint32_t, Wish> wish_for_place_of;
    std::vector<std::uint32_t> reached = {cluster};
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const std::uint32_t seeker = reached[i];
      for (const Option& option : options_of_anchor(clusters_[seeker][0])) {
        const VertexId held_for = preimage_[option.images[0]];
        const std::uint32_t holder = held_for == kNone ? kNone : cluster_of_vertex_[held_for];
        if (holder == seeker || wish_for_place_of.contains(holder)) continue;
        const Images of_seeker = lift(seeker), of_holder = lift(holder);
        Images images = try_place(clusters_[seeker], option);
        put_back(seeker, of_seeker);
        put_back(holder, of_holder);
        if (images.empty()) continue;
        wish_for_place_of[holder] = {seeker, std::move(images)};
        if (holder != kNone) {
          reached.push_back(holder);
          continue;
        }
        for (std::uint32_t granted = kNone; granted != cluster;) {
          const Wish& wish = wish_for_place_of[granted];
          lift(wish.cluster);
          granted = wish.cluster;
          assign(clusters_[granted], wish.images);
        }
        return true;
      }
    }
    return false;
  }

  /// Takes a cluster's images away; put_back() with the returned ones undoes it. Both ignore kNone.
  Images lift(std::uint32_t cluster) {
    Images images;
    if (cluster == kNone || image_[clusters_[cluster][0]] == kNone) return images;
    for (VertexId v : clusters_[cluster]) {
      images.push_back(image_[v]);
      preimage_[image_[v]] = kNone;
      image_[v] = kNone;
    }
    return images;
  }

  void put_back(std::uint32_t cluster, const Images& images) {
    if (!images.empty()) assign(clusters_[cluster], images);
  }

  void assign(const std::vector<VertexId>& vertices, const Images& images) {
    for (std::size_t i = 0; i < images.size(); ++i) {
      image_[vertices[i]] = images[i];
      preimage_[images[i]] = vertices[i];
    }
  }

  /// The images that follow from one choice for the first vertex of an unmatched cluster; empty if there are
  /// none. Changes nothing.
  Images try_place(const std::vector<VertexId>& vertices, const Option& first) {
    Images images;
    matched_.clear();
    if (extend(vertices, first))
      for (VertexId v : vertices) images.push_back(image_[v]);
    undo_to(0);
    return images;
  }

  double distance_to(const std::vector<VertexId>& vertices, const Images& images) const {
    double largest = 0;
    for (std::size_t i = 0; i < images.size(); ++i)
      largest = std::max(largest, max_norm(a_.positions[vertices[i]], b_.positions[images[i]]));
    return largest;
  }

  /// Finds images for a whole cluster, given one for its first vertex. Leaves no match behind if it fails.
  bool extend(const std::vector<VertexId>& vertices, const Option& first) {
    std::vector<Choice> choices;
    choices.push_back({{first}});
    while (!choices.empty()) {
      if (!take_next_option(choices.back())) {
        choices.pop_back();
        continue;
      }
      std::size_t reached = choices.back().reached_before;
      Option open;
      if (!find_open_triangle(vertices, reached, open)) return true;
      choices.push_back({options_of_triangle(vertices[reached], open), 0, matched_.size(), reached});
    }
    return false;
  }

  /// Tries the options of a choice in turn, each from the state before it, until one meets no contradiction.
  bool take_next_option(Choice& choice) {
    while (choice.next_option < choice.options.size() && steps_left_ >= 0) {
      undo_to(choice.matched_before);
      const Option& option = choice.options[choice.next_option++];
      if (take(option) && follow_matched(choice.matched_before)) return true;
    }
    undo_to(choice.matched_before);
    return false;
  }

  bool take(const Option& option) {
    --steps_left_;
    for (int k = 0; k < 2 && option.vertices[k] != kNone; ++k)
      if (!match(option.vertices[k], option.images[k])) return false;
    return true;
  }

  void undo_to(std::size_t size) {
    for (; matched_.size() > size; matched_.pop_back()) {
      preimage_[image_[matched_.back()]] = kNone;
      image_[matched_.back()] = kNone;
    }
  }

  /// The vertex with the fewest candidates, among the first few.
  VertexId best_anchor(const std::vector<VertexId>& vertices) {
    VertexId best = vertices[0];
    int fewest = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < std::min<std::size_t>(vertices.size(), 1000) && fewest > 1; ++i) {
      int candidates = 0;
      nearby_.visit(a_.positions[vertices[i]], a_.colours[vertices[i]], reach_, 64,
                    [&](VertexId) { return ++candidates < fewest; });
      if (candidates < fewest) fewest = candidates, best = vertices[i];
    }
    return best;
  }

  /// The images the anchor may have, unless matched without alternative; nearest first.
  std::vector<Option> options_of_anchor(VertexId anchor) {
    std::vector<Option> options;
    const Vec3& p = a_.positions[anchor];
    const bool saw_all = nearby_.visit(p, a_.colours[anchor], reach_, kMostCandidates, [&](VertexId w) {
      --steps_left_;
      if (preimage_[w] == kNone || cluster_of_vertex_[preimage_[w]] != kNone)
        options.push_back({{anchor, kNone}, {w, kNone}, max_norm(p, b_.positions[w])});
      return true;
    });
    if (!saw_all) gave_up_ = true;
    std::ranges::stable_sort(options, {}, &Option::distance);
    return options;
  }

  /// From vertices[reached] on, the first triangle of the cluster with an unmatched vertex. False if none.
  bool find_open_triangle(const std::vector<VertexId>& vertices, std::size_t& reached, Option& open) {
    for (; reached < vertices.size(); ++reached) {
      for (const Spoke& s : a_.stars.at(vertices[reached])) {
        if (image_[s.next] != kNone && image_[s.third] != kNone) continue;
        open.vertices = {s.next, s.third};
        return true;
      }
    }
    return false;
  }

  /// The triangles around the image of `hub` that may be the image of (hub, open.vertices).
  std::vector<Option> options_of_triangle(VertexId hub, const Option& open) {
    std::vector<Option> options;
    const auto fits = [&](VertexId v, VertexId w) {
      return image_[v] != kNone ? image_[v] == w : preimage_[w] == kNone && may_match(v, w);
    };
    const auto star = b_.stars.at(image_[hub]);
    steps_left_ -= static_cast<std::int64_t>(star.size());
    for (std::size_t i = 0; i < star.size(); ++i) {
      if (i > 0 && star[i - 1] == star[i]) continue;
      if (!fits(open.vertices[0], star[i].next) || !fits(open.vertices[1], star[i].third)) continue;
      Option option{open.vertices, {star[i].next, star[i].third}};
      for (int k = 0; k < 2; ++k) {
        const double d = max_norm(a_.positions[option.vertices[k]], b_.positions[option.images[k]]);
        option.distance = std::max(option.distance, d);
      }
      options.push_back(option);
    }
    std::ranges::stable_sort(options, {}, &Option::distance);
    return options;
  }

  bool blame(VertexId v, bool has_candidates) {
    culprit_ = v;
    culprit_has_candidates_ = has_candidates;
    return false;
  }

  static constexpr int kMostCandidates = 100'000;
  static constexpr std::size_t kLargeCluster = 1000;  // takes the first place that fits, not the nearest

  const MatchSide& a_;
  const MatchSide& b_;
  const double reach_;
  NearbyVertices nearby_;
  std::vector<VertexId> image_, preimage_;
  std::vector<VertexId> matched_;  // the trail: vertices of a in the order they were matched
  VertexId last_followed_ = kNone;

  std::vector<std::vector<VertexId>> clusters_;
  std::vector<std::uint32_t> cluster_of_vertex_;  // kNone: matched without alternative
  std::vector<std::uint32_t> flooded_in_;
  std::uint32_t flood_ = 0;
  std::int64_t steps_left_;
  bool gave_up_ = false;

  VertexId culprit_ = kNone;
  bool culprit_has_candidates_ = false;
};

}  // namespace

VertexMatching match_vertices(const MatchSide& a, const MatchSide& b, double tolerance) {
  return Matcher(a, b, tolerance).run();
}

}  // namespace selvage
