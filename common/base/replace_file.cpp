// SPDX-License-Identifier: MIT
#include "common/base/replace_file.h"

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace selvage {
namespace {

tl::unexpected<Error> fail_with_errno(std::string_view what) {
  const int code = errno;
  return fail(ErrorCode::Io, std::string(what) + ": " + std::strerror(code));
}

/// Open for writing; closed and removed unless it was renamed away. Where the file system can, it has no name
/// before it is whole, so that not even kill -9 leaves anything behind; otherwise one of its own.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& beside) : path_(beside.string()) {
    const std::filesystem::path folder = beside.has_parent_path() ? beside.parent_path() : ".";
    file_ = ::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
    if (file_ >= 0 && ::access(descriptor_path().c_str(), F_OK) == 0) return;
    if (file_ >= 0) ::close(file_);
    const auto open = [this](const std::string& path) {
      return file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    };
    is_named_ = with_name_of_its_own([&](const std::string& path) { return open(path) >= 0; });
  }
  struct Exactly {
    std::filesystem::path path;
  };
  /// At this place and no other; what is there is overwritten.
  explicit TemporaryFile(const Exactly& place) : path_(place.path.string()), is_named_(true) {
    file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  }
  ~TemporaryFile() {
    if (file_ >= 0) ::close(file_);
    if (is_named_ && is_ours_) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  bool is_open() const { return file_ >= 0; }

  bool write(std::string_view content) {
    is_ours_ = true;
    while (!content.empty()) {
      const ssize_t written = ::write(file_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) return false;
      content.remove_prefix(static_cast<std::size_t>(written));
    }
    return ::fsync(file_) == 0;
  }

  bool rename_to(const std::filesystem::path& path) {
    if (!has_name() || !close() || ::rename(path_.c_str(), path.c_str()) != 0) return false;
    is_ours_ = false;
    return true;
  }

  /// A second name, which must be free; the destructor removes the first.
  bool link_to(const std::filesystem::path& path) {
    return close() && ::link(path_.c_str(), path.c_str()) == 0;
  }

 private:
  bool close() { return ::close(std::exchange(file_, -1)) == 0; }

  std::string descriptor_path() const { return "/proc/self/fd/" + std::to_string(file_); }

  /// Tries names beside path_ until one is free, which path_ is from then on.
  template <class Take>
  bool with_name_of_its_own(const Take& take) {
    const std::string beside = path_;
    for (int attempt = 0; attempt < 100; ++attempt) {
      path_ = beside + ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(attempt);
      if (take(path_)) return true;
      if (errno != EEXIST) return false;
    }
    return false;
  }

  bool has_name() {
    if (is_named_) return true;
    return is_named_ = with_name_of_its_own([this](const std::string& path) {
             return ::linkat(AT_FDCWD, descriptor_path().c_str(), AT_FDCWD, path.c_str(),
                             AT_SYMLINK_FOLLOW) == 0;
           });
  }

  std::string path_;
  int file_ = -1;
  bool is_named_ = false;
  bool is_ours_ = false;
};

}  // namespace

Result<void> replace_file(const std::filesystem::path& path, std::string_view content) {
  TemporaryFile file(path);
  if (!file.is_open()) return fail_with_errno("cannot create a file there");
  if (!file.write(content)) return fail_with_errno("cannot write");
  if (!file.rename_to(path)) return fail_with_errno("cannot move the new file into place");
  return {};
}

Result<void> place_file(const std::filesystem::path& path, std::string_view content,
                        const std::filesystem::path& temporary, IfExists if_exists) {
  {
    TemporaryFile file(TemporaryFile::Exactly{temporary});
    if (!file.is_open()) return fail_with_errno("cannot create a file there");
    if (!file.write(content)) return fail_with_errno("cannot write");
    const bool is_placed = if_exists == IfExists::Replace ? file.rename_to(path) : file.link_to(path);
    if (!is_placed && errno == EEXIST)
      return fail(ErrorCode::InvalidArgument, "there is a file of that name");
    if (!is_placed) return fail_with_errno("cannot move the new file into place");
  }
  return sync_folder(path.parent_path());
}

Result<void> sync_folder(const std::filesystem::path& folder) {
  const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return fail_with_errno("cannot open the folder");
  const bool is_synced = ::fsync(file) == 0;
  const int code = errno;
  ::close(file);
  errno = code;
  if (!is_synced) return fail_with_errno("cannot put the folder on the disk");
  return {};
}

}  // namespace selvage
