// SPDX-License-Identifier: MIT
//
// The models that a server offers: a folder of packs, `NAME.selvage` each. The folder is watched, so packs
// that appear, change or go are noticed without anyone telling. A damaged pack is an error with its reason
// for whoever opens it, and no concern of the others.
//
// Packs must be replaced by renaming a whole file over the old one: then the old one lives on for those who
// have it open. One that is overwritten in place is marked as damaged for them.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "common/pack/pack.h"
#include "server/store/folder_watch.h"

namespace selvage {

inline constexpr std::string_view kPackExtension = ".selvage";

/// A model's name is the stem of its file's name: 1 to 128 bytes, no slash or backslash, no leading dot.
/// What else it holds is for the file system and the wire to judge.
bool is_model_name(std::string_view name);

/// Something that happened to a model, for logs.
struct StoreEvent {
  enum class Kind { Appeared, Replaced, Refused, Gone };
  Kind kind = Kind::Appeared;
  std::string model;
  std::uint64_t size_bytes = 0;
  std::string reason;  ///< of Refused: what is wrong with the pack
};

/// Thread-safe. Calls touch the disk: keep them off I/O threads.
class PackStore {
 public:
  struct Model {
    std::string name;
    std::uint64_t size_bytes = 0;  ///< of the file
    Result<std::shared_ptr<const Pack>> pack;
  };
  struct Options {
    /// The folder is read this often even if the kernel tells of no change, as it does not of changes that
    /// other machines make; always where there is no watch at all.
    std::chrono::milliseconds poll_interval{10'000};
    /// Called for each event, on the thread whose call noticed it; must not call the store.
    std::function<void(const StoreEvent&)> on_event;
  };

  /// NotFound or InvalidArgument unless `folder` is one. It stays watched, not locked: others may write to
  /// it.
  static Result<std::unique_ptr<PackStore>> open_folder(std::filesystem::path folder);
  static Result<std::unique_ptr<PackStore>> open_folder(std::filesystem::path folder, Options options);

  /// The pack of that name as it is on disk now. NotFound: no such model, or a name that could not be one;
  /// otherwise what Pack::open says. Errors name the model, not the folder.
  Result<std::shared_ptr<const Pack>> open(std::string_view name);

  /// All models, ascending by name (bytewise), damaged ones with their errors. Io if the folder cannot be
  /// read.
  Result<std::vector<Model>> list();

  /// Takes a model away: nobody can open it any more, and who has it open keeps it. NotFound; Io.
  Result<void> remove(const std::string& name);

  /// What the last look found; touches no disk.
  struct Summary {
    std::uint32_t models = 0;
    std::uint64_t bytes = 0;
    std::vector<std::pair<std::string, std::string>> refused;  ///< damaged packs and what is wrong with them
  };
  Summary summary() const;

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path path_of(std::string_view name) const;

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
  using Clock = std::chrono::steady_clock;

  PackStore(std::filesystem::path folder, Options options);
  static Result<Stamp> stamp_of(const std::filesystem::path& path);
  bool must_look();
  Result<void> look();
  Result<void> refresh(const std::string& name);
  void forget(const std::string& name);
  void tell(StoreEvent::Kind kind, const std::string& name, std::uint64_t size_bytes,
            std::string reason = {}) const;

  const std::filesystem::path folder_;
  const Options options_;
  std::mutex looking_;  ///< one reads the folder at a time
  mutable std::mutex mutex_;
  std::map<std::string, Opened, std::less<>> opened_;  ///< as found at the last look, guarded by mutex_
  FolderWatch watch_;                                  ///< guarded by mutex_
  Clock::time_point looked_{};                         ///< guarded by mutex_
};

}  // namespace selvage
