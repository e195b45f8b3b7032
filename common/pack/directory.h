// SPDX-License-Identifier: MIT
//
// A pack's directory: what a client must know to choose parts, ask for them, check them and place them.
// On disk and on the wire it is the same bytes (docs/FORMAT.md, "Directory"): a summary page, then pages of
// region entries, each page hashed in the summary, so the summary's hash is the pack's identity.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/hash.h"
#include "common/base/ids.h"
#include "common/base/result.h"
#include "common/mesh/grid.h"
#include "common/pack/directory_limits.h"

namespace selvage {

/// A part is the unit of addressing, hashing, caching and sending: one level of one region, one bundle, or
/// one page of the directory itself.
enum class PartKind : std::uint8_t { Region = 0, Bundle = 1, Page = 2 };

struct PartId {
  PartKind kind = PartKind::Region;
  RegionId region = 0;     ///< of a page: its number
  std::uint8_t level = 0;  ///< 0 is the full resolution; always 0 for bundles and pages
  friend auto operator<=>(const PartId&, const PartId&) = default;
};

/// Where a part lies in the pack file. Size 0 means that there is no such part.
struct PartRef {
  std::uint64_t offset = 0;
  std::uint32_t size = 0;
  Hash hash;
};

inline constexpr std::uint32_t kMaxLevels = 16;  ///< of a region, the finest included

/// One region at one level of detail.
struct LevelEntry {
  PartRef part;
  std::uint32_t vertices = 0;
  std::uint32_t triangles = 0;  ///< interior triangles of the region at this level
  /// How far the model may lie from the finest level, in model units and in either direction, where this
  /// region and its neighbours are at this level: measured at build, the level's rounding counted. The finest
  /// level's own rounding (half a grid step an axis) comes on top.
  float deviation = 0;
  std::uint8_t dropped_bits = 0;  ///< low bits of every coordinate that this level leaves out
  /// The region is what it was one level finer: the same part, counts and deviation. It is listed, so that
  /// every region has every level, and addressed as the finer one (RegionEntry::canonical_level).
  bool is_repeat = false;
};

struct RegionEntry {
  GridPoint box_min, box_max;               ///< of the region's vertices, inclusive, on the grid
  std::vector<std::uint32_t> loop_lengths;  ///< full-resolution boundary loops in canonical order;
                                            ///< for the loose region: one entry, its number of vertices
  std::vector<RegionId> lower_neighbours;  ///< the other regions that this region's bundle touches, ascending
  std::vector<LevelEntry> levels;          ///< finest first; empty only for a loose region without vertices
  PartRef bundle;                          ///< all boundary triangles whose highest region is this one
  std::uint32_t bundle_triangles = 0;

  std::uint32_t boundary_vertices() const;
  /// The level to address where `level` is wanted: the coarsest if there is none so coarse, the finest of
  /// those that it repeats. `levels` must not be empty.
  std::uint8_t canonical_level(std::uint32_t level) const;
};

/// What became of the input, for people and for `compare`: counts of the file's own elements.
struct SourceCounts {
  std::uint32_t vertices = 0;           ///< in the file
  std::uint32_t triangles = 0;          ///< in the file, after triangulation of polygons
  std::uint32_t dropped_triangles = 0;  ///< with a repeated index
  std::uint32_t unreferenced_vertices = 0;
  std::uint32_t flipped_triangles = 0;  ///< turned for coding, turned back by the decoder
  std::uint32_t cut_vertices = 0;  ///< copies made at non-manifold spots and between the author's parts; the
                                   ///< stitcher welds them again
};

struct RegionRange {
  RegionId first = 0, last = 0;  ///< inclusive
  friend bool operator==(const RegionRange&, const RegionRange&) = default;
};

/// A part that the model's author named, as the regions it was cut into.
struct NamedRegions {
  std::string name;
  std::vector<RegionRange> ranges;  ///< ascending, not touching one another, at least one

  friend bool operator==(const NamedRegions&, const NamedRegions&) = default;
};

/// One page of the directory, as the summary describes it. It lists the regions [n * kRegionsPerPage,
/// (n + 1) * kRegionsPerPage).
struct PageEntry {
  PartRef part;                  ///< of the page's own bytes
  std::uint64_t first_part = 0;  ///< where the parts that it lists begin, one after the other
  std::uint64_t parts_size = 0;
  GridPoint box_min, box_max;  ///< of its regions
  bool is_read = false;        ///< its regions are in `regions`
};
inline constexpr std::uint32_t kRegionsPerPage = 64;
inline constexpr std::uint32_t page_of(RegionId region) { return region / kRegionsPerPage; }

struct Directory {
  std::string name;
  std::string units;  ///< as the user named them; empty if unknown
  std::map<std::string, std::string> metadata;
  Grid grid;
  bool is_exact = false;  ///< region parts hold the floats behind the grid points
  SourceCounts source;
  std::uint32_t vertices = 0;            ///< of the stitched mesh
  std::uint32_t triangles = 0;           ///< of the stitched mesh
  std::uint32_t boundary_triangles = 0;  ///< of those, the ones in bundles
  std::uint64_t connectivity_bytes = 0;  ///< of all region parts, the share that is connectivity: for people
  std::vector<NamedRegions> names;       ///< by name, each once; a region may have several names or none
  std::vector<RegionEntry> regions;      ///< by RegionId; [kLooseRegion] always exists
  std::vector<PageEntry> pages;          ///< filled in by writing and parsing

  /// The region's page has been read. Always so, but for a directory that parse_summary began.
  bool has(RegionId region) const { return pages.empty() || pages[page_of(region)].is_read; }
  bool is_complete() const;                     ///< has all regions
  const PartRef* find(const PartId& id) const;  ///< null if there is no such part, or it repeats another
  std::uint32_t level_count() const;            ///< most levels of a region; 1 without levels of detail
  const NamedRegions* find_name(std::string_view name) const;  ///< null if no part is called so
  std::uint32_t real_region_count() const { return static_cast<std::uint32_t>(regions.size()) - 1; }
};

/// The directory's bytes, and the length of the summary page at their front.
struct DirectoryBytes {
  std::vector<std::byte> bytes;
  std::uint32_t summary_size = 0;
};

/// `directory.regions[*].levels[*].part` and `.bundle` need sizes and hashes; their offsets are assigned:
/// parts follow the directory in region order, a region's levels coarsest first, then its bundle.
DirectoryBytes write_directory(Directory& directory);

/// Parses and checks hostile bytes: page hashes, counts, order, and that parts tile [end of directory, end of
/// file).
Result<Directory> parse_directory(std::span<const std::byte> bytes, std::uint32_t summary_size);

/// The same page by page, for clients that need some regions of very many: first the summary, which gives
/// everything but the regions (they are there, and empty), then any pages in any order. LimitExceeded beyond
/// `max_regions`, for which the summary alone makes room.
Result<Directory> parse_summary(std::span<const std::byte> summary, std::uint64_t directory_size,
                                std::uint32_t max_regions = kMaxRegions);
/// BadStream, with nothing read, if the bytes are not that page. Reading one again changes nothing.
Result<void> read_page(Directory& directory, std::uint32_t page, std::span<const std::byte> bytes);

/// Fills in what a directory lacks from the same pack's whole directory; what is there stays where it is.
void complete(Directory& directory, const Directory& whole);

/// The identity of the pack with this directory.
Hash pack_id(std::span<const std::byte> directory_bytes, std::uint32_t summary_size);

}  // namespace selvage
