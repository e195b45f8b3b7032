// SPDX-License-Identifier: MIT
#include "server/store/pack_store.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>
#include <sys/stat.h>

#include "common/base/replace_file.h"

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

PackStore::PackStore(std::filesystem::path folder, Options options)
    : folder_(std::move(folder)), options_(std::move(options)), watch_(folder_, kPackExtension) {}

Result<std::unique_ptr<PackStore>> PackStore::open_folder(std::filesystem::path folder) {
  return open_folder(std::move(folder), Options());
}

Result<std::unique_ptr<PackStore>> PackStore::open_folder(std::filesystem::path folder, Options options) {
  std::error_code error;
  const auto status = std::filesystem::status(folder, error);
  if (!std::filesystem::exists(status))
    return fail(ErrorCode::NotFound, "no such folder: " + folder.string());
  if (!std::filesystem::is_directory(status)) {
    return fail(ErrorCode::InvalidArgument, "not a folder: " + folder.string());
  }
  return std::unique_ptr<PackStore>(new PackStore(std::move(folder), std::move(options)));
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

/// Makes `opened_` say of one model what the disk says.
Result<void> PackStore::refresh(const std::string& name) {
  const std::filesystem::path path = path_of(name);
  auto stamp = stamp_of(path);
  if (!stamp) {
    forget(name);
    return forward_error(stamp);
  }
  {
    const std::lock_guard lock(mutex_);
    const auto known = opened_.find(name);
    if (known != opened_.end()) {
      const Opened& opened = known->second;
      if (opened.stamp == *stamp && !(opened.pack && (*opened.pack)->is_damaged())) return {};
      if (opened.pack && opened.stamp.inode == stamp->inode) (*opened.pack)->mark_damaged();
    }
  }
  // Outside the lock: a large pack must not hold up the others. Two callers may open the same file; either
  // will do.
  Result<std::shared_ptr<const Pack>> pack = open_pack(name, path);
  StoreEvent::Kind kind = pack ? StoreEvent::Kind::Appeared : StoreEvent::Kind::Refused;
  const std::string reason = pack ? "" : pack.error().to_string();
  {
    const std::lock_guard lock(mutex_);
    const auto [at, is_new] = opened_.insert_or_assign(name, Opened{*stamp, std::move(pack)});
    if (!is_new && kind == StoreEvent::Kind::Appeared) kind = StoreEvent::Kind::Replaced;
  }
  tell(kind, name, stamp->size_bytes, reason);
  return {};
}

void PackStore::forget(const std::string& name) {
  {
    const std::lock_guard lock(mutex_);
    if (opened_.erase(name) == 0) return;
  }
  tell(StoreEvent::Kind::Gone, name, 0);
}

void PackStore::tell(StoreEvent::Kind kind, const std::string& name, std::uint64_t size_bytes,
                     std::string reason) const {
  if (options_.on_event) options_.on_event({kind, name, size_bytes, std::move(reason)});
}

Result<std::shared_ptr<const Pack>> PackStore::open(std::string_view name) {
  // One answer for both: whether a file exists outside the store is nobody's business.
  const auto not_found = [&] {
    return fail(ErrorCode::NotFound, "no model named '" + std::string(name) + "'");
  };
  if (!is_model_name(name)) return not_found();
  auto refreshed = refresh(std::string(name));
  if (!refreshed && refreshed.error().code == ErrorCode::NotFound) return not_found();
  if (!refreshed) return forward_error(refreshed);
  const std::lock_guard lock(mutex_);
  const auto known = opened_.find(name);
  if (known == opened_.end()) return not_found();  // it went away just now
  return known->second.pack;
}

bool PackStore::must_look() {
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  const bool is_due = looked_ == Clock::time_point() || now - looked_ >= options_.poll_interval;
  if (!watch_.take_changes() && !is_due) return false;
  looked_ = now;
  return true;
}

/// Reads the folder.
Result<void> PackStore::look() {
  std::set<std::string, std::less<>> found;
  std::error_code error;
  for (std::filesystem::directory_iterator at(folder_, error), end; !error && at != end;
       at.increment(error)) {
    const std::string name = at->path().stem().string();
    if (at->path().extension() != kPackExtension || !is_model_name(name)) continue;
    if (refresh(name)) found.insert(name);  // else it went away just now, or is no file
  }
  if (error) {
    const std::lock_guard lock(mutex_);
    looked_ = {};
    return fail(ErrorCode::Io, "the store cannot be read: " + error.message());
  }
  std::vector<std::string> gone;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [name, opened] : opened_) {
      if (!found.contains(name)) gone.push_back(name);
    }
  }
  for (const std::string& name : gone) {
    if (!stamp_of(path_of(name))) forget(name);  // not one that came while we looked
  }
  return {};
}

Result<std::vector<PackStore::Model>> PackStore::list() {
  {
    // Who comes while another looks waits for what that one finds.
    const std::lock_guard one_at_a_time(looking_);
    if (must_look()) {
      if (auto looked = look(); !looked) return forward_error(looked);
    }
  }
  const std::lock_guard lock(mutex_);
  std::vector<Model> models;
  models.reserve(opened_.size());
  for (const auto& [name, opened] : opened_) models.push_back({name, opened.stamp.size_bytes, opened.pack});
  return models;
}

Result<void> PackStore::remove(const std::string& name) {
  const auto not_found = [&] { return fail(ErrorCode::NotFound, "no model named '" + name + "'"); };
  if (!is_model_name(name)) return not_found();
  const std::filesystem::path path = path_of(name);
  if (!stamp_of(path)) return not_found();
  std::error_code error;
  if (!std::filesystem::remove(path, error) && !error) return not_found();
  if (error) return fail(ErrorCode::Io, "model '" + name + "' cannot be removed: " + error.message());
  forget(name);
  return sync_folder(folder_);
}

PackStore::Summary PackStore::summary() const {
  const std::lock_guard lock(mutex_);
  Summary summary;
  for (const auto& [name, opened] : opened_) {
    ++summary.models;
    summary.bytes += opened.stamp.size_bytes;
    if (!opened.pack) summary.refused.emplace_back(name, opened.pack.error().to_string());
  }
  return summary;
}

}  // namespace selvage
