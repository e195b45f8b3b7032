// SPDX-License-Identifier: MIT
#include "common/mesh_io/read_mesh.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <span>

#include "common/mesh_io/obj.h"
#include "common/mesh_io/off.h"
#include "common/mesh_io/openmesh_io.h"
#include "common/mesh_io/ply.h"
#include "common/mesh_io/stl.h"
#include "common/mesh_io/text_scanner.h"
#include "common/mesh_io/wrl.h"

namespace selvage {
namespace {

struct Format {
  std::string_view extension;
  std::string_view name;
  Result<MeshFile> (*parse)(std::span<const std::byte>);
};

constexpr std::array<Format, 6> kFormats = {{
    {".ply", "PLY", parse_ply},
    {".obj", "OBJ", parse_obj},
    {".off", "OFF", parse_off},
    {".stl", "STL", parse_stl},
    {".wrl", "WRL", parse_wrl},
    {".om", "OM", parse_om},
}};

const Format* format_of(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  for (const Format& format : kFormats)
    if (equals_ignoring_case(format.extension, extension)) return &format;
  return nullptr;
}

/// The name of the format whose signature the bytes begin with; empty where there is none (OBJ, binary STL).
std::string_view recognise(std::span<const std::byte> bytes) {
  const std::string_view text = as_text(bytes);
  if (text.starts_with("\x1f\x8b")) return "gzip";
  if (text.starts_with("\xfd"
                       "7zXZ"))
    return "xz";
  if (text.starts_with("PK\x03\x04")) return "zip";
  if (text.starts_with("#VRML")) return "WRL";
  if (text.starts_with("ply\n") || text.starts_with("ply\r")) return "PLY";
  TextScanner scan(bytes.first(std::min<std::size_t>(bytes.size(), 4096)), {.comment = '#'});
  if (!scan.at_end() && is_off_keyword(scan.peek())) return "OFF";
  return "";
}

Result<void> check_content(const Format& format, std::span<const std::byte> bytes) {
  const std::string_view found = recognise(bytes);
  if (found.empty() || found == format.name) return {};
  if (format.name == "STL" && is_exact_binary_stl(bytes)) return {};
  const bool is_packed = found == "gzip" || found == "xz" || found == "zip";
  return fail(ErrorCode::BadFile, "the extension says " + std::string(format.name) + ", but the content is " +
                                      std::string(found) +
                                      (is_packed ? "; unpack it first" : "; rename the file"));
}

struct FileBytes {
  std::unique_ptr<std::byte[]> data;
  std::size_t size = 0;
  std::span<const std::byte> span() const { return {data.get(), size}; }
};

std::string system_message() { return std::strerror(errno); }

Result<FileBytes> read_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return fail(ErrorCode::NotFound, "no such file");
  if (!std::filesystem::is_regular_file(path, error)) return fail(ErrorCode::Io, "not a regular file");
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) return fail(ErrorCode::Io, "cannot be opened: " + system_message());
  FileBytes file;
  file.size = static_cast<std::size_t>(in.tellg());
  file.data = std::make_unique_for_overwrite<std::byte[]>(file.size);
  in.seekg(0);
  in.read(reinterpret_cast<char*>(file.data.get()), static_cast<std::streamsize>(file.size));
  if (!in) return fail(ErrorCode::Io, "cannot be read: " + system_message());
  return file;
}

Result<MeshFile> read_and_parse(const std::filesystem::path& path) {
  const Format* format = format_of(path);
  if (!format) {
    return fail(ErrorCode::Unsupported, "unknown mesh format " + quote(path.extension().string()) +
                                            "; known are .ply .obj .off .stl .wrl .om");
  }
  Result<FileBytes> file = read_file(path);
  if (!file) return forward_error(file);
  if (file->size == 0) return fail(ErrorCode::BadFile, "the file is empty");
  Result<void> content = check_content(*format, file->span());
  if (!content) return forward_error(content);
  return format->parse(file->span());
}

}  // namespace

Result<MeshFile> read_mesh(const std::filesystem::path& path) {
  Result<MeshFile> file = read_and_parse(path);
  if (!file) return forward_error(file, path.string());
  return file;
}

bool is_mesh_file_name(const std::filesystem::path& path) { return format_of(path) != nullptr; }

}  // namespace selvage
