// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace selvage {

/// Whether files came, changed or went in a folder, as far as the kernel tells (inotify). It tells nothing of
/// what other machines do in a network folder, and may have no watch to spare: so look at the folder now and
/// then in any case. Single-threaded.
class FolderWatch {
 public:
  /// Only files whose names end so count.
  FolderWatch(std::filesystem::path folder, std::string_view extension);
  ~FolderWatch();
  FolderWatch(const FolderWatch&) = delete;
  FolderWatch& operator=(const FolderWatch&) = delete;

  /// Whether something has changed since the last call; true when it cannot know. What a call by this process
  /// changed is seen as soon as that call has returned.
  bool take_changes();

  bool is_working() const { return watch_ >= 0; }

 private:
  void start();

  const std::filesystem::path folder_;
  const std::string_view extension_;
  int queue_ = -1, watch_ = -1;
};

}  // namespace selvage
