// SPDX-License-Identifier: MIT
#include "common/pack/directory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/coding/byte_io.h"
#include "common/pack/directory_limits.h"
#include "common/pack/pack.h"

namespace selvage {
namespace {

std::uint32_t page_count(std::uint32_t regions) { return (regions + kRegionsPerPage - 1) / kRegionsPerPage; }

void write_hash(ByteWriter& out, const Hash& hash) { out.append(std::as_bytes(std::span(hash.bytes))); }

Hash read_hash(ByteReader& in) {
  Hash hash;
  const auto bytes = in.take(Hash::kSize);
  std::transform(bytes.begin(), bytes.end(), hash.bytes.begin(),
                 [](std::byte b) { return std::to_integer<std::uint8_t>(b); });
  return hash;
}

void write_box(ByteWriter& out, const GridPoint& low, const GridPoint& high) {
  for (int axis = 0; axis < 3; ++axis) out.varint(static_cast<std::uint32_t>(low[axis]));
  for (int axis = 0; axis < 3; ++axis) out.varint(static_cast<std::uint32_t>(high[axis] - low[axis]));
}

void read_box(ByteReader& in, const Grid& grid, GridPoint& low, GridPoint& high) {
  const auto last = static_cast<std::uint32_t>(grid.max_coordinate());
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t at = in.varint32();
    if (at > last) in.set_failed();
    low[axis] = static_cast<std::int32_t>(at);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t extent = in.varint32();
    if (extent > last - static_cast<std::uint32_t>(low[axis])) in.set_failed();
    high[axis] = low[axis] + static_cast<std::int32_t>(extent);
  }
}

// One region entry: box; loops; levels {size, vertices, triangles, hash, and from the second on deviation and
// dropped bits; nothing but size 0 if it repeats the one before}; bundle {size [, triangles, neighbours as
// distances down from the region's own number, hash]}.
void write_entry(ByteWriter& out, RegionId id, const RegionEntry& entry) {
  write_box(out, entry.box_min, entry.box_max);
  out.varint(entry.loop_lengths.size());
  for (std::uint32_t length : entry.loop_lengths) out.varint(length);
  out.varint(entry.levels.size());
  for (const LevelEntry& level : entry.levels) {
    out.varint(level.is_repeat ? 0 : level.part.size);
    if (level.is_repeat) continue;
    out.varint(level.vertices);
    out.varint(level.triangles);
    write_hash(out, level.part.hash);
    if (&level == &entry.levels.front()) continue;
    out.f32(level.deviation);
    out.u8(level.dropped_bits);
  }
  out.varint(entry.bundle.size);
  if (entry.bundle.size == 0) return;
  out.varint(entry.bundle_triangles);
  out.varint(entry.lower_neighbours.size());
  RegionId above = id;
  for (auto it = entry.lower_neighbours.rbegin(); it != entry.lower_neighbours.rend(); ++it) {
    out.varint(above - *it - 1);
    above = *it;
  }
  write_hash(out, entry.bundle.hash);
}

void read_levels(ByteReader& in, int grid_bits, RegionEntry& entry) {
  const std::uint32_t count = in.count(1);
  if (count > kMaxLevels) return in.set_failed();
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    LevelEntry level;
    level.part.size = in.varint32();
    if (level.part.size == 0) {
      if (i == 0) return in.set_failed();
      level = entry.levels.back();
      level.is_repeat = true;
    } else {
      level.vertices = in.varint32();
      level.triangles = in.varint32();
      level.part.hash = read_hash(in);
      if (i > 0) {
        level.deviation = in.f32();
        level.dropped_bits = in.u8();
      }
      const bool is_sound =
          level.vertices > 0 && level.deviation >= 0 && level.dropped_bits < grid_bits &&
          (i == 0 || (level.vertices <= entry.levels.back().vertices &&
                      level.triangles <= entry.levels.back().triangles && level.triangles > 0));
      if (!is_sound) in.set_failed();
    }
    entry.levels.push_back(level);
  }
}

