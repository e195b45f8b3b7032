// SPDX-License-Identifier: MIT
#include "bench/simplify/layered/split_plan.h"

#include <algorithm>
#include <array>

#include "server/simplify/star.h"

namespace selvage::bench {
namespace {

/// A collapse while it is not known yet what comes after it.
struct Step {
  PlannedSplit split;
  VertexId to;
  std::array<TriangleId, 4> at_edges;  ///< kNone past a border
  std::vector<TriangleId> run;
};

Step noted(const Star& star, std::uint32_t place) {
  Step step{{.from = star.centre}, star.ring[place], {}, {}};
  const std::uint32_t after = star.triangle_after(place), before = star.triangle_before(place);
  if (after != kNone) step.split.before = star.corners[after];
  if (before != kNone) step.split.after = star.corners[before];
  if (!star.is_closed) step.split.kind = after != kNone ? SplitKind::AtEnd : SplitKind::AtStart;
  const std::uint32_t begin = after == kNone ? 0 : after + 1;
  const std::uint32_t size = star.size() - star.triangles_at_edge(place);
  if (size == 0) return step;
  for (std::uint32_t i = 0; i < size; ++i)
    step.run.push_back(triangle_of(star.corners[(begin + i) % star.size()]));
  step.split.first = star.corners[begin % star.size()];
  step.split.last = star.corners[(begin + size - 1) % star.size()];
  return step;
}

/// What lies at the edges that closed. Of an ear, which takes no corner, the run is the one beside it.
void note_edges(const CornerTable& mesh, CornerId beyond_ear, Step& step) {
  const auto beyond = [&](CornerId c) {
    return mesh.opposite[c] == kNone ? kNone : triangle_of(mesh.opposite[c]);
  };
  if (step.run.empty()) {
    step.split.first = step.split.last =
        step.split.kind == SplitKind::AtEnd ? prev(beyond_ear) : next(beyond_ear);
    step.split.is_ear = true;
    step.at_edges = {triangle_of(beyond_ear), kNone, kNone, kNone};
    return;
  }
  step.at_edges = {triangle_of(step.split.first), triangle_of(step.split.last), kNone, kNone};
  if (step.split.kind != SplitKind::AtStart) step.at_edges[2] = beyond(prev(step.split.first));
  if (step.split.kind != SplitKind::AtEnd) step.at_edges[3] = beyond(next(step.split.last));
}

/// Turns the collapses of one layer round, and lets each wait for what it needs.
std::vector<PlannedSplit> turned(std::vector<Step>& steps, const CornerTable& finest) {
  const auto count = static_cast<std::uint32_t>(steps.size());
  std::vector<std::uint32_t> maker_of_triangle(finest.triangle_count(), kNone),
      maker_of_vertex(finest.vertex_count(), kNone);
  std::vector<PlannedSplit> splits;
  std::vector<VertexId> vertex_of_split;
  for (std::uint32_t i = 0; i < count; ++i) {
    Step& step = steps[count - 1 - i];
    std::vector<std::uint32_t> makers;
    for (const TriangleId t : step.at_edges)
      if (t != kNone) makers.push_back(maker_of_triangle[t]);
    for (const TriangleId t : step.run) {
      const std::uint32_t maker = maker_of_triangle[t];
      if (maker != kNone && vertex_of_split[maker] == step.to) makers.push_back(maker);
    }
    makers.push_back(maker_of_vertex[step.to]);
    std::sort(makers.begin(), makers.end());
    makers.erase(std::unique(makers.begin(), makers.end()), makers.end());
    if (!makers.empty() && makers.back() == kNone) makers.pop_back();
    for (const std::uint32_t maker : makers) splits[maker].lets.push_back(i);
    step.split.waits_for = static_cast<std::uint32_t>(makers.size());
    for (const CornerId c : {step.split.before, step.split.after})
      if (c != kNone) maker_of_triangle[triangle_of(c)] = i;
    maker_of_vertex[step.split.from] = i;
    vertex_of_split.push_back(step.to);
    splits.push_back(std::move(step.split));
  }
  return splits;
}

/// Unlike CollapseMesh, also takes away ears: a border vertex's only triangle.
void collapse(CornerTable& mesh, const Star& star, std::uint32_t place) {
  const VertexId v = star.ring[place];
  std::vector<CornerId> nearby(star.corners);
  for (const CornerId c : star.corners) mesh.vertex_of_corner[c] = v;
  const std::uint32_t after = star.triangle_after(place), before = star.triangle_before(place);
  for (const std::uint32_t i : {after, before}) {
    if (i == kNone) continue;
    const CornerId c = star.corners[i];
    const CornerId outer = mesh.opposite[c], inner = mesh.opposite[i == after ? next(c) : prev(c)];
    if (outer != kNone) mesh.opposite[outer] = inner, nearby.push_back(outer);
    if (inner != kNone) mesh.opposite[inner] = outer, nearby.push_back(inner);
    for (const CornerId gone : {c, next(c), prev(c)})
      mesh.vertex_of_corner[gone] = mesh.opposite[gone] = kNone;
  }
  mesh.corner_of_vertex[star.centre] = kNone;
  // Any corner will do inside, at the border the most clockwise one.
  for (const CornerId one : nearby) {
    if (mesh.vertex(one) == kNone) continue;
    for (const CornerId c : {one, next(one), prev(one)}) {
      CornerId first = c;
      for (CornerId further = mesh.swing_cw(c); further != kNone && further != c;
           further = mesh.swing_cw(further))
        first = further;
      mesh.corner_of_vertex[mesh.vertex(c)] = first;
    }
  }
}

}  // namespace

std::vector<Layer> plan_layers(const CornerTable& finest, std::span<const Collapse> collapses,
                               std::span<const std::uint32_t> ends) {
  CornerTable mesh = finest;
  const std::vector<Vec3> nowhere(finest.vertex_count());
  std::vector<std::uint32_t> boundary_run(finest.vertex_count(), 0);
  for (VertexId v = 0; v < finest.vertex_count(); ++v) boundary_run[v] = finest.is_border_vertex(v);
  std::vector<Layer> layers;
  Star star;
  for (std::size_t level = 1; level < ends.size(); ++level) {
    std::vector<Step> steps;
    for (std::uint32_t i = ends[level - 1]; i < ends[level]; ++i) {
      star.gather(mesh, nowhere, collapses[i].from);
      const std::uint32_t place = star.place_of(collapses[i].to);
      Step step = noted(star, place);
      step.split.boundary_run = boundary_run[collapses[i].from];
      boundary_run[collapses[i].to] += step.split.boundary_run;
      const CornerId beyond_ear = mesh.opposite[star.corners[0]];
      collapse(mesh, star, place);
      note_edges(mesh, beyond_ear, step);
      steps.push_back(std::move(step));
    }
    layers.push_back({turned(steps, finest), mesh});
  }
  return layers;
}

}  // namespace selvage::bench
