// SPDX-License-Identifier: MIT
#include "server/ingest/repair_notes.h"

namespace selvage {

std::vector<std::string> notes_of(const RepairReport& report) {
  std::vector<std::string> notes;
  const auto note = [&](std::uint32_t count, const char* one, const char* many, const char* what) {
    if (count > 0) notes.push_back(std::to_string(count) + ' ' + (count == 1 ? one : many) + ' ' + what);
  };
  note(report.dropped_triangles, "triangle", "triangles", "with a repeated vertex dropped");
  note(report.unreferenced_vertices, "vertex", "vertices", "that no triangle uses dropped");
  note(report.duplicate_triangles, "triangle", "triangles", "that repeat another kept");
  note(report.zero_area_triangles, "triangle", "triangles", "without area kept");
  note(report.turned_triangles, "triangle", "triangles", "turned for coding; clients turn them back");
  note(report.vertex_copies, "copy", "copies",
       "of vertices made at non-manifold spots; clients weld them again");
  return notes;
}

}  // namespace selvage
