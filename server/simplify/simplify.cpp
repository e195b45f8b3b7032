// SPDX-License-Identifier: MIT
#include "server/simplify/simplify.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "server/simplify/boundary_flips.h"
#include "server/simplify/bridge_links.h"
#include "server/simplify/collapse_mesh.h"
#include "server/simplify/costs.h"
#include "server/simplify/legality.h"
#include "server/simplify/quadrics.h"
#include "server/simplify/removed_points.h"
#include "server/simplify/vertex_classes.h"
#include "server/simplify/vertex_queue.h"

namespace selvage {
namespace {

constexpr std::uint32_t kStepsBetweenReports = 4096;
/// Far from the goal, collapses may be so much dearer than the cheapest. What comes too early is made up for
/// by the time that the rest is as dear, so the last stretch is in strict order: so many times the goal.
constexpr double kPatience = 1.5;
constexpr double kExactFrom = 1.3;

double mean_area_of(const CornerTable& mesh, std::span<const Vec3> positions) {
  double sum = 0;
  for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
    const auto [a, b, c] = mesh.triangle(t);
    sum += length(cross(positions[b] - positions[a], positions[c] - positions[a])) / 2;
  }
  return mesh.triangle_count() > 0 ? sum / mesh.triangle_count() : 0;
}

/// The state between two collapses. A queued vertex is
///   Dirty   its star has changed since it was priced: its key and target mean nothing;
///   Priced  its key is the cost of its best legal target;
///   Gated   the deviation of that target is known and in the key.
/// A vertex without legal target is not queued; it is looked at again when its star changes. Only the link
/// condition can fail on a vertex that is not dirty, as it depends on the target's star too: it is asked
/// again before the collapse.
class Run {
 public:
  Run(const SimplifyInput& input, const SimplifyOptions& options, std::uint32_t last_target,
      const SimplifyProgress& progress);

  void reach(const LevelTarget& target);
  Simplification take() { return std::move(result_); }

 private:
  enum class State : std::uint8_t { Dirty, Priced, Gated };

  void price(VertexId u);
  double cost_of(std::uint32_t place) const;
  bool keeps_shape(std::uint32_t place) const;
  bool keeps_links(std::uint32_t place);
  bool is_through_gate(VertexId u, std::uint32_t place, double max_squared_deviation);
  void step(double max_squared_deviation);
  void collapse(std::uint32_t place);
  void close_level();
  bool is_to_stop();

  const SimplifyInput& input_;
  const SimplifyOptions options_;
  const FlipTest flip_;
  const double mean_area_;
  const std::vector<VertexClass> class_of_vertex_;
  CollapseMesh mesh_;
  RemovedPoints points_;
  BridgeLinks bridges_;
  BoundaryFlips flips_;
  std::optional<Quadrics> quadrics_;

  VertexQueue queue_;
  std::vector<VertexId> target_of_vertex_;
  std::vector<State> state_of_vertex_;
  std::vector<double> squared_deviation_of_vertex_;  // of the target; only while Gated
  std::vector<VertexId> parked_;                     // would deviate too much for the level in hand

  double largest_squared_deviation_ = 0;
  Simplification result_;

  const std::uint32_t last_target_;
  const SimplifyProgress& progress_;
  std::uint32_t steps_ = 0;
  bool is_stopped_ = false;

