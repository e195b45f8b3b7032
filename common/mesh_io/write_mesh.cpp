// SPDX-License-Identifier: MIT
#include "common/mesh_io/write_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include <unistd.h>

#include "common/mesh_io/openmesh_io.h"
#include "common/base/replace_file.h"
#include "common/mesh_io/text_scanner.h"

namespace selvage {
namespace {

/// Calls write_line for each line of the comment.
template <class WriteLine>
void for_each_line(std::string_view text, const WriteLine& write_line) {
  while (!text.empty()) {
    const std::size_t length = std::min(text.find_first_of("\r\n"), text.size());
    if (length > 0) write_line(text.substr(0, length));
    text.remove_prefix(std::min(length + 1, text.size()));
  }
}

void append_comment(std::string& out, std::string_view prefix, std::string_view comment) {
  for_each_line(comment, [&](std::string_view line) { out.append(prefix).append(line).push_back('\n'); });
}

template <class Number>
void append_number(std::string& out, Number value) {
  std::array<char, 32> digits;
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  out.append(digits.data(), result.ptr);
}

void append_numbers(std::string& out, const Vec3& p) {
  for (int axis = 0; axis < 3; ++axis) {
    out.push_back(' ');
    append_number(out, p[axis]);
  }
  out.push_back('\n');
}

void append_indices(std::string& out, const Triangle& triangle, std::uint32_t first_index) {
  for (std::uint32_t index : triangle) {
    out.push_back(' ');
    append_number(out, index + std::uint64_t{first_index});
  }
  out.push_back('\n');
}

template <class Unsigned>
void append_little_endian(std::string& out, Unsigned value) {
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) out.push_back(static_cast<char>(value >> (8 * i)));
}

void append_f32(std::string& out, float value) {
  append_little_endian(out, std::bit_cast<std::uint32_t>(value));
}
void append_f64(std::string& out, double value) {
  append_little_endian(out, std::bit_cast<std::uint64_t>(value));
}

Result<std::string> format_ply(const TriangleSoup& soup, const WriteOptions& options) {
  std::string out = "ply\nformat binary_little_endian 1.0\n";
  append_comment(out, "comment ", options.comment);
  out += "element vertex " + std::to_string(soup.positions.size()) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
         std::to_string(soup.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  out.reserve(out.size() + 24 * soup.positions.size() + 13 * soup.triangles.size());
  for (const Vec3& p : soup.positions)
    for (int axis = 0; axis < 3; ++axis) append_f64(out, p[axis]);
  for (const Triangle& triangle : soup.triangles) {
    out.push_back(3);
    for (std::uint32_t index : triangle) append_little_endian(out, index);
  }
  return out;
}

Result<std::string> format_obj(const TriangleSoup& soup, const WriteOptions& options) {
  std::string out;
  append_comment(out, "# ", options.comment);
  for (const Vec3& p : soup.positions) append_numbers(out += 'v', p);
  for (const Triangle& triangle : soup.triangles) append_indices(out += 'f', triangle, 1);
  return out;
}

Result<std::string> format_off(const TriangleSoup& soup, const WriteOptions& options) {
  std::string out = "OFF\n";
  append_comment(out, "# ", options.comment);
  out += std::to_string(soup.positions.size()) + " " + std::to_string(soup.triangles.size()) + " 0\n";
  for (const Vec3& p : soup.positions) {
    const std::size_t start = out.size();
    append_numbers(out, p);
    out.erase(start, 1);  // the blank before the first number
  }
  for (const Triangle& triangle : soup.triangles) append_indices(out += '3', triangle, 0);
  return out;
}

/// 80 bytes that do not begin with "solid", which some readers take for ascii.
std::string stl_header(std::string_view comment) {
  std::string header =
      comment.empty() || equals_ignoring_case(comment.substr(0, 5), "solid") ? "binary STL " : "";
  header.append(comment.substr(0, 79)).resize(80, ' ');
  return header;
}

Result<std::string> format_stl(const TriangleSoup& soup, const WriteOptions& options) {
  std::string out = stl_header(options.comment);
  out.reserve(84 + 50 * soup.triangles.size());
  append_little_endian(out, static_cast<std::uint32_t>(soup.triangles.size()));
  for (const Triangle& triangle : soup.triangles) {
    const Vec3 &a = soup.positions[triangle[0]], &b = soup.positions[triangle[1]],
               &c = soup.positions[triangle[2]];
    for (const Vec3& v : {normalised(cross(b - a, c - a)), a, b, c}) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto rounded = static_cast<float>(v[axis]);
        if (!std::isfinite(rounded)) {
          return fail(ErrorCode::InvalidArgument,
                      "a coordinate is beyond the float32 range of STL; write .ply or .obj");
        }
        append_f32(out, rounded);
      }
    }
    append_little_endian(out, std::uint16_t{0});
  }
  return out;
}

constexpr std::array<std::string_view, 5> kExtensions = {".ply", ".obj", ".off", ".stl", ".om"};

tl::unexpected<Error> unknown_extension(const std::string& extension) {
  return fail(ErrorCode::Unsupported, "cannot write meshes with the extension " + quote(extension) +
                                          "; known are .ply .obj .off .stl .om");
}

Result<std::string> format_mesh(const std::string& extension, const TriangleSoup& soup,
                                const WriteOptions& options) {
  if (equals_ignoring_case(extension, ".ply")) return format_ply(soup, options);
  if (equals_ignoring_case(extension, ".obj")) return format_obj(soup, options);
  if (equals_ignoring_case(extension, ".off")) return format_off(soup, options);
  if (equals_ignoring_case(extension, ".stl")) return format_stl(soup, options);
  if (equals_ignoring_case(extension, ".om")) return format_om(soup);
  return unknown_extension(extension);
}

}  // namespace

Result<void> check_writable(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  const auto is_it = [&](std::string_view known) { return equals_ignoring_case(extension, known); };
  Result<void> ok;
  std::error_code ignored;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (std::ranges::none_of(kExtensions, is_it)) {
    ok = unknown_extension(extension);
  } else if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    ok = fail(ErrorCode::Io, std::string("cannot create a file there: ") + std::strerror(errno));
  } else if (std::filesystem::is_directory(path, ignored)) {
    ok = fail(ErrorCode::Io, "there is a folder of that name");
  }
  if (!ok) return forward_error(ok, path.string());
  return {};
}

Result<void> write_mesh(const std::filesystem::path& path, const TriangleSoup& soup,
                        const WriteOptions& options) {
  Result<std::string> content = format_mesh(path.extension().string(), soup, options);
  if (!content) return forward_error(content, path.string());
  Result<void> written = replace_file(path, *content);
  if (!written) return forward_error(written, path.string());
  return {};
}

}  // namespace selvage