void read_bundle(ByteReader& in, RegionId id, RegionEntry& entry) {
  entry.bundle.size = in.varint32();
  if (entry.bundle.size == 0) return;
  entry.bundle_triangles = in.varint32();
  entry.lower_neighbours.resize(in.count(1));
  RegionId above = id;
  for (auto it = entry.lower_neighbours.rbegin(); it != entry.lower_neighbours.rend(); ++it) {
    const std::uint32_t step = in.varint32();
    if (step >= above) return in.set_failed();
    *it = above = above - step - 1;
  }
  entry.bundle.hash = read_hash(in);
  if (entry.bundle_triangles == 0) in.set_failed();
}

RegionEntry read_entry(ByteReader& in, RegionId id, const Grid& grid) {
  RegionEntry entry;
  read_box(in, grid, entry.box_min, entry.box_max);
  entry.loop_lengths.resize(in.count(1));
  for (std::uint32_t& length : entry.loop_lengths) length = in.varint32();
  read_levels(in, grid.bits, entry);
  read_bundle(in, id, entry);
  if (!in.ok()) return entry;
  const std::uint64_t on_loops =
      std::accumulate(entry.loop_lengths.begin(), entry.loop_lengths.end(), std::uint64_t{0});
  const std::uint64_t vertices = entry.levels.empty() ? 0 : entry.levels[0].vertices;
  if (on_loops > vertices || (id != kLooseRegion && entry.levels.empty())) in.set_failed();
  if (id == kLooseRegion && on_loops != vertices) in.set_failed();
  return entry;
}

/// The top bit of the first byte marks bit-exact models.
void write_grid(ByteWriter& out, const Grid& grid, bool is_exact) {
  out.u8(static_cast<std::uint8_t>(grid.bits | is_exact << 7));
  for (int axis = 0; axis < 3; ++axis) out.f64(grid.origin[axis]);
  out.f64(grid.step);
}

Grid read_grid(ByteReader& in, bool& is_exact) {
  Grid grid;
  const std::uint8_t first = in.u8();
  is_exact = first >> 7 != 0;
  grid.bits = first & 0x7F;
  for (int axis = 0; axis < 3; ++axis) grid.origin[axis] = in.f64();
  grid.step = in.f64();
  const bool is_sound = grid.bits >= kMinGridBits && grid.bits <= kMaxGridBits &&
                        std::isfinite(grid.origin.x) && std::isfinite(grid.origin.y) &&
                        std::isfinite(grid.origin.z) && std::isfinite(grid.step) && grid.step > 0;
  if (!is_sound) in.set_failed();
  return grid;
}

template <class Visit>
void visit_source_counts(SourceCounts& source, Visit visit) {
  for (std::uint32_t* count :
       {&source.vertices, &source.triangles, &source.dropped_triangles, &source.unreferenced_vertices,
        &source.flipped_triangles, &source.cut_vertices}) {
    visit(*count);
  }
}

std::uint64_t parts_size(const RegionEntry& entry) {
  std::uint64_t size = entry.bundle.size;
  for (const LevelEntry& level : entry.levels) size += level.is_repeat ? 0 : level.part.size;
  return size;
}

struct Page {
  Bytes bytes;
  std::uint64_t parts_size = 0;
  GridPoint low, high;
};

Page write_page(const Directory& directory, std::uint32_t first) {
  const auto last = std::min<std::size_t>(first + kRegionsPerPage, directory.regions.size());
  Page page;
  ByteWriter out;
  bool is_first = true;
  for (RegionId id = first; id < last; ++id) {
    const RegionEntry& entry = directory.regions[id];
    write_entry(out, id, entry);
    page.parts_size += parts_size(entry);
    if (entry.levels.empty()) continue;
    for (int axis = 0; axis < 3; ++axis) {
      page.low[axis] = is_first ? entry.box_min[axis] : std::min(page.low[axis], entry.box_min[axis]);
      page.high[axis] = is_first ? entry.box_max[axis] : std::max(page.high[axis], entry.box_max[axis]);
    }
    is_first = false;
  }
  page.bytes = std::move(out).take();
  return page;
}