  struct Candidate {
    double cost;
    std::uint32_t place;
  };
  // Scratch: the star in hand, its candidates, its ring while others are gathered.
  Star star_;
  std::vector<Candidate> candidates_;
  std::vector<VertexId> touched_;
  Stamps stamps_;
};

Run::Run(const SimplifyInput& input, const SimplifyOptions& options, std::uint32_t last_target,
         const SimplifyProgress& progress)
    : input_(input),
      options_(options),
      flip_(options.flip.value_or(options.cost == CollapseCost::EdgeArea ? FlipTest::Concave
                                                                         : FlipTest::Normal)),
      mean_area_(mean_area_of(input.mesh, input.positions)),
      class_of_vertex_(classify_vertices(input.mesh, input.region_of_vertex, input.pinned)),
      mesh_(input.mesh),
      points_(input.mesh.triangle_count(), input.positions),
      bridges_(input.mesh, input.region_of_vertex),
      flips_(input.mesh, input.positions, input.region_of_vertex, mean_area_),
      queue_(input.mesh.vertex_count()),
      target_of_vertex_(input.mesh.vertex_count(), kNone),
      state_of_vertex_(input.mesh.vertex_count(), State::Dirty),
      squared_deviation_of_vertex_(input.mesh.vertex_count(), 0),
      last_target_(last_target),
      progress_(progress),
      stamps_(input.mesh.vertex_count()) {
  if (options.cost == CollapseCost::Quadric) quadrics_.emplace(input.mesh, input.positions);
  for (VertexId v = 0; v < input.mesh.vertex_count() && !is_to_stop(); ++v) price(v);
  close_level();
}

/// Finds the cheapest legal collapse of u and queues it; without one, u leaves the queue.
void Run::price(VertexId u) {
  const VertexClass vertex_class = class_of_vertex_[u];
  if (vertex_class == VertexClass::Pinned || mesh_.table().corner_of_vertex[u] == kNone) return;
  state_of_vertex_[u] = State::Priced;
  star_.gather(mesh_.table(), input_.positions, u);
  candidates_.clear();
  for (std::uint32_t place = 0; place < star_.ring_size(); ++place) {
    if (is_allowed(vertex_class, input_.region_of_vertex, star_, place)) {
      candidates_.push_back({cost_of(place), place});
    }
  }
  // The cheapest is most often legal, so they are not sorted.
  while (!candidates_.empty()) {
    const auto least =
        std::min_element(candidates_.begin(), candidates_.end(),
                         [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
    if (keeps_shape(least->place) && keeps_links(least->place)) {
      target_of_vertex_[u] = star_.ring[least->place];
      queue_.set(u, least->cost);
      return;
    }
    candidates_.erase(least);
  }
  if (queue_.contains(u)) queue_.remove(u);
}

double Run::cost_of(std::uint32_t place) const {
  switch (options_.cost) {
    case CollapseCost::EdgeArea:
      return edge_area_cost(star_, place, mean_area_);
    case CollapseCost::Quadric:
      return quadrics_->cost(star_.centre, star_.ring[place]);
    case CollapseCost::PlaneDistance:
      break;
  }
  return plane_distance_cost(star_, place, mean_area_);
}

bool Run::keeps_shape(std::uint32_t place) const {
  return flip_ == FlipTest::Normal ? keeps_normals(star_, place) : keeps_convexity(star_, place);
}

bool Run::keeps_links(std::uint32_t place) {
  if (!keeps_manifold(mesh_.table(), star_, place, stamps_)) return false;
  return class_of_vertex_[star_.centre] != VertexClass::Chain ||
         (keeps_region(mesh_.table(), input_.region_of_vertex, star_, place) &&
          bridges_.keep_one_common_neighbour(star_.centre, star_.ring[place], stamps_) &&
          flips_.keep_normals(star_.centre, star_.ring[place], bridges_.published()));
}

/// Measures u's deviation if it is not known. False if u has to wait: parked for this level, or behind
/// others.
bool Run::is_through_gate(VertexId u, std::uint32_t place, double max_squared_deviation) {
  double& deviation = squared_deviation_of_vertex_[u];
  if (state_of_vertex_[u] != State::Gated) {
    deviation = points_.squared_deviation(star_, place);
    state_of_vertex_[u] = State::Gated;
    const double gate = deviation * star_weight(star_, mean_area_);
    if (options_.cost == CollapseCost::PlaneDistance && gate > queue_.key(u)) queue_.set(u, gate);
  }
  if (deviation > max_squared_deviation) {
    queue_.remove(u);
    parked_.push_back(u);
    return false;
  }
  return queue_.top() == u;
}

void Run::step(double max_squared_deviation) {
  const VertexId u = queue_.top();
  if (state_of_vertex_[u] == State::Dirty) return price(u);
  star_.gather(mesh_.table(), input_.positions, u);
  const std::uint32_t place = star_.place_of(target_of_vertex_[u]);
  if (!keeps_links(place)) return price(u);
  if (options_.measures_deviation && !is_through_gate(u, place, max_squared_deviation)) return;
  collapse(place);
}

/// Collapses the star in hand.
void Run::collapse(std::uint32_t place) {
  const VertexId u = star_.centre, v = star_.ring[place];
  if (options_.measures_deviation) points_.collapse(star_, place);
  if (quadrics_) quadrics_->collapse(u, v);
  bridges_.collapse(u, v);
  flips_.collapse(u, v);
  mesh_.collapse(star_, place);
  queue_.remove(u);
  const double squared_deviation = options_.measures_deviation ? squared_deviation_of_vertex_[u] : 0;
  largest_squared_deviation_ = std::max(largest_squared_deviation_, squared_deviation);
  result_.collapses.push_back({u, v, std::sqrt(squared_deviation)});

  touched_ = star_.ring;
  for (const VertexId w : touched_) {
    if (queue_.contains(w)) {
      state_of_vertex_[w] = State::Dirty;
    } else {
      price(w);
    }
  }
}

/// Pricing the vertices at first takes a quarter of the time.
bool Run::is_to_stop() {
  if (!progress_ || ++steps_ % kStepsBetweenReports != 0) return is_stopped_;
  const double all = input_.mesh.triangle_count() - std::min(last_target_, input_.mesh.triangle_count());
  const double gone = input_.mesh.triangle_count() - mesh_.triangle_count();
  const double priced = steps_ < input_.mesh.vertex_count() ? double(steps_) / input_.mesh.vertex_count() : 1;
  is_stopped_ = is_stopped_ || !progress_(0.25 * priced + (all > 0 ? 0.75 * gone / all : 0));
  return is_stopped_;
}

void Run::reach(const LevelTarget& target) {
  for (const VertexId v : std::exchange(parked_, {})) {
    if (!queue_.contains(v)) price(v);
  }
  const double max_squared_deviation = target.max_deviation * target.max_deviation;
  bool is_patient = false;
  while (mesh_.triangle_count() > target.triangles && !queue_.is_empty() && !is_to_stop()) {
    const bool is_far = mesh_.triangle_count() > kExactFrom * target.triangles;
    if (is_patient != is_far) queue_.set_patience((is_patient = is_far) ? kPatience : 1);
    step(max_squared_deviation);
  }
  queue_.set_patience(1);
  close_level();
}

void Run::close_level() {
  const auto count = static_cast<std::uint32_t>(result_.collapses.size());
  const bool is_new = !result_.levels.empty() && result_.levels.back().collapses != count;
  if (is_new && !input_.region_of_vertex.empty()) {
    bridges_.publish(representatives_after(result_.collapses, count, input_.mesh.vertex_count()));
  }
  result_.levels.push_back({count, mesh_.triangle_count(), std::sqrt(largest_squared_deviation_)});
}

}  // namespace

Simplification simplify(const SimplifyInput& input, std::span<const LevelTarget> targets,
                        const SimplifyOptions& options, const SimplifyProgress& progress) {
  Run run(input, options, targets.empty() ? 0 : targets.back().triangles, progress);
  for (const LevelTarget& target : targets) run.reach(target);
  return run.take();
}

std::vector<VertexId> representatives_after(std::span<const Collapse> collapses, std::uint32_t count,
                                            std::uint32_t vertex_count) {
  std::vector<VertexId> representative(vertex_count);
  std::iota(representative.begin(), representative.end(), 0u);
  // Backwards, where a collapse leads is known: it goes later, or stays.
  for (std::uint32_t i = count; i-- > 0;) representative[collapses[i].from] = representative[collapses[i].to];
  return representative;
}

}  // namespace selvage
