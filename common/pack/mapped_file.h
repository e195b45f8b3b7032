// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

#include "common/base/result.h"

namespace selvage {

/// A file's bytes, mapped and not copied. The file need not stay open, and may be removed or replaced.
/// Whoever cuts it short or writes into it changes these bytes, too: see is_damaged().
class MappedFile {
 public:
  /// NotFound or Io name the file.
  static Result<std::unique_ptr<MappedFile>> open(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::byte> bytes() const { return bytes_; }

  /// Bytes were read that the file has no more, and zeros were given instead; or somebody knows better and
  /// said so. From any thread.
  bool is_damaged() const;
  void mark_damaged() const;

 private:
  friend void survive_truncated_files();
  struct Entry;
  MappedFile(std::span<const std::byte> bytes, Entry* entry) : bytes_(bytes), entry_(entry) {}

  std::span<const std::byte> bytes_;
  Entry* entry_;
};

/// Reading a mapped byte that the file has no more ends a process by SIGBUS. After this call it does not:
/// zeros stand in, and the mapping is damaged. For servers; a signal handler is the whole process's.
void survive_truncated_files();

}  // namespace selvage
