// SPDX-License-Identifier: MIT
#include "common/pack/selection.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace selvage {
namespace {

constexpr std::size_t kMaxListedRegions = 1'000'000;

bool meets(const Grid& grid, const GridPoint& box_min, const GridPoint& box_max, const Box& box) {
  const Vec3 low = grid.position(box_min), high = grid.position(box_max);
  for (int axis = 0; axis < 3; ++axis) {
    if (high[axis] < box.min[axis] || low[axis] > box.max[axis]) return false;
  }
  return true;
}

/// For a region whose page has not been read, its page's box stands in.
bool meets(const Directory& directory, RegionId id, const Box& box) {
  const RegionEntry& entry = directory.regions[id];
  if (directory.has(id)) return meets(directory.grid, entry.box_min, entry.box_max, box);
  const PageEntry& page = directory.pages[page_of(id)];
  return meets(directory.grid, page.box_min, page.box_max, box);
}

std::vector<RegionId> all_regions(const Directory& directory) {
  std::vector<RegionId> regions(directory.real_region_count());
  std::iota(regions.begin(), regions.end(), RegionId{1});
  return regions;
}

bool touches_loose(const RegionEntry& entry) {
  return !entry.lower_neighbours.empty() && entry.lower_neighbours.front() == kLooseRegion;
}

/// Whether a selection brings a region's bundle. `is_selected` says which real regions it has.
template <class IsSelected>
bool is_bundle_sent(const Directory& directory, const Selection& selection, RegionId id,
                    const IsSelected& is_selected) {
  const RegionEntry& entry = directory.regions[id];
  if (selection.joins == Joins::None || entry.bundle.size == 0) return false;
  // Triangles of loose vertices alone belong to no real region: they go with the whole model.
  if (id == kLooseRegion) return selection.kind == Selection::Kind::All;
  const auto& below = entry.lower_neighbours;
  const bool touches_selected = std::any_of(below.begin(), below.end(), is_selected);
  return selection.joins == Joins::All ? is_selected(id) || touches_selected
                                       : is_selected(id) && (touches_selected || touches_loose(entry));
}

template <class T>
bool parse_number(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && !text.empty();
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  while (true) {
    const std::size_t at = text.find(separator);
    pieces.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return pieces;
    text.remove_prefix(at + 1);
  }
}

/// What is made of digits and dashes alone means numbers.
bool is_name(std::string_view piece) {
  if (piece.starts_with('=')) return piece.size() > 1;
  return piece.find_first_not_of("0123456789-") != std::string_view::npos;
}

Result<void> add_range(const RegionRange& range, std::vector<RegionId>& ids) {
  if (range.last - range.first >= kMaxListedRegions - ids.size()) {
    return fail(ErrorCode::LimitExceeded,
                "more than " + std::to_string(kMaxListedRegions) + " regions listed; use --all");
  }
  for (RegionId i = 0; i <= range.last - range.first; ++i) ids.push_back(range.first + i);
  return {};
}

/// By region; those that are not selected have one, too.
std::vector<std::uint8_t> levels_of(const Directory& directory, const Selection& selection) {
  std::vector<std::uint8_t> level_of_region(directory.regions.size(), selection.level);
  std::vector<bool> is_named(directory.regions.size(), false);
  for (const auto& [region, level] : selection.levels) {
    if (region >= directory.regions.size()) continue;
    std::uint8_t& chosen = level_of_region[region];
    chosen = is_named[region] ? std::min(chosen, level) : level;
    is_named[region] = true;
  }
  return level_of_region;
}

/// Takes "@2" off the end of a piece, if there is such a thing.
Result<std::optional<std::uint8_t>> take_level(std::string_view& piece) {
  const std::size_t at = piece.rfind('@');
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view digits = piece.substr(at + 1);
  if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  std::uint8_t level = 0;
  if (!parse_number(digits, level)) {
    return fail(ErrorCode::InvalidArgument,
                "'" + std::string(piece) + "': levels are numbers up to 255, 0 is the finest");
  }
  piece = piece.substr(0, at);
  return level;
}

/// How many letters must change to make one of the other, capitals aside; what follows the first 40 is not
/// looked at.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  constexpr std::size_t kMaxLetters = 40;
  a = a.substr(0, kMaxLetters), b = b.substr(0, kMaxLetters);
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i]) != lower(b[j]));
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// Shows all names where there are few, otherwise those most like it.
std::string unknown_name(const Directory& directory, const std::string& name) {
  constexpr std::size_t kShown = 10;
  std::string message = "no part is called '" + name + "'";
  if (directory.names.empty()) return message + "; this model has no names, only regions by number";
  const bool are_many = directory.names.size() > kShown;
  std::vector<std::pair<std::size_t, std::size_t>> shown;  // how unlike, place in the directory
  for (std::size_t i = 0; i < directory.names.size(); ++i)
    shown.emplace_back(are_many ? edit_distance(name, directory.names[i].name) : 0, i);
  std::sort(shown.begin(), shown.end());
  if (are_many) shown.resize(kShown);
  message += are_many ? "; most like it are " : "; there are ";
  for (std::size_t i = 0; i < shown.size(); ++i)
    message += (i > 0 ? ", " : "") + directory.names[shown[i].second].name;
  if (are_many) message += ", and " + std::to_string(directory.names.size() - kShown) + " others";
  return message;
}

}  // namespace

