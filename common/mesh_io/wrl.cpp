// SPDX-License-Identifier: MIT
#include "common/mesh_io/wrl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "common/base/ids.h"
#include "common/mesh_io/mesh_builder.h"
#include "common/mesh_io/text_scanner.h"
#include "common/mesh_io/wrl_transform.h"

namespace selvage {
namespace {

using Failure = std::optional<tl::unexpected<Error>>;

constexpr std::array<std::string_view, 10> kRefused = {"Box",       "Sphere",          "Cone",   "Cylinder",
                                                       "Extrusion", "ElevationGrid",   "Inline", "LOD",
                                                       "Switch",    "GeoElevationGrid"};
constexpr std::array<std::string_view, 7> kNoted = {
    "IndexedLineSet", "PointSet", "Text", "Material", "Normal", "Color", "TextureCoordinate"};

/// Deeper than any exporter nests; bounds the times that one vertex is transformed.
constexpr std::size_t kMaxDepth = 256;

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The points of one Coordinate node, and where in the mesh they went last: face sets in the same place share
/// them.
struct PointSet {
  std::vector<Vec3> points;
  std::uint32_t first_vertex = kNone;
  std::uint32_t place = kNone;
};

/// An IndexedFaceSet while it is open. Its fields come in any order, so it is put into the mesh when it
/// closes.
struct FaceSet {
  std::uint32_t point_set = kNone;
  std::vector<std::uint32_t> indices;  ///< kNone ends a polygon
  std::uint64_t highest_index = 0;
  std::uint64_t line_of_highest = 0;
  bool is_clockwise = false;
};

struct Node {
  std::string_view type;  ///< "[" for a list
  std::string_view name;  ///< after DEF
  std::uint64_t line = 0;
  std::uint64_t first_vertex = 0;  ///< of those that were added while it was open
  std::uint64_t first_triangle = 0;
  std::uint32_t place = 0;  ///< number of the innermost Transform; 0 outside all
  WrlTransform transform;
  FaceSet faces;
  std::uint32_t point_set = kNone;  ///< of a Coordinate
};

/// What a DEF name stands for.
struct Definition {
  std::string_view type;
  std::uint32_t point_set = kNone;
  bool has_geometry = false;
};

class WrlReader {
 public:
  explicit WrlReader(std::span<const std::byte> bytes)
      : scan_(bytes, {.blanks = " \t\v\f,", .punctuation = "[]{}\"", .comment = '#'}),
        most_vertices_(bytes.size()) {}

  Result<MeshFile> read() {
    while (!scan_.at_end()) {
      if (auto failure = read_item()) return *failure;
    }
    if (!open_.empty()) {
      return scan_.fail_here("the file ends inside " + std::string(open_.back().type) + " of line " +
                             std::to_string(open_.back().line) + "; is it cut short?");
    }
    for (std::string_view type : dropped_) mesh_.note(std::string(type) + " nodes dropped");
    return std::move(mesh_).finish("VRML97");
  }

 private:
  /// One step: a bracket, a string, a DEF or USE, a node's beginning, or a field's name (whose value
  /// follows).
  Failure read_item() {
    const std::string_view word = scan_.word();
    if (word == "\"") return skip_string();
    if (word == "}" || word == "]") return close(word);
    if (word == "[") return open("[");
    if (word == "{") return scan_.fail_here("a '{' without the name of a node before it");
    if (word == "DEF") return read_name();
    if (word == "USE") return read_use();
    if (word == "PROTO" || word == "EXTERNPROTO") return refuse(word);
    if (!scan_.at_end() && scan_.peek() == "{") {
      scan_.word();
      return open(word);
    }
    return read_field(word);
  }

  Failure skip_string() {
    const std::uint64_t line = scan_.line();
    if (scan_.skip_string()) return std::nullopt;
    return scan_.fail_here("the string that begins on line " + std::to_string(line) + " does not end");
  }

  Failure read_name() {
    scan_.at_end();
    pending_name_ = scan_.word();
    if (pending_name_.empty()) return scan_.fail_expecting("a name after DEF");
    return std::nullopt;
  }

  Failure refuse(std::string_view what) {
    return scan_.fail_here(
        std::string(what) + " is not supported; export the model as plain IndexedFaceSet nodes",
        ErrorCode::Unsupported);
  }

