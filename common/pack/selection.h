// SPDX-License-Identifier: MIT
//
// What a client may ask for, and the parts that answer it. The server, the offline `unpack` and any other
// source of parts use this same function, so that they all mean the same.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "common/pack/directory.h"

namespace selvage {

enum class Joins : std::uint8_t {
  None = 0,     ///< regions alone
  Closure = 1,  ///< bundles with at least one boundary triangle whose regions are all selected
  All = 2,      ///< every bundle that touches a selected region, for clients that will ask for more later
};

/// Which pages of the directory go with the parts, for a client that does not have them yet.
enum class Pages : std::uint8_t {
  None = 0,
  Needed = 1,  ///< the pages that list the parts and what their bundles touch, each before what needs it
  All = 2,     ///< and all others, after the parts
};

/// An axis-aligned box in model units, inclusive.
struct Box {
  Vec3 min, max;
};

/// A region or a named part at a level of its own.
template <class Thing>
struct AtLevel {
  Thing what;
  std::uint8_t level = 0;
  friend bool operator==(const AtLevel&, const AtLevel&) = default;
};

struct Selection {
  enum class Kind : std::uint8_t { All, Ids, Box };
  Kind kind = Kind::All;
  std::vector<RegionId> ids;  ///< Kind::Ids; any order, repeats allowed
  /// Kind::Ids, beside those: parts by the name that their author gave. Only who has the directory knows what
  /// they stand for, so they never travel: see resolve_names.
  std::vector<std::string> names = {};
  Box box;  ///< Kind::Box: regions whose boxes meet it
  Joins joins = Joins::Closure;
  std::uint8_t level = 0;  ///< of all selected regions; where there is none so coarse, the coarsest
  /// Regions that come at another level than that; of several levels for one region the finest counts, and
  /// regions that are not selected are not for being here.
  std::vector<AtLevel<RegionId>> levels = {};
  std::vector<AtLevel<std::string>> name_levels = {};  ///< the same by name; resolved with the names
};

/// The same selection with the regions that its names stand for instead of the names. NotFound names a name
/// that is not in the model.
Result<Selection> resolve_names(const Directory& directory, Selection selection);

/// The selected regions, ascending, without the loose region; names must be resolved. NotFound names an id
/// that is not in the model, InvalidArgument a page of the directory that would have to be read first.
Result<std::vector<RegionId>> select_regions(const Directory& directory, const Selection& selection);

/// The parts that answer a selection, regions in ascending order, each followed by its bundle; every region
/// at its level, or at the one that this repeats. The loose part comes first when a chosen bundle needs it.
Result<std::vector<PartId>> select_parts(const Directory& directory, const Selection& selection);

/// The same question for one part at a time, for whoever gets parts while pages of the directory still come.
class SelectedParts {
 public:
  /// `directory` is borrowed; names must be resolved.
  SelectedParts(const Directory& directory, Selection selection);

  /// Whether select_parts lists the part. The pages that list it, and what a bundle touches, must have been
  /// read: else the answer is no. The loose part may be taken for one of the answer that it is not.
  bool contains(const PartId& id) const;
  const Selection& selection() const { return selection_; }

 private:
  bool has_region(RegionId region) const;
  bool has_bundle(RegionId region) const;
  std::uint8_t level_of(RegionId region) const;

  const Directory* directory_;
  Selection selection_;  ///< ids and levels ascending
};

/// The pages that a client without any must ask for, so that it can tell in the end that nothing is missing:
/// those that list what it names, or all where what is selected depends on what they list.
Pages pages_for(const Selection& selection);

/// The same parts with pages of the directory among them. What a part needs to be decoded and stitched is
/// listed on pages that come before it.
std::vector<PartId> with_pages(const Directory& directory, std::vector<PartId> parts, Pages pages);

/// "wheel_left,3,5-7@1" -> the names and {3, 5, 6, 7}, as a selection by ids, 5 to 7 at level 1. What looks
/// like a number or a range is one; "=3" is the part called 3. A level is what follows the last @, if that is
/// a number. InvalidArgument names the piece that is wrong. At most 1,000,000 ids.
Result<Selection> parse_region_list(std::string_view text);

/// "x0,y0,z0,x1,y1,z1".
Result<Box> parse_box(std::string_view text);

}  // namespace selvage
