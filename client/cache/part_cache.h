// SPDX-License-Identifier: MIT
//
// Parts on disk, by the hash of their bytes. A part that two packs share is there once; a pack that was
// replaced leaves its unchanged parts of use. What is read is checked against its hash, so nothing in the
// folder is believed: damage costs a download and nothing else.
//
// Several processes may share a folder without locks: a part appears whole, by a rename, and goes by an
// unlink that leaves it to whoever has it open.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/pack/directory.h"

namespace selvage {

inline constexpr std::uint64_t kDefaultCacheBytes = std::uint64_t{1} << 30;

/// Thread-safe.
class PartCache {
 public:
  /// Creates the folder where it is missing. `max_bytes` is what all parts may take up, each counted in
  /// blocks of 4 KiB as file systems do; processes that fill the cache at the same time may exceed it by a
  /// sixteenth each. Io if the folder cannot be written.
  static Result<PartCache> open(std::filesystem::path folder, std::uint64_t max_bytes = kDefaultCacheBytes);
  PartCache(PartCache&&) noexcept;

  /// The part's bytes, if they are here and are what `part` promises; a damaged file is removed.
  std::optional<std::vector<std::byte>> find(const PartRef& part);

  /// Keeps the bytes, whose hash was checked. Failure is silent, a cache need not keep anything: on a full
  /// disk parts are fetched again. Where the bound is met, those go that were not used for longest.
  void put(const Hash& hash, std::span<const std::byte> bytes);

  /// Whether parts of this source may be here: note_visit was called for it, by any process.
  bool has_visited(const std::string& source) const;
  void note_visit(const std::string& source);

  const std::filesystem::path& folder() const { return folder_; }

 private:
  PartCache(std::filesystem::path folder, std::uint64_t max_bytes);
  void evict();

  std::filesystem::path folder_;   ///< of the parts
  std::filesystem::path visited_;  ///< of an empty file a source
  std::uint64_t max_bytes_;
  std::mutex mutex_;
  /// That may be written before the folder is looked through. Nothing at first: who only reads never looks.
  std::uint64_t free_bytes_ = 0;
};

/// $XDG_CACHE_HOME/selvage or $HOME/.cache/selvage; nothing where neither is known.
std::optional<std::filesystem::path> default_cache_folder();

}  // namespace selvage