  Failure open(std::string_view type) {
    if (contains(kRefused, type)) return refuse(type);
    if (open_.size() == kMaxDepth) return scan_.fail_here("nodes nested too deep", ErrorCode::LimitExceeded);
    if (contains(kNoted, type)) dropped_.insert(type);
    Node node{.type = type, .name = pending_name_, .line = scan_.line()};
    pending_name_ = {};
    node.first_vertex = mesh_.vertex_count();
    node.first_triangle = mesh_.soup().triangles.size();
    node.place = type == "Transform" ? ++transforms_ : open_.empty() ? 0 : open_.back().place;
    if (type == "Coordinate") {
      node.point_set = static_cast<std::uint32_t>(point_sets_.size());
      point_sets_.emplace_back();
    }
    open_.push_back(std::move(node));
    return std::nullopt;
  }

  Failure close(std::string_view bracket) {
    const bool is_list = bracket == "]";
    if (open_.empty() || (open_.back().type == "[") != is_list) {
      return scan_.fail_here("a '" + std::string(bracket) + "' that closes nothing");
    }
    Node node = std::move(open_.back());
    open_.pop_back();
    if (is_list) return std::nullopt;
    if (node.type == "Coordinate") give_to_parent(node.point_set);
    if (node.type == "IndexedFaceSet") {
      if (auto failure = add_faces(node)) return failure;
    }
    if (node.type == "Transform") {
      if (auto failure = apply_transform(node)) return failure;
    }
    if (!node.name.empty()) {
      definitions_[node.name] = {node.type, node.point_set,
                                 mesh_.soup().triangles.size() > node.first_triangle};
    }
    return std::nullopt;
  }

  void give_to_parent(std::uint32_t point_set) {
    if (!open_.empty() && open_.back().type == "IndexedFaceSet") open_.back().faces.point_set = point_set;
  }

  Failure read_use() {
    scan_.at_end();
    const std::string_view name = scan_.word();
    const auto found = definitions_.find(name);
    if (found == definitions_.end())
      return scan_.fail_here("USE of " + quote(name) + ", which no DEF before it names");
    if (found->second.has_geometry) return refuse("USE of a node that holds geometry");
    if (found->second.point_set != kNone) give_to_parent(found->second.point_set);
    return std::nullopt;
  }

  Failure read_field(std::string_view name) {
    if (open_.empty()) return std::nullopt;
    Node& node = open_.back();
    if (node.type == "Coordinate" && name == "point") return read_points(point_sets_[node.point_set].points);
    if (node.type == "IndexedFaceSet") return read_face_set_field(name, node.faces);
    if (node.type == "Transform") return read_transform_field(name, node.transform);
    return std::nullopt;
  }

  Failure read_face_set_field(std::string_view name, FaceSet& faces) {
    if (name == "coordIndex") return read_indices(faces);
    if (name != "ccw") return std::nullopt;
    scan_.at_end();
    const std::string_view value = scan_.peek();
    if (value != "TRUE" && value != "FALSE") return scan_.fail_expecting("TRUE or FALSE");
    faces.is_clockwise = value == "FALSE";
    scan_.word();
    return std::nullopt;
  }

  Failure read_transform_field(std::string_view name, WrlTransform& transform) {
    if (name == "translation") return read_vector(transform.translation);
    if (name == "center") return read_vector(transform.center);
    if (name == "rotation") return read_numbers(transform.rotation.axis_and_angle);
    if (name == "scaleOrientation") return read_numbers(transform.scale_orientation.axis_and_angle);
    if (name != "scale") return std::nullopt;
    if (auto failure = read_vector(transform.scale)) return failure;
    if (transform.scale.x > 0 && transform.scale.y > 0 && transform.scale.z > 0) return std::nullopt;
    return refuse("a scale that is not above zero");
  }

  Failure read_numbers(std::span<double> numbers) {
    for (double& number : numbers) {
      scan_.at_end();
      if (!scan_.coordinate(number)) return scan_.fail_expecting("a finite number");
    }
    return std::nullopt;
  }

  Failure read_vector(Vec3& vector) {
    std::array<double, 3> xyz;
    auto failure = read_numbers(xyz);
    if (!failure) vector = {xyz[0], xyz[1], xyz[2]};
    return failure;
  }

  /// Calls `read_one` for each value of a field: for one, or for as many as stand between brackets.
  template <class ReadOne>
  Failure read_values(const ReadOne& read_one) {
    if (scan_.at_end() || scan_.peek() != "[") return read_one();
    scan_.word();
    while (!scan_.at_end() && scan_.peek() != "]") {
      if (auto failure = read_one()) return failure;
    }
    if (scan_.word().empty()) return scan_.fail_expecting("']'");
    return std::nullopt;
  }