// Names of parts end the summary; without any it ends before them. Each name: text, ranges {gap to the one
// before, regions in it beyond the first}. The first gap counts from region 1, later ones from the first
// region that would not touch.
void write_names(ByteWriter& out, const std::vector<NamedRegions>& names) {
  if (names.empty()) return;
  out.varint(names.size());
  for (const auto& [name, ranges] : names) {
    out.string(name);
    out.varint(ranges.size());
    RegionId next = 1;
    for (const auto& [first, last] : ranges) {
      out.varint(first - next);
      out.varint(last - first);
      next = last + 2;
    }
  }
}

NamedRegions read_name(ByteReader& in, std::uint32_t region_count) {
  NamedRegions named;
  named.name = in.string(kMaxDirectoryText);
  named.ranges.resize(in.count(2));
  if (named.ranges.empty()) in.set_failed();
  std::uint64_t next = 1;
  for (auto& [first, last] : named.ranges) {
    const std::uint64_t begin = next + in.varint32();
    const std::uint64_t end = begin + in.varint32();
    if (end >= region_count) in.set_failed();
    if (!in.ok()) break;
    first = static_cast<RegionId>(begin);
    last = static_cast<RegionId>(end);
    next = end + 2;
  }
  return named;
}

void read_names(ByteReader& in, std::uint32_t region_count, std::vector<NamedRegions>& names) {
  if (!in.ok() || in.at_end()) return;
  const std::uint32_t count = in.count(4);
  if (count == 0) in.set_failed();
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    NamedRegions named = read_name(in, region_count);
    if (!names.empty() && named.name <= names.back().name) in.set_failed();
    names.push_back(std::move(named));
  }
}

void write_summary(ByteWriter& out, Directory& directory, const std::vector<Page>& pages) {
  out.string(directory.name);
  out.string(directory.units);
  out.varint(directory.metadata.size());
  for (const auto& [key, value] : directory.metadata) {
    out.string(key);
    out.string(value);
  }
  write_grid(out, directory.grid, directory.is_exact);
  visit_source_counts(directory.source, [&](std::uint32_t count) { out.varint(count); });
  out.varint(directory.vertices);
  out.varint(directory.triangles);
  out.varint(directory.boundary_triangles);
  out.varint(directory.connectivity_bytes);
  out.varint(directory.regions.size());
  for (const Page& page : pages) {
    out.varint(page.bytes.size());
    out.varint(page.parts_size);
    write_box(out, page.low, page.high);
    write_hash(out, hash_of(page.bytes));
  }
  write_names(out, directory.names);
}

/// Offsets follow from the order of parts alone, so they take no bytes in the directory.
std::uint64_t assign_offsets(std::span<RegionEntry> regions, std::uint64_t at) {
  for (RegionEntry& entry : regions) {
    for (auto level = entry.levels.rbegin(); level != entry.levels.rend(); ++level) {
      if (level->is_repeat) continue;
      level->part.offset = at;
      at += level->part.size;
    }
    for (std::size_t i = 1; i < entry.levels.size(); ++i) {
      if (entry.levels[i].is_repeat) entry.levels[i].part = entry.levels[i - 1].part;
    }
    entry.bundle.offset = at;
    at += entry.bundle.size;
  }
  return at;
}

/// The least that one entry takes: box, no loops, no levels, no bundle.
constexpr std::uint64_t kMinEntrySize = 9;

std::uint32_t regions_in(const Directory& directory, std::uint32_t page) {
  const auto left = static_cast<std::uint32_t>(directory.regions.size()) - page * kRegionsPerPage;
  return std::min(kRegionsPerPage, left);
}

