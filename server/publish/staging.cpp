// SPDX-License-Identifier: MIT
#include "server/publish/staging.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace selvage {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kUnfinishedPack = ".unfinished";

tl::unexpected<Error> cannot_keep(int code) {
  return fail(ErrorCode::Io, std::string("the server cannot keep the upload: ") + std::strerror(code));
}

template <class Visit>
void for_each_file(const fs::path& folder, Visit visit) {
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code gone;
    if (at->is_regular_file(gone)) visit(*at);
  }
}

}  // namespace

StagedFile::StagedFile(fs::path path, int file, std::uint64_t size)
    : path_(std::move(path)), file_(file), size_(size) {}

StagedFile::~StagedFile() { ::close(file_); }

Result<void> StagedFile::append(std::span<const std::byte> bytes) {
  std::uint64_t at = size_;
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return cannot_keep(written < 0 ? errno : ENOSPC);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    at += static_cast<std::uint64_t>(written);
  }
  size_ = at;
  return {};
}

StagingFolder::StagingFolder(fs::path folder) : folder_(std::move(folder)) {
  for_each_file(folder_, [](const fs::directory_entry& file) {
    std::error_code ignored;
    if (file.path().extension() == kUnfinishedPack) fs::remove(file.path(), ignored);
  });
}

Result<void> StagingFolder::make() const {
  std::error_code error;
  fs::create_directory(folder_, error);
  if (error) return cannot_keep(error.value());
  fs::permissions(folder_, fs::perms::owner_all, error);
  return {};
}

Result<std::unique_ptr<StagedFile>> StagingFolder::open(const std::string& name, std::uint64_t full_size) {
  if (auto made = make(); !made) return forward_error(made);
  const fs::path path = folder_ / name;
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return cannot_keep(errno);
  struct stat status {};
  if (::fstat(file, &status) != 0 || (static_cast<std::uint64_t>(status.st_size) > full_size &&
                                      (::ftruncate(file, 0) != 0 || ::fstat(file, &status) != 0))) {
    const int code = errno;
    ::close(file);
    return cannot_keep(code);
  }
  return std::unique_ptr<StagedFile>(new StagedFile(path, file, static_cast<std::uint64_t>(status.st_size)));
}

void StagingFolder::remove(const std::string& name) {
  std::error_code ignored;
  fs::remove(folder_ / name, ignored);
}

void StagingFolder::remove_older_than(std::chrono::seconds age) {
  const auto limit = fs::file_time_type::clock::now() - age;
  for_each_file(folder_, [&](const fs::directory_entry& file) {
    std::error_code error;
    const auto written = file.last_write_time(error);
    if (!error && written < limit) fs::remove(file.path(), error);
  });
}

std::uint64_t StagingFolder::bytes_except(const std::string& name) const {
  std::uint64_t sum = 0;
  for_each_file(folder_, [&](const fs::directory_entry& file) {
    std::error_code error;
    const auto size = file.file_size(error);
    if (!error && file.path().filename() != name) sum += size;
  });
  return sum;
}

fs::path StagingFolder::pack_path(const std::string& name) const {
  return folder_ / (name + std::string(kUnfinishedPack));
}

}  // namespace selvage
