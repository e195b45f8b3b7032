// SPDX-License-Identifier: MIT
#include "common/pack/mapped_file.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <mutex>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace selvage {

/// What the signal handler, which may use nothing but atomics, knows of a mapping. Entries are used again,
/// and never freed: the handler may be looking at any of them.
struct MappedFile::Entry {
  std::atomic<std::uintptr_t> begin = 0;  ///< 0: nobody's
  std::atomic<std::size_t> size = 0;
  std::atomic<bool> is_damaged = false;
  Entry* next = nullptr;

  static std::atomic<Entry*> first;
  static Entry* add(const void* data, std::size_t size);
  static bool put_zeros_at(std::uintptr_t address);
};

std::atomic<MappedFile::Entry*> MappedFile::Entry::first = nullptr;

MappedFile::Entry* MappedFile::Entry::add(const void* data, std::size_t size) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  Entry* entry = first;
  while (entry != nullptr && entry->begin != 0) entry = entry->next;
  if (entry == nullptr) {
    entry = new Entry;
    entry->next = first;
    first = entry;
  }
  entry->is_damaged = false;
  entry->size = size;
  entry->begin = reinterpret_cast<std::uintptr_t>(data);
  return entry;
}

bool MappedFile::Entry::put_zeros_at(std::uintptr_t address) {
  const auto page_size = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  for (Entry* entry = first; entry != nullptr; entry = entry->next) {
    const std::uintptr_t begin = entry->begin;
    if (begin == 0 || address < begin || address - begin >= entry->size) continue;
    void* page = reinterpret_cast<void*>(address / page_size * page_size);
    entry->is_damaged = true;
    return ::mmap(page, page_size, PROT_READ, MAP_FIXED | MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == page;
  }
  return false;
}

void survive_truncated_files() {
  struct sigaction action {};
  action.sa_sigaction = [](int, siginfo_t* info, void*) {
    const int error = errno;
    const bool is_ours = info->si_code == BUS_ADRERR &&
                         MappedFile::Entry::put_zeros_at(reinterpret_cast<std::uintptr_t>(info->si_addr));
    if (!is_ours) {  // ends the process as it should, once we return
      std::signal(SIGBUS, SIG_DFL);
      std::raise(SIGBUS);
    }
    errno = error;
  };
  action.sa_flags = SA_SIGINFO;
  ::sigaction(SIGBUS, &action, nullptr);
}

Result<std::unique_ptr<MappedFile>> MappedFile::open(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    const auto code = errno == ENOENT ? ErrorCode::NotFound : ErrorCode::Io;
    return fail(code, path.string() + ": " + std::strerror(errno));
  }
  struct stat status {};
  const bool is_file = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0;
  const auto size = is_file ? static_cast<std::size_t>(status.st_size) : 0;
  void* data = is_file ? ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0) : MAP_FAILED;
  ::close(file);
  if (data == MAP_FAILED) return fail(ErrorCode::Io, path.string() + ": not a readable, non-empty file");
  const std::span bytes(static_cast<const std::byte*>(data), size);
  return std::unique_ptr<MappedFile>(new MappedFile(bytes, Entry::add(data, size)));
}

MappedFile::~MappedFile() {
  entry_->begin = 0;
  ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

bool MappedFile::is_damaged() const { return entry_->is_damaged; }
void MappedFile::mark_damaged() const { entry_->is_damaged = true; }

}  // namespace selvage
