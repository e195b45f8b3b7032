// SPDX-License-Identifier: MIT
//
// The models that a server offers: a folder of packs, `NAME.selvage` each. The folder is looked at on every
// call, so packs that appear, change or go are noticed without anyone telling. A damaged pack is an error
// with its reason for whoever opens it, and no concern of the others.
//
// Packs must be replaced by renaming a whole file over the old one: a mapped file that is truncated in place
// would take the process down. A replaced pack lives on for those who have it open.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "common/pack/pack.h"

namespace selvage {

inline constexpr std::string_view kPackExtension = ".selvage";

/// A model's name is the stem of its file's name: 1 to 128 bytes, no slash or backslash, no leading dot.
/// What else it holds is for the file system and the wire to judge.
bool is_model_name(std::string_view name);

/// Thread-safe. Calls touch the disk: keep them off I/O threads.
class PackStore {
 public:
  struct Model {
    std::string name;
    std::uint64_t size_bytes = 0;  ///< of the file
    Result<std::shared_ptr<const Pack>> pack;
  };

  /// NotFound or InvalidArgument unless `folder` is one. It stays watched, not locked: others may write to
  /// it.
  static Result<std::unique_ptr<PackStore>> open_folder(std::filesystem::path folder);

  /// The pack of that name as it is on disk now. NotFound: no such model, or a name that could not be one;
  /// otherwise what Pack::open says. Errors name the model, not the folder.
  Result<std::shared_ptr<const Pack>> open(std::string_view name);

  /// All models, ascending by name (bytewise), damaged ones with their errors. Io if the folder cannot be
  /// read.
  Result<std::vector<Model>> list();

 private:
  /// Tells one state of a file from another; renaming a file into place changes the inode.
  struct Stamp {
    std::uint64_t inode = 0, size_bytes = 0;
    std::int64_t modified_ns = 0;
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  struct Opened {
    Stamp stamp;
    Result<std::shared_ptr<const Pack>> pack;
  };

  explicit PackStore(std::filesystem::path folder);
  static Result<Stamp> stamp_of(const std::filesystem::path& path);
  std::filesystem::path path_of(std::string_view name) const;
  Result<Model> refresh(const std::string& name);

  const std::filesystem::path folder_;
  std::mutex mutex_;
  std::map<std::string, Opened, std::less<>> opened_;  ///< as found at the last look, guarded by mutex_
};

}  // namespace selvage