Result<std::vector<RegionId>> select_regions(const Directory& directory, const Selection& selection) {
  std::vector<RegionId> regions;
  switch (selection.kind) {
    case Selection::Kind::All:
      regions = all_regions(directory);
      break;
    case Selection::Kind::Ids:
      regions = selection.ids;
      break;
    case Selection::Kind::Box:
      for (RegionId id : all_regions(directory)) {
        if (meets(directory, id, selection.box)) regions.push_back(id);
      }
      break;
  }
  std::sort(regions.begin(), regions.end());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  for (RegionId id : regions) {
    if (id == kLooseRegion || id > directory.real_region_count()) {
      return fail(ErrorCode::NotFound, "no region " + std::to_string(id) +
                                           " in this model; it has regions 1 to " +
                                           std::to_string(directory.real_region_count()));
    }
    if (!directory.has(id)) {
      return fail(ErrorCode::InvalidArgument, "page " + std::to_string(page_of(id)) +
                                                  " of the directory, which lists region " +
                                                  std::to_string(id) + ", has not been read");
    }
  }
  return regions;
}

Result<std::vector<PartId>> select_parts(const Directory& directory, const Selection& selection) {
  auto regions = select_regions(directory, selection);
  if (!regions) return forward_error(regions);
  std::vector<bool> is_selected(directory.regions.size(), false);
  for (RegionId id : *regions) is_selected[id] = true;
  std::vector<bool> has_bundle(directory.regions.size(), false);
  for (RegionId id = 0; id < directory.regions.size(); ++id) {
    has_bundle[id] = is_bundle_sent(directory, selection, id,
                                    [&](RegionId r) { return r < is_selected.size() && is_selected[r]; });
  }

  const std::vector<std::uint8_t> level_of_region = levels_of(directory, selection);

  std::vector<PartId> parts;
  const RegionEntry& loose = directory.regions[kLooseRegion];
  bool needs_loose = has_bundle[kLooseRegion];
  for (RegionId id = 1; id < directory.regions.size(); ++id)
    needs_loose |= has_bundle[id] && touches_loose(directory.regions[id]);
  if (needs_loose && !loose.levels.empty()) parts.push_back({PartKind::Region, kLooseRegion, 0});
  for (RegionId id = 0; id < directory.regions.size(); ++id) {
    const RegionEntry& entry = directory.regions[id];
    if (is_selected[id]) {
      parts.push_back({PartKind::Region, id, entry.canonical_level(level_of_region[id])});
    }
    if (has_bundle[id]) parts.push_back({PartKind::Bundle, id, 0});
  }
  return parts;
}

SelectedParts::SelectedParts(const Directory& directory, Selection selection)
    : directory_(&directory), selection_(std::move(selection)) {
  std::ranges::sort(selection_.ids);
  // The finest of several levels of one region comes first.
  std::ranges::sort(selection_.levels, [](const auto& a, const auto& b) {
    return a.what != b.what ? a.what < b.what : a.level < b.level;
  });
}

bool SelectedParts::contains(const PartId& id) const {
  if (id.kind == PartKind::Page || id.region >= directory_->regions.size() || !directory_->has(id.region))
    return false;
  if (id.kind == PartKind::Bundle) {
    const auto& below = directory_->regions[id.region].lower_neighbours;
    return id.level == 0 && has_bundle(id.region) &&
           std::ranges::all_of(below, [&](RegionId r) { return directory_->has(r); });
  }
  if (id.region == kLooseRegion) return id.level == 0 && selection_.joins != Joins::None;
  const RegionEntry& entry = directory_->regions[id.region];
  return has_region(id.region) && id.level == entry.canonical_level(level_of(id.region));
}

