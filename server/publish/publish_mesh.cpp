// SPDX-License-Identifier: MIT
#include "server/publish/publish_mesh.h"

#include <array>
#include <fstream>
#include <new>

#include "common/base/hasher.h"
#include "common/base/replace_file.h"
#include "common/mesh_io/read_mesh.h"
#include "server/ingest/repair_notes.h"
#include "server/publish/publish_options.h"

namespace selvage {
namespace {

/// In a published pack's metadata: what it was made from, so that a repeated request is known as such.
constexpr const char* kSourceHash = "source_hash";
constexpr const char* kCut = "cut";

std::string metadata_of(const Directory& directory, const char* key) {
  const auto found = directory.metadata.find(key);
  return found == directory.metadata.end() ? std::string() : found->second;
}

Result<void> check_hash(const Publish& request, const std::filesystem::path& upload,
                        const Progress& progress) {
  std::ifstream file(upload, std::ios::binary);
  Hasher hasher;
  std::vector<char> block(1u << 20);
  std::uint64_t size = 0;
  while (file) {
    if (!progress("check", static_cast<double>(size) / static_cast<double>(request.size_bytes))) {
      return fail(ErrorCode::Cancelled, "cancelled");
    }
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    const auto count = static_cast<std::size_t>(file.gcount());
    hasher.add(std::as_bytes(std::span(block.data(), count)));
    size += count;
  }
  if (size != request.size_bytes || hasher.finish() != request.hash) {
    return fail(ErrorCode::BadStream,
                request.file + ": what arrived is not what was announced; publish it again");
  }
  return {};
}

/// The reader names the file that it was given; the publisher knows it by another name.
Error as_publisher_knows(Error error, const Publish& request, const std::filesystem::path& upload) {
  const std::string path = upload.string();
  for (std::size_t at = error.message.find(path); at != std::string::npos; at = error.message.find(path)) {
    error.message.replace(at, path.size(), request.file);
  }
  return error;
}

}  // namespace

Error name_in_use(const std::string& name) {
  return {ErrorCode::InvalidArgument,
          "there is a model named '" + name + "' already; replace it, or choose another name"};
}

bool is_result_of(const Directory& directory, const Publish& request) {
  return metadata_of(directory, kSourceHash) == request.hash.to_hex() &&
         metadata_of(directory, kCut) == to_text(request.cut) && directory.grid.bits == request.bits &&
         directory.is_exact == request.lossless && directory.units == request.units;
}

Published describe(const Publish& request, const Pack& pack) {
  Published published;
  published.name = request.name;
  published.pack_id = pack.id();
  published.size_bytes = pack.bytes().size();
  published.regions = pack.directory().real_region_count();
  published.vertices = pack.directory().vertices;
  published.triangles = pack.directory().triangles;
  return published;
}

Result<Published> publish_mesh(const Publish& request, const PublishPaths& paths, const ParallelFor& parallel,
                               const Progress& progress) try {
  if (auto ok = check_hash(request, paths.upload, progress); !ok) return forward_error(ok);
  progress("read", 0);
  auto file = read_mesh(paths.upload);
  if (!file) return tl::unexpected(as_publisher_knows(std::move(file.error()), request, paths.upload));
  auto options = ingest_options(request, *file);
  if (!options) return forward_error(options, request.file);
  options->metadata[kSourceHash] = request.hash.to_hex();
  if (const std::string cut = to_text(request.cut); !cut.empty()) options->metadata[kCut] = cut;
  auto model = ingest(file->soup, *options, parallel, progress);
  if (!model) return forward_error(model, model.error().code == ErrorCode::Cancelled ? "" : request.file);
  if (!progress("write", 0)) return fail(ErrorCode::Cancelled, "cancelled");

  const std::string_view bytes(reinterpret_cast<const char*>(model->pack.data()), model->pack.size());
  const auto if_exists = request.replace ? IfExists::Replace : IfExists::Refuse;
  if (auto ok = place_file(paths.target, bytes, paths.temporary, if_exists); !ok) {
    if (ok.error().code == ErrorCode::InvalidArgument) return tl::unexpected(name_in_use(request.name));
    return forward_error(ok, "the server cannot keep the pack");
  }
  std::vector<std::string> notes = std::move(file->notes);
  for (std::string& note : notes_of(model->repair)) notes.push_back(std::move(note));
  auto pack = Pack::from_bytes(std::move(model->pack));
  if (!pack) return forward_error(pack);
  Published published = describe(request, **pack);
  published.notes = std::move(notes);
  return published;
} catch (const std::bad_alloc&) {
  return fail(ErrorCode::LimitExceeded, request.file + ": the server has not enough memory for this model");
}

}  // namespace selvage
