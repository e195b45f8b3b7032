// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include <sched.h>
#include <sys/mount.h>

namespace selvage::testing {

/// A disk of a few blocks, at a folder that exists. Only this process and its children see it, so it goes
/// with them, however they end. Nothing there where one may not mount: ask is_there().
class SmallDisk {
 public:
  SmallDisk(const std::filesystem::path& folder, std::size_t kib) : folder_(folder.string()) {
    is_there_ = ::unshare(CLONE_NEWNS) == 0 &&
                ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                ::mount("selvage-test", folder_.c_str(), "tmpfs", 0, size(kib).c_str()) == 0;
  }
  ~SmallDisk() {
    if (is_there_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool is_there() const { return is_there_; }

  bool resize(std::size_t kib) {
    return ::mount("selvage-test", folder_.c_str(), "tmpfs", MS_REMOUNT, size(kib).c_str()) == 0;
  }

 private:
  static std::string size(std::size_t kib) { return "size=" + std::to_string(kib) + "k"; }

  const std::string folder_;
  bool is_there_ = false;
};

}  // namespace selvage::testing
