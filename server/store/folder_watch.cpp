// SPDX-License-Identifier: MIT
#include "server/store/folder_watch.h"

#include <cstddef>

#include <sys/inotify.h>
#include <unistd.h>

namespace selvage {
namespace {

/// A file counts once it is whole: renamed into place, or closed by whoever wrote it.
constexpr std::uint32_t kFileEvents = IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE;
constexpr std::uint32_t kFolderGone = IN_DELETE_SELF | IN_MOVE_SELF | IN_IGNORED | IN_UNMOUNT;

}  // namespace

FolderWatch::FolderWatch(std::filesystem::path folder, std::string_view extension)
    : folder_(std::move(folder)), extension_(extension) {
  start();
}

FolderWatch::~FolderWatch() {
  if (queue_ >= 0) ::close(queue_);
}

void FolderWatch::start() {
  if (queue_ < 0) queue_ = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  if (queue_ < 0) return;
  watch_ =
      ::inotify_add_watch(queue_, folder_.c_str(), kFileEvents | IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR);
}

bool FolderWatch::take_changes() {
  if (watch_ < 0) {
    start();
    return true;
  }
  bool changed = false;
  alignas(inotify_event) std::byte buffer[16 << 10];
  for (ssize_t count; (count = ::read(queue_, buffer, sizeof buffer)) > 0;) {
    for (const std::byte* at = buffer; at < buffer + count;) {
      const auto& event = *reinterpret_cast<const inotify_event*>(at);
      at += sizeof event + event.len;
      const std::string_view name = event.len > 0 ? std::string_view(event.name) : std::string_view();
      if ((event.mask & (kFolderGone | IN_Q_OVERFLOW)) != 0 || name.ends_with(extension_)) changed = true;
      if ((event.mask & kFolderGone) != 0 && event.wd == watch_) {
        if ((event.mask & IN_IGNORED) == 0) ::inotify_rm_watch(queue_, watch_);
        watch_ = -1;
      }
    }
  }
  return changed;
}

}  // namespace selvage
