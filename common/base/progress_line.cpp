// SPDX-License-Identifier: MIT
#include "common/base/progress_line.h"

#include <cstdio>

#include <unistd.h>

namespace selvage {

ProgressLine::ProgressLine() : is_terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() { wipe(); }

void ProgressLine::show(const std::string& text) {
  if (is_shown_ && std::chrono::steady_clock::now() - last_ < std::chrono::milliseconds(100)) return;
  show_now(text);
}

void ProgressLine::show_now(const std::string& text) {
  if (!is_terminal_) return;
  std::fprintf(stderr, "\r\033[K%s", text.c_str());
  std::fflush(stderr);
  is_shown_ = true;
  last_ = std::chrono::steady_clock::now();
}

void ProgressLine::wipe() {
  if (!is_shown_) return;
  std::fprintf(stderr, "\r\033[K");
  std::fflush(stderr);
  is_shown_ = false;
}

}  // namespace selvage
