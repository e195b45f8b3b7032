// SPDX-License-Identifier: MIT
#include "server/app/simplify_command.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/base/progress_line.h"
#include "common/base/stop_on_interrupt.h"
#include "common/mesh_io/read_mesh.h"
#include "common/mesh_io/write_mesh.h"
#include "server/simplify/simplify_soup.h"

namespace selvage {
namespace {

LevelTarget target_of(const SimplifyCommand& command, std::size_t file_triangles) {
  LevelTarget target;
  if (command.ratio) {
    target.triangles = static_cast<std::uint32_t>(std::llround(*command.ratio * double(file_triangles)));
  }
  if (command.triangles) target.triangles = std::max(target.triangles, *command.triangles);
  if (command.error) target.max_deviation = *command.error;
  return target;
}

double diagonal_of(const TriangleSoup& soup) {
  if (soup.positions.empty()) return 0;
  Vec3 low = soup.positions[0], high = low;
  for (const Vec3& p : soup.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  return length(high - low);
}

void print_notes(const SimplifiedSoup& result, const LevelTarget& target, const std::string& file) {
  const auto note = [&](std::uint32_t count, const char* what) {
    if (count > 0) fmt::print(stderr, "{}: {} {}\n", file, count, what);
  };
  note(result.repair.dropped_triangles, "triangles with a repeated vertex dropped");
  note(result.repair.unreferenced_vertices, "vertices that no triangle uses dropped");
  note(result.pinned_vertices, "places at non-manifold vertices, which do not move");
  if (result.soup.triangles.size() > target.triangles && std::isinf(target.max_deviation)) {
    fmt::print(stderr, "{}: no further collapse keeps the surface as it is connected\n", file);
  }
}

void print_result(const SimplifyCommand& command, const TriangleSoup& input, const SimplifiedSoup& result,
                  double seconds) {
  const double diagonal = diagonal_of(input);
  const double percent = diagonal > 0 ? 100 * result.deviation / diagonal : 0;
  if (command.json) {
    nlohmann::ordered_json json = {
        {"output", command.output.string()},         {"input_vertices", input.positions.size()},
        {"input_triangles", input.triangles.size()}, {"vertices", result.soup.positions.size()},
        {"triangles", result.soup.triangles.size()}, {"pinned_vertices", result.pinned_vertices}};
    if (command.options.measures_deviation) {
      json["deviation"] = result.deviation;
      json["deviation_percent_of_diagonal"] = percent;
    }
    json["seconds"] = seconds;
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print(
      "{}\n  {} of {} triangles ({:.2f} %), {} of {} vertices\n", command.output.string(),
      result.soup.triangles.size(), input.triangles.size(),
      100.0 * double(result.soup.triangles.size()) / double(std::max<std::size_t>(input.triangles.size(), 1)),
      result.soup.positions.size(), input.positions.size());
  if (command.options.measures_deviation) {
    fmt::print("  deviation {:.4g} ({:.4f} % of the diagonal)\n", result.deviation, percent);
  }
  fmt::print("  {:.3f} s\n", seconds);
}

}  // namespace

Result<void> run(const SimplifyCommand& command) {
  if (!command.ratio && !command.triangles && !command.error) {
    return fail(ErrorCode::InvalidArgument, "give --ratio, --triangles or --error");
  }
  auto file = read_mesh(command.model);
  if (!file) return forward_error(file);
  for (const std::string& note : file->notes) fmt::print(stderr, "{}: {}\n", command.model.string(), note);

  const LevelTarget target = target_of(command, file->soup.triangles.size());
  ProgressLine line;
  const StopOnInterrupt interrupt;
  const auto begin = std::chrono::steady_clock::now();
  auto result = simplify_soup(file->soup, target, command.options, [&](double done) {
    line.show(fmt::format("simplify {:.0f} %", 100 * done));
    return !interrupt.token().stop_requested();
  });
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  line.wipe();
  if (!result) return forward_error(result, command.model.string());
  if (auto ok = write_mesh(command.output, result->soup); !ok) return forward_error(ok);
  print_notes(*result, target, command.model.string());
  print_result(command, file->soup, *result, seconds.count());
  return {};
}

}  // namespace selvage
