// SPDX-License-Identifier: MIT
#include "server/publish/publish_options.h"

#include <charconv>

namespace selvage {
namespace {

SegmentMode to_segment_mode(PublishCut::Mode mode) {
  switch (mode) {
    case PublishCut::Mode::Classic:
      return SegmentMode::Classic;
    case PublishCut::Mode::Zhang:
      return SegmentMode::Zhang;
    case PublishCut::Mode::ManganWhitaker:
      return SegmentMode::ManganWhitaker;
    case PublishCut::Mode::Cad:
      return SegmentMode::Cad;
    case PublishCut::Mode::Xmrg:
      break;
  }
  return SegmentMode::Xmrg;
}

Result<Parts> parts_by(PublishCut::By by, const MeshFile& file) {
  switch (by) {
    case PublishCut::By::Groups:
      return parts_of_groups(file);
    case PublishCut::By::Components:
      return parts_of_components(file.soup);
    case PublishCut::By::Shape:
      break;
  }
  return Parts{};
}

}  // namespace

Result<IngestOptions> ingest_options(const Publish& request, const MeshFile& file) {
  auto parts = parts_by(request.cut.by, file);
  if (!parts) return forward_error(parts);
  IngestOptions options;
  options.name = request.name;
  options.units = request.units;
  options.bits = request.bits;
  options.lossless = request.lossless;
  options.parts = std::move(*parts);
  options.segment.mode = to_segment_mode(request.cut.mode);
  options.segment.target_regions = request.cut.regions;
  options.segment.min_region_vertices = request.cut.min_region;
  options.segment.max_region_vertices = request.cut.max_region;
  options.segment.smooth = request.cut.smooth;
  options.levels = level_goals(request.cut.levels, request.cut.level_ratios, request.cut.level_errors);
  return options;
}

std::string to_text(const PublishCut& cut) {
  if (cut == PublishCut{}) return {};
  std::string text;
  const auto add = [&](const auto... values) { ((text += std::to_string(values) + ' '), ...); };
  add(unsigned(cut.by), unsigned(cut.mode), cut.regions, cut.min_region, cut.max_region, unsigned(cut.smooth),
      cut.levels);
  for (const auto* list : {&cut.level_ratios, &cut.level_errors}) {
    text += "; ";
    for (const double value : *list) {
      char digits[32];
      text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr) += ' ';
    }
  }
  return text;
}

}  // namespace selvage
