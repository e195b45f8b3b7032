// SPDX-License-Identifier: MIT
#include "server/store/pack_store.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sys/stat.h>

namespace selvage {
namespace {

constexpr std::size_t kMaxModelName = 128;

/// Clients see these errors: they name the model, and where the server keeps its files is left out.
Result<std::shared_ptr<const Pack>> open_pack(const std::string& name, const std::filesystem::path& path) {
  auto pack = Pack::open(path);
  if (pack) return pack;
  std::string& message = pack.error().message;
  const std::string prefix = path.string() + ": ";
  if (message.starts_with(prefix)) message.erase(0, prefix.size());
  return forward_error(pack, "model '" + name + "'");
}

}  // namespace

bool is_model_name(std::string_view name) {
  return !name.empty() && name.size() <= kMaxModelName && name.front() != '.' &&
         name.find_first_of(std::string_view("/\\\0", 3)) == std::string_view::npos;
}

PackStore::PackStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

Result<std::unique_ptr<PackStore>> PackStore::open_folder(std::filesystem::path folder) {
  std::error_code error;
  const auto status = std::filesystem::status(folder, error);
  if (!std::filesystem::exists(status))
    return fail(ErrorCode::NotFound, "no such folder: " + folder.string());
  if (!std::filesystem::is_directory(status)) {
    return fail(ErrorCode::InvalidArgument, "not a folder: " + folder.string());
  }
  return std::unique_ptr<PackStore>(new PackStore(std::move(folder)));
}

std::filesystem::path PackStore::path_of(std::string_view name) const {
  return folder_ / (std::string(name) + std::string(kPackExtension));
}

Result<PackStore::Stamp> PackStore::stamp_of(const std::filesystem::path& path) {
  struct stat status;
  if (::stat(path.c_str(), &status) != 0) {
    const ErrorCode code = errno == ENOENT ? ErrorCode::NotFound : ErrorCode::Io;
    return fail(code, path.string() + ": " + std::strerror(errno));
  }
  if (!S_ISREG(status.st_mode)) return fail(ErrorCode::NotFound, path.string() + ": not a file");
  return Stamp{status.st_ino, static_cast<std::uint64_t>(status.st_size),
               status.st_mtim.tv_sec * std::int64_t{1'000'000'000} + status.st_mtim.tv_nsec};
}

Result<PackStore::Model> PackStore::refresh(const std::string& name) {
  const std::filesystem::path path = path_of(name);
  auto stamp = stamp_of(path);
  if (!stamp) {
    const std::lock_guard lock(mutex_);
    opened_.erase(name);
    return forward_error(stamp);
  }
  {
    const std::lock_guard lock(mutex_);
    const auto known = opened_.find(name);
    if (known != opened_.end() && known->second.stamp == *stamp) {
      return Model{name, stamp->size_bytes, known->second.pack};
    }
  }
  // Outside the lock: a large pack must not hold up the others. Two callers may open the same file; either
  // will do.
  Result<std::shared_ptr<const Pack>> pack = open_pack(name, path);
  const std::lock_guard lock(mutex_);
  opened_.insert_or_assign(name, Opened{*stamp, pack});
  return Model{name, stamp->size_bytes, std::move(pack)};
}

Result<std::shared_ptr<const Pack>> PackStore::open(std::string_view name) {
  // One answer for both: whether a file exists outside the store is nobody's business.
  const auto not_found = [&] {
    return fail(ErrorCode::NotFound, "no model named '" + std::string(name) + "'");
  };
  if (!is_model_name(name)) return not_found();
  auto model = refresh(std::string(name));
  if (!model && model.error().code == ErrorCode::NotFound) return not_found();
  if (!model) return forward_error(model);
  return std::move(model->pack);
}

Result<std::vector<PackStore::Model>> PackStore::list() {
  std::vector<Model> models;
  std::error_code error;
  for (std::filesystem::directory_iterator at(folder_, error), end; !error && at != end;
       at.increment(error)) {
    const std::string name = at->path().stem().string();
    if (at->path().extension() != kPackExtension || !is_model_name(name)) continue;
    auto model = refresh(name);
    if (model) models.push_back(std::move(*model));  // else it went away just now
  }
  if (error) return fail(ErrorCode::Io, "the store cannot be read: " + error.message());
  std::ranges::sort(models, {}, &Model::name);
  return models;
}

}  // namespace selvage