/// Fills in all but the regions; gives their number.
std::uint32_t read_summary(ByteReader& in, Directory& directory) {
  directory.name = in.string(kMaxDirectoryText);
  directory.units = in.string(kMaxDirectoryText);
  const std::uint32_t metadata = in.count(2);
  for (std::uint32_t i = 0; i < metadata && in.ok(); ++i) {
    std::string key = in.string(kMaxDirectoryText);
    directory.metadata[std::move(key)] = in.string(kMaxDirectoryText);
  }
  directory.grid = read_grid(in, directory.is_exact);
  visit_source_counts(directory.source, [&](std::uint32_t& count) { count = in.varint32(); });
  directory.vertices = in.varint32();
  directory.triangles = in.varint32();
  directory.boundary_triangles = in.varint32();
  directory.connectivity_bytes = in.varint();
  const std::uint32_t region_count = in.varint32();
  if (region_count == 0 || page_count(region_count) > in.left()) in.set_failed();
  directory.pages.resize(in.ok() ? page_count(region_count) : 0);
  for (PageEntry& page : directory.pages) {
    page.part.size = in.varint32();
    page.parts_size = in.varint();
    read_box(in, directory.grid, page.box_min, page.box_max);
    page.part.hash = read_hash(in);
  }
  read_names(in, region_count, directory.names);
  return region_count;
}

/// Where the pages lie, and the parts that they list. False if they do not fill the directory.
bool place_pages(Directory& directory, std::uint64_t summary_size, std::uint64_t directory_size) {
  std::uint64_t page_at = kPackHeaderSize + summary_size;
  std::uint64_t part_at = kPackHeaderSize + directory_size;
  for (PageEntry& page : directory.pages) {
    if (page.parts_size > std::numeric_limits<std::uint64_t>::max() - part_at) return false;
    page.part.offset = page_at;
    page.first_part = part_at;
    page_at += page.part.size;
    part_at += page.parts_size;
  }
  return page_at == kPackHeaderSize + directory_size;
}

}  // namespace

std::uint32_t RegionEntry::boundary_vertices() const {
  return std::accumulate(loop_lengths.begin(), loop_lengths.end(), std::uint32_t{0});
}

std::uint8_t RegionEntry::canonical_level(std::uint32_t level) const {
  std::size_t at = std::min<std::size_t>(level, levels.size() - 1);
  while (levels[at].is_repeat) --at;
  return static_cast<std::uint8_t>(at);
}

const NamedRegions* Directory::find_name(std::string_view text) const {
  const auto found = std::lower_bound(
      names.begin(), names.end(), text,
      [](const NamedRegions& named, std::string_view wanted) { return named.name < wanted; });
  return found != names.end() && found->name == text ? &*found : nullptr;
}

bool Directory::is_complete() const { return std::ranges::all_of(pages, &PageEntry::is_read); }

const PartRef* Directory::find(const PartId& id) const {
  if (id.kind == PartKind::Page)
    return id.level == 0 && id.region < pages.size() ? &pages[id.region].part : nullptr;
  if (id.region >= regions.size()) return nullptr;
  const RegionEntry& entry = regions[id.region];
  if (id.kind == PartKind::Bundle) return id.level == 0 && entry.bundle.size > 0 ? &entry.bundle : nullptr;
  const bool is_there = id.level < entry.levels.size() && !entry.levels[id.level].is_repeat;
  return is_there ? &entry.levels[id.level].part : nullptr;
}

std::uint32_t Directory::level_count() const {
  std::size_t count = 1;
  for (const RegionEntry& entry : regions) count = std::max(count, entry.levels.size());
  return static_cast<std::uint32_t>(count);
}

DirectoryBytes write_directory(Directory& directory) {
  std::vector<Page> pages;
  for (std::uint32_t first = 0; first < directory.regions.size(); first += kRegionsPerPage)
    pages.push_back(write_page(directory, first));
  ByteWriter out;
  write_summary(out, directory, pages);
  const auto summary_size = static_cast<std::uint32_t>(out.size());
  directory.pages.clear();
  for (const Page& page : pages) {
    const PartRef part{0, static_cast<std::uint32_t>(page.bytes.size()), hash_of(page.bytes)};
    directory.pages.push_back({part, 0, page.parts_size, page.low, page.high, true});
    out.append(page.bytes);
  }
  place_pages(directory, summary_size, out.size());
  assign_offsets(directory.regions, kPackHeaderSize + out.size());
  return {std::move(out).take(), summary_size};
}

