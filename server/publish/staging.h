// SPDX-License-Identifier: MIT
//
// Where uploads lie until they are whole: a hidden folder in the store, a file each, named by what is
// uploaded and by whom. A file's length is what has been received, so an upload goes on after the connection,
// or the server, has died. Files that nobody comes back for are removed after a while.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "common/base/result.h"

namespace selvage {

/// An upload's file, open for appending.
class StagedFile {
 public:
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  std::uint64_t size() const { return size_; }
  const std::filesystem::path& path() const { return path_; }

  /// All or nothing, as far as size() is concerned.
  Result<void> append(std::span<const std::byte> bytes);

 private:
  friend class StagingFolder;
  StagedFile(std::filesystem::path path, int file, std::uint64_t size);

  std::filesystem::path path_;
  int file_;
  std::uint64_t size_;
};

/// Not thread-safe.
class StagingFolder {
 public:
  /// The folder is made when it is first needed. Packs that a killed server left half-written are removed.
  explicit StagingFolder(std::filesystem::path folder);

  /// A file that has more than `full_size` bytes begins anew. Errors do not name the folder.
  Result<std::unique_ptr<StagedFile>> open(const std::string& name, std::uint64_t full_size);

  void remove(const std::string& name);
  /// Those last written to before then.
  void remove_older_than(std::chrono::seconds age);
  std::uint64_t bytes_except(const std::string& name) const;

  /// For a pack that is about to be moved into the store.
  std::filesystem::path pack_path(const std::string& name) const;

 private:
  Result<void> make() const;

  const std::filesystem::path folder_;
};

}  // namespace selvage