  Failure read_points(std::vector<Vec3>& points) {
    return read_values([&]() -> Failure {
      Vec3 point;
      if (auto failure = read_vector(point)) return failure;
      points.push_back(point);
      return std::nullopt;
    });
  }

  Failure read_indices(FaceSet& faces) {
    return read_values([&]() -> Failure {
      std::int64_t index = 0;
      if (!scan_.integer(index)) return scan_.fail_expecting("a vertex index");
      if (index < -1 || index >= std::int64_t{MeshBuilder::kMaxIndices})
        return scan_.fail_here("not a vertex index: " + std::to_string(index));
      faces.indices.push_back(index == -1 ? kNone : static_cast<std::uint32_t>(index));
      const auto stated = static_cast<std::uint64_t>(std::max<std::int64_t>(index, 0));
      if (stated >= faces.highest_index) faces.highest_index = stated, faces.line_of_highest = scan_.line();
      return std::nullopt;
    });
  }

  Failure add_faces(const Node& node) {
    const FaceSet& faces = node.faces;
    if (faces.indices.empty()) return std::nullopt;
    const std::uint64_t count = faces.point_set == kNone ? 0 : point_sets_[faces.point_set].points.size();
    if (faces.highest_index >= count) {
      return fail(ErrorCode::BadFile, "line " + std::to_string(faces.line_of_highest) +
                                          ": a face names vertex " + std::to_string(faces.highest_index) +
                                          ", but its Coordinate has " + std::to_string(count) +
                                          " points, counted from 0");
    }
    PointSet& set = point_sets_[faces.point_set];
    if (set.place != node.place && count > most_vertices_ - mesh_.vertex_count()) {
      return scan_.fail_here("coordinates repeated by USE too often", ErrorCode::LimitExceeded);
    }
    const std::uint32_t first_vertex = place_points(set, node.place);
    std::vector<std::uint32_t> polygon;
    for (std::size_t i = 0; i <= faces.indices.size(); ++i) {
      const bool is_end = i == faces.indices.size() || faces.indices[i] == kNone;
      if (!is_end) {
        polygon.push_back(first_vertex + faces.indices[i]);
        continue;
      }
      if (faces.is_clockwise && !polygon.empty()) std::reverse(polygon.begin() + 1, polygon.end());
      if (!polygon.empty()) mesh_.add_polygon(polygon);
      polygon.clear();
    }
    return std::nullopt;
  }

  std::uint32_t place_points(PointSet& set, std::uint32_t place) {
    if (set.place == place) return set.first_vertex;
    set.place = place;
    set.first_vertex = static_cast<std::uint32_t>(mesh_.vertex_count());
    for (const Vec3& point : set.points) mesh_.add_vertex(point);
    return set.first_vertex;
  }

  /// Inner transforms close first, so each needs only be applied to what was added within it.
  Failure apply_transform(const Node& node) {
    std::vector<Vec3>& positions = mesh_.soup().positions;
    for (std::size_t v = node.first_vertex; v < positions.size(); ++v) {
      positions[v] = node.transform.apply(positions[v]);
      if (!std::isfinite(dot(positions[v], {1, 1, 1}))) {
        return scan_.fail_here("the Transform of line " + std::to_string(node.line) +
                               " makes a coordinate infinite");
      }
    }
    return std::nullopt;
  }

  TextScanner scan_;
  std::uint64_t
      most_vertices_;  ///< as many as the file has bytes: sharing by USE must not multiply them without bound
  MeshBuilder mesh_;
  std::vector<Node> open_;
  std::vector<PointSet> point_sets_;
  std::map<std::string_view, Definition> definitions_;  ///< names are views of the file
  std::set<std::string_view> dropped_;
  std::string_view pending_name_;
  std::uint32_t transforms_ = 0;
};

}  // namespace

Result<MeshFile> parse_wrl(std::span<const std::byte> bytes) {
  const std::string_view text = as_text(bytes);
  if (text.starts_with("#VRML V1")) {
    return fail(ErrorCode::Unsupported,
                "line 1: VRML 1.0 cannot be read; convert the file to VRML97 (#VRML V2.0)");
  }
  if (!text.starts_with("#VRML V2.0")) {
    return fail(ErrorCode::BadFile, "line 1: not a VRML97 file: it does not begin with '#VRML V2.0'");
  }
  return WrlReader(bytes).read();
}

}  // namespace selvage