bool SelectedParts::has_region(RegionId region) const {
  if (region == kLooseRegion || region >= directory_->regions.size() || !directory_->has(region))
    return false;
  if (selection_.kind == Selection::Kind::All) return true;
  if (selection_.kind == Selection::Kind::Ids) return std::ranges::binary_search(selection_.ids, region);
  return meets(*directory_, region, selection_.box);
}

bool SelectedParts::has_bundle(RegionId region) const {
  return is_bundle_sent(*directory_, selection_, region, [&](RegionId r) { return has_region(r); });
}

std::uint8_t SelectedParts::level_of(RegionId region) const {
  const auto found = std::ranges::lower_bound(selection_.levels, region, {}, &AtLevel<RegionId>::what);
  return found != selection_.levels.end() && found->what == region ? found->level : selection_.level;
}

Pages pages_for(const Selection& selection) {
  const bool is_by_name = selection.kind == Selection::Kind::Ids && selection.joins != Joins::All;
  return is_by_name ? Pages::Needed : Pages::All;
}

std::vector<PartId> with_pages(const Directory& directory, std::vector<PartId> parts, Pages pages) {
  if (pages == Pages::None) return parts;
  std::vector<PartId> all;
  all.reserve(parts.size() + directory.pages.size());
  std::vector<bool> is_listed(directory.pages.size(), false);
  const auto list = [&](std::uint32_t page) {
    if (!is_listed[page]) all.push_back({PartKind::Page, page, 0});
    is_listed[page] = true;
  };
  for (const PartId& part : parts) {
    list(page_of(part.region));
    // A bundle decodes from the loop lengths of all regions that it touches.
    if (part.kind == PartKind::Bundle) {
      for (RegionId below : directory.regions[part.region].lower_neighbours) list(page_of(below));
    }
    all.push_back(part);
  }
  if (pages == Pages::All) {
    for (std::uint32_t page = 0; page < directory.pages.size(); ++page) list(page);
  }
  return all;
}

Result<Selection> parse_region_list(std::string_view text) {
  Selection selection{.kind = Selection::Kind::Ids};
  for (std::string_view piece : split(text, ',')) {
    auto level = take_level(piece);
    if (!level) return forward_error(level);
    if (is_name(piece)) {
      if (piece.front() == '=') piece.remove_prefix(1);
      selection.names.emplace_back(piece);
      if (*level) selection.name_levels.push_back({std::string(piece), **level});
      continue;
    }
    const std::size_t dash = piece.find('-');
    RegionId first = 0, last = 0;
    const bool is_number =
        parse_number(piece.substr(0, dash), first) &&
        parse_number(dash == std::string_view::npos ? piece : piece.substr(dash + 1), last);
    if (!is_number || last < first) {
      return fail(ErrorCode::InvalidArgument, "'" + std::string(piece) +
                                                  "' is not a region, a range or a name; write for instance "
                                                  "wheel_left,3,5-7@1");
    }
    const std::size_t before = selection.ids.size();
    if (auto ok = add_range({first, last}, selection.ids); !ok) return forward_error(ok);
    if (!*level) continue;
    for (std::size_t i = before; i < selection.ids.size(); ++i)
      selection.levels.push_back({selection.ids[i], **level});
  }
  return selection;
}

Result<Selection> resolve_names(const Directory& directory, Selection selection) {
  for (const std::string& name : selection.names) {
    const NamedRegions* named = directory.find_name(name);
    if (named == nullptr) return fail(ErrorCode::NotFound, unknown_name(directory, name));
    for (const RegionRange& range : named->ranges) {
      if (auto ok = add_range(range, selection.ids); !ok) return forward_error(ok);
    }
  }
  for (const auto& [name, level] : selection.name_levels) {
    const NamedRegions* named = directory.find_name(name);
    if (named == nullptr) return fail(ErrorCode::NotFound, unknown_name(directory, name));
    for (const RegionRange& range : named->ranges) {
      for (RegionId id = range.first; id <= range.last; ++id) selection.levels.push_back({id, level});
    }
  }
  selection.names.clear();
  selection.name_levels.clear();
  return selection;
}

Result<Box> parse_box(std::string_view text) {
  const auto pieces = split(text, ',');
  double values[6];
  bool is_sound = pieces.size() == 6;
  for (std::size_t i = 0; is_sound && i < 6; ++i)
    is_sound = parse_number(pieces[i], values[i]) && std::isfinite(values[i]);
  if (!is_sound)
    return fail(ErrorCode::InvalidArgument,
                "a box is six numbers x0,y0,z0,x1,y1,z1, not '" + std::string(text) + "'");
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::min(values[axis], values[axis + 3]);
    box.max[axis] = std::max(values[axis], values[axis + 3]);
  }
  return box;
}

}  // namespace selvage
