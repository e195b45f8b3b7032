// SPDX-License-Identifier: MIT
#include "common/mesh_io/obj.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/mesh_io/mesh_builder.h"
#include "common/mesh_io/text_scanner.h"

namespace selvage {
namespace {

/// Why a statement is not read, for the note; nullptr for smoothing, which says nothing about the surface.
const char* reason_to_drop(std::string_view keyword) {
  static const std::map<std::string_view, const char*> kReasons = {
      {"vt", "texture coordinates"},
      {"vn", "normals"},
      {"mtllib", "materials"},
      {"l", "lines"},
      {"p", "points"},
      {"s", nullptr},
      {"vp", "free-form curves and surfaces"},
      {"curv", "free-form curves and surfaces"},
      {"curv2", "free-form curves and surfaces"},
      {"surf", "free-form curves and surfaces"},
  };
  const auto found = kReasons.find(keyword);
  return found == kReasons.end() ? "unknown statements" : found->second;
}

bool looks_like_keyword(std::string_view word) {
  return std::all_of(word.begin(), word.end(),
                     [](char c) {
                       return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                              c == '_';
                     }) &&
         !(word[0] >= '0' && word[0] <= '9');
}

/// The rest of a face corner after its vertex: "/7", "//3" or "/7/3". The numbers themselves name attributes.
bool is_attribute_part(std::string_view text) {
  if (text.empty()) return true;
  const bool has_odd_char = std::any_of(text.begin(), text.end(),
                                        [](char c) { return (c < '0' || c > '9') && c != '-' && c != '/'; });
  return text[0] == '/' && !has_odd_char && std::count(text.begin(), text.end(), '/') <= 2;
}

class ObjReader {
 public:
  explicit ObjReader(std::span<const std::byte> bytes)
      : scan_(bytes, {.comment = '#', .has_continuations = true}) {}

  Result<MeshFile> read() {
    for (; !scan_.at_end(); scan_.next_line()) {
      const auto failure = read_statement();
      if (failure) return *failure;
    }
    if (highest_index_ >= mesh_.vertex_count() && mesh_.vertex_count() > 0) {
      return fail(ErrorCode::BadFile, "line " + std::to_string(line_of_highest_) + ": a face names vertex " +
                                          std::to_string(highest_index_ + 1) + ", but the file has only " +
                                          std::to_string(mesh_.vertex_count()));
    }
    for (const auto& [reason, statement] : dropped_) {
      mesh_.note(std::string(reason) + " dropped (first: " + quote(statement.keyword) + " on line " +
                 std::to_string(statement.line) + ")");
    }
    return std::move(mesh_).finish("OBJ");
  }

 private:
  using Failure = std::optional<tl::unexpected<Error>>;
  struct Statement {
    std::string keyword;
    std::uint64_t line;
  };

  Failure read_statement() {
    const std::string_view keyword = scan_.word();
    if (keyword == "v") return read_vertex();
    if (keyword == "f" || keyword == "fo") return read_face();
    if (keyword == "g" || keyword == "o" || keyword == "usemtl") return read_name(keyword[0]);
    if (!looks_like_keyword(keyword)) return scan_.fail_here("not an OBJ statement: " + quote(keyword));
    if (const char* reason = reason_to_drop(keyword)) drop(reason, keyword);
    return std::nullopt;
  }

  /// x y z, then perhaps a weight (of free-form surfaces), or red green blue.
  Failure read_vertex() {
    Vec3 position;
    for (int axis = 0; axis < 3; ++axis)
      if (!scan_.coordinate(position[axis])) return scan_.fail_expecting("a finite coordinate");
    double extra = 0;
    int extras = 0;
    for (; !scan_.at_line_end(); ++extras)
      if (!scan_.coordinate(extra)) return scan_.fail_expecting("a number or the end of the line");
    if (extras >= 3) drop("vertex colours", "v");
    mesh_.add_vertex(position);
    return std::nullopt;
  }

  Failure read_face() {
    polygon_.clear();
    while (!scan_.at_line_end()) {
      std::uint32_t index = 0;
      if (auto failure = read_corner(index)) return failure;
      polygon_.push_back(index);
    }
    mesh_.add_polygon(polygon_);
    return std::nullopt;
  }

  /// `g` states any number of names, the others one that may hold blanks. Each holds until the next of its
  /// kind.
  Failure read_name(char kind) {
    if (kind == 'g') {
      group_.groups.clear();
      while (!scan_.at_line_end() && group_.groups.size() < kMaxGroups)
        group_.groups.push_back(mesh_.name_index(shortened(scan_.word())));
      if (!scan_.at_line_end()) drop("more than 16 groups at once", "g");
      std::sort(group_.groups.begin(), group_.groups.end());
      group_.groups.erase(std::unique(group_.groups.begin(), group_.groups.end()), group_.groups.end());
    } else {
      std::string name;
      while (!scan_.at_line_end() && name.size() < kMaxNameLength)
        name += (name.empty() ? "" : " ") + std::string(scan_.word());
      std::uint32_t& place = kind == 'o' ? group_.object : group_.material;
      place = name.empty() ? kNone : mesh_.name_index(shortened(name));
    }
    mesh_.set_group(group_);
    return std::nullopt;
  }

  static std::string_view shortened(std::string_view name) { return name.substr(0, kMaxNameLength); }

  Failure read_corner(std::uint32_t& index) {
    const std::string_view word = scan_.peek();
    const char* end = word.data() + word.size();
    std::int64_t stated = 0;
    const auto [stop, status] = std::from_chars(word.data(), end, stated);
    if (status != std::errc{} || !is_attribute_part({stop, static_cast<std::size_t>(end - stop)})) {
      return scan_.fail_expecting("a face corner (v, v/vt, v//vn or v/vt/vn)");
    }
    scan_.word();
    const auto count = static_cast<std::int64_t>(mesh_.vertex_count());
    if (stated == 0 || stated < -count || stated > std::int64_t{MeshBuilder::kMaxIndices}) {
      return scan_.fail_here("a face names vertex " + std::to_string(stated) + ", but " +
                             std::to_string(count) +
                             " vertices come before it; they count from 1, or from -1 backwards");
    }
    index = static_cast<std::uint32_t>(stated > 0 ? stated - 1 : count + stated);
    if (index >= highest_index_) highest_index_ = index, line_of_highest_ = scan_.line();
    return std::nullopt;
  }

  void drop(std::string_view reason, std::string_view keyword) {
    dropped_.try_emplace(reason, Statement{std::string(keyword), scan_.line()});
  }

  static constexpr std::size_t kMaxGroups = 16, kMaxNameLength = 255;

  TextScanner scan_;
  MeshBuilder mesh_;
  NamedGroup group_;
  std::vector<std::uint32_t> polygon_;
  std::uint64_t highest_index_ = 0;
  std::uint64_t line_of_highest_ = 0;
  std::map<std::string_view, Statement> dropped_;  ///< by reason; keys are string literals
};

}  // namespace

Result<MeshFile> parse_obj(std::span<const std::byte> bytes) { return ObjReader(bytes).read(); }

}  // namespace selvage