Result<Directory> parse_summary(std::span<const std::byte> summary, std::uint64_t directory_size,
                                std::uint32_t max_regions) {
  Directory directory;
  ByteReader in(summary);
  const std::uint32_t region_count = read_summary(in, directory);
  if (!in.at_end()) return fail(ErrorCode::BadStream, "directory: malformed summary page", in.offset());
  if (region_count > max_regions) {
    return fail(ErrorCode::LimitExceeded, "directory: " + std::to_string(region_count) +
                                              " regions are more than the limit of " +
                                              std::to_string(max_regions));
  }
  if (!place_pages(directory, summary.size(), directory_size))
    return fail(ErrorCode::BadStream, "directory: pages do not fill it", summary.size());
  directory.regions.resize(region_count);
  return directory;
}

Result<void> read_page(Directory& directory, std::uint32_t page, std::span<const std::byte> bytes) {
  if (page >= directory.pages.size())
    return fail(ErrorCode::BadStream, "directory: no page " + std::to_string(page));
  PageEntry& entry = directory.pages[page];
  if (entry.is_read) return {};
  if (auto ok = check_part(entry.part, bytes); !ok) {
    return fail(ErrorCode::BadStream, "directory: page " + std::to_string(page) + " does not match its hash",
                0);
  }
  ByteReader in(bytes);
  std::vector<RegionEntry> regions;
  std::uint64_t parts = 0;
  const RegionId first = page * kRegionsPerPage;
  for (RegionId id = first; id < first + regions_in(directory, page); ++id) {
    regions.push_back(read_entry(in, id, directory.grid));
    if (!in.ok()) return fail(ErrorCode::BadStream, "directory: malformed region entry", in.offset());
    parts += parts_size(regions.back());
  }
  if (!in.at_end() || parts != entry.parts_size) {
    return fail(ErrorCode::BadStream, "directory: page does not hold what the summary says", in.offset());
  }
  assign_offsets(regions, entry.first_part);
  std::ranges::move(regions, directory.regions.begin() + first);
  entry.is_read = true;
  return {};
}

Result<Directory> parse_directory(std::span<const std::byte> bytes, std::uint32_t summary_size) {
  if (summary_size > bytes.size())
    return fail(ErrorCode::BadStream, "directory: shorter than its summary page");
  const auto most = static_cast<std::uint32_t>(
      std::min<std::uint64_t>(bytes.size() / kMinEntrySize, std::numeric_limits<std::uint32_t>::max()));
  auto directory = parse_summary(bytes.first(summary_size), bytes.size(), most);
  if (!directory) return directory;
  for (std::uint32_t page = 0; page < directory->pages.size(); ++page) {
    const PartRef part = directory->pages[page].part;
    const std::uint64_t offset = part.offset - kPackHeaderSize;
    if (auto ok = read_page(*directory, page, bytes.subspan(offset, part.size)); !ok)
      return fail(ok.error().code, ok.error().message, offset + ok.error().offset);
  }
  return directory;
}

void complete(Directory& directory, const Directory& whole) {
  for (std::uint32_t page = 0; page < directory.pages.size(); ++page) {
    if (directory.pages[page].is_read) continue;
    const auto first = whole.regions.begin() + page * kRegionsPerPage;
    std::copy_n(first, regions_in(whole, page), directory.regions.begin() + page * kRegionsPerPage);
    directory.pages[page].is_read = true;
  }
}

Hash pack_id(std::span<const std::byte> directory_bytes, std::uint32_t summary_size) {
  return hash_of(directory_bytes.first(summary_size));
}

}  // namespace selvage
