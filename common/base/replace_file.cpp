// SPDX-License-Identifier: MIT
#include "common/base/replace_file.h"

#include <cerrno>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <unistd.h>

namespace selvage {
namespace {

tl::unexpected<Error> fail_with_errno(std::string_view what) {
  const int code = errno;
  return fail(ErrorCode::Io, std::string(what) + ": " + std::strerror(code));
}

/// Open for writing under a name of its own; closed and removed unless it was renamed away.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& beside) {
    for (int attempt = 0; attempt < 100 && file_ < 0; ++attempt) {
      path_ = beside.string() + ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(attempt);
      file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (file_ < 0 && errno != EEXIST) return;
    }
  }
  ~TemporaryFile() {
    if (file_ >= 0) ::close(file_);
    if (!path_.empty() && is_ours_) ::unlink(path_.c_str());
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
    const int file = file_;
    file_ = -1;
    if (::close(file) != 0 || ::rename(path_.c_str(), path.c_str()) != 0) return false;
    is_ours_ = false;
    return true;
  }

 private:
  std::string path_;
  int file_ = -1;
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

}  // namespace selvage
