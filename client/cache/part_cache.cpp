// SPDX-License-Identifier: MIT
#include "client/cache/part_cache.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/pack/pack.h"

namespace selvage {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kBlock = 4096;
constexpr std::string_view kTemporary = ".tmp-";
/// A temporary file older than this was left by a process that died.
constexpr auto kStale = std::chrono::hours(1);

std::uint64_t footprint(std::uint64_t bytes) { return (bytes + kBlock - 1) / kBlock * kBlock; }

/// FOLDER/ab/cdef...: 256 folders, so that none grows too large for its file system.
fs::path path_of(const fs::path& folder, const Hash& hash) {
  const std::string hex = hash.to_hex();
  return folder / hex.substr(0, 2) / hex.substr(2);
}

class File {
 public:
  explicit File(int descriptor) : descriptor_(descriptor) {}
  ~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }

  /// False unless the file has exactly so many bytes.
  bool read_all(std::span<std::byte> into) const {
    while (!into.empty()) {
      const ssize_t count = ::read(descriptor_, into.data(), into.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      into = into.subspan(static_cast<std::size_t>(count));
    }
    std::byte beyond;
    return ::read(descriptor_, &beyond, 1) == 0;
  }

  bool write_all(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return true;
  }

 private:
  int descriptor_;
};

/// Another in every process and every call.
std::string temporary_name() {
  static std::atomic<std::uint64_t> calls = 0;
  return std::string(kTemporary) + std::to_string(::getpid()) + "-" + std::to_string(calls++);
}

struct CachedFile {
  fs::path path;
  fs::file_time_type used;
  std::uint64_t bytes;
};

/// Whatever other processes do meanwhile: a file that goes while we look is as good as one that never was.
std::vector<CachedFile> list_files(const fs::path& folder) {
  std::vector<CachedFile> files;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code gone;
    if (!it->is_regular_file(gone)) continue;
    const fs::file_time_type used = it->last_write_time(gone);
    const std::uint64_t size = gone ? 0 : it->file_size(gone);
    if (!gone) files.push_back({it->path(), used, footprint(size)});
  }
  return files;
}

}  // namespace

PartCache::PartCache(fs::path folder, std::uint64_t max_bytes)
    : folder_(folder / "parts"), visited_(folder / "visited"), max_bytes_(max_bytes) {}

PartCache::PartCache(PartCache&& other) noexcept
    : folder_(std::move(other.folder_)),
      visited_(std::move(other.visited_)),
      max_bytes_(other.max_bytes_),
      free_bytes_(other.free_bytes_) {}

Result<PartCache> PartCache::open(fs::path folder, std::uint64_t max_bytes) {
  PartCache cache(folder, max_bytes);
  std::error_code error;
  fs::create_directories(cache.folder_, error);
  if (!error) fs::create_directories(cache.visited_, error);
  if (!error && ::access(cache.folder_.c_str(), W_OK | X_OK) != 0)
    error.assign(errno, std::generic_category());
  if (error) {
    return fail(ErrorCode::Io, cache.folder_.string() + ": no cache can be kept there (" + error.message() +
                                   "); choose another folder, or none");
  }
  return cache;
}

std::optional<std::vector<std::byte>> PartCache::find(const PartRef& part) {
  const fs::path path = path_of(folder_, part.hash);
  const File file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  if (!file.is_open()) return std::nullopt;
  std::vector<std::byte> bytes(part.size);
  if (!file.read_all(bytes) || !check_part(part, bytes)) {
    ::unlink(path.c_str());
    return std::nullopt;
  }
  ::futimens(file.descriptor(), nullptr);  // used just now: what eviction goes by
  return bytes;
}

void PartCache::put(const Hash& hash, std::span<const std::byte> bytes) {
  const std::uint64_t size = footprint(bytes.size());
  // One part must not push all others out.
  if (size > max_bytes_ / 4) return;
  {
    const std::scoped_lock lock(mutex_);
    if (free_bytes_ < size) evict();
    free_bytes_ -= std::min(free_bytes_, size);
  }
  const fs::path path = path_of(folder_, hash);
  const fs::path temporary = folder_ / temporary_name();
  bool is_written = false;
  {
    // Not forced to the disk: what a crash tears does not match its hash.
    const File file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666));
    if (!file.is_open()) return;
    is_written = file.write_all(bytes);
  }
  if (is_written && ::rename(temporary.c_str(), path.c_str()) == 0) return;
  std::error_code ignored;
  fs::create_directory(path.parent_path(), ignored);
  if (!is_written || ::rename(temporary.c_str(), path.c_str()) != 0) ::unlink(temporary.c_str());
}

bool PartCache::has_visited(const std::string& source) const {
  return ::access((visited_ / hash_of(std::as_bytes(std::span(source))).to_hex()).c_str(), F_OK) == 0;
}

void PartCache::note_visit(const std::string& source) {
  const fs::path path = visited_ / hash_of(std::as_bytes(std::span(source))).to_hex();
  const File file(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666));
}

/// Leaves a sixteenth free, so that the folder is looked through once for many parts.
void PartCache::evict() {
  std::vector<CachedFile> files = list_files(folder_);
  std::ranges::sort(files, {}, &CachedFile::used);
  const std::uint64_t target = max_bytes_ - max_bytes_ / 16;
  const auto stale_before = fs::file_time_type::clock::now() - kStale;
  std::uint64_t used = 0;
  for (const CachedFile& file : files) used += file.bytes;
  for (const CachedFile& file : files) {
    const bool is_temporary = file.path.filename().string().starts_with(kTemporary);
    const bool goes = is_temporary ? file.used < stale_before : used > target;
    if (!goes) continue;
    ::unlink(file.path.c_str());
    used -= file.bytes;
  }
  free_bytes_ = used < max_bytes_ ? std::min(max_bytes_ - used, max_bytes_ / 16) : 0;
}

std::optional<fs::path> default_cache_folder() {
  // A relative XDG_CACHE_HOME is to be ignored, says its specification.
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg != nullptr && *xdg == '/')
    return fs::path(xdg) / "selvage";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/')
    return fs::path(home) / ".cache" / "selvage";
  return std::nullopt;
}

}  // namespace selvage
