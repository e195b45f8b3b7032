// SPDX-License-Identifier: MIT
#include "client/app/progress_bar.h"

#include <cmath>

#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>

namespace selvage {
namespace {

constexpr std::size_t kBar = 20;
constexpr double kRatePeriod = 0.5;  ///< seconds between two measurements
constexpr double kRateWeight = 0.3;  ///< of the newest

std::string size_text(double bytes) {
  if (bytes < 1e4) return fmt::format("{:.0f} B", bytes);
  if (bytes < 1e6) return fmt::format("{:.0f} KB", bytes / 1e3);
  if (bytes < 1e9) return fmt::format("{:.1f} MB", bytes / 1e6);
  return fmt::format("{:.2f} GB", bytes / 1e9);
}

std::string time_text(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  if (whole < 100) return fmt::format("{} s left", whole);
  if (whole < 6000) return fmt::format("{} min left", (whole + 59) / 60);
  return fmt::format("{} h left", (whole + 3599) / 3600);
}

std::size_t terminal_width() {
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

}  // namespace

std::string progress_text(const FetchProgress& progress, double bytes_per_second, std::size_t width) {
  const bool is_known = progress.of_parts > 0 || progress.parts == 0;
  const double share = progress.of_bytes == 0
                           ? (is_known ? 1 : 0)
                           : static_cast<double>(progress.bytes) / static_cast<double>(progress.of_bytes);
  const auto filled = std::min(kBar, static_cast<std::size_t>(share * kBar));
  std::string text = fmt::format("[{}{}] ", std::string(filled, '#'), std::string(kBar - filled, '.'));
  const auto add = [&](const std::string& more) {
    if (text.size() + more.size() <= width) text += more;
  };
  const auto of = [&](const std::string& all) { return is_known ? " of " + all : std::string(); };
  add(fmt::format("{}{} regions", progress.regions, of(std::to_string(progress.of_regions))));
  add(fmt::format(", {}{}", size_text(static_cast<double>(progress.bytes)),
                  of(size_text(static_cast<double>(progress.of_bytes)))));
  if (bytes_per_second > 0) {
    const double left = static_cast<double>(progress.of_bytes - std::min(progress.bytes, progress.of_bytes));
    add(fmt::format(", {}/s", size_text(bytes_per_second)));
    if (is_known) add(", " + time_text(left / bytes_per_second));
  }
  return text.substr(0, width);
}

void ProgressBar::show(const FetchProgress& progress) {
  const auto now = Clock::now();
  const double elapsed = std::chrono::duration<double>(now - measured_).count();
  if (elapsed >= kRatePeriod) {
    const double rate = static_cast<double>(progress.bytes - measured_bytes_) / elapsed;
    rate_ = rate_ == 0 ? rate : (1 - kRateWeight) * rate_ + kRateWeight * rate;
    measured_ = now;
    measured_bytes_ = progress.bytes;
  }
  line_.show(progress_text(progress, rate_, terminal_width() - 1));
}

void ProgressBar::show_retry(const Error& error, std::chrono::milliseconds delay) {
  line_.show_now(
      fmt::format("{}; trying again in {:.1f} s", error.message, 1e-3 * static_cast<double>(delay.count()))
          .substr(0, terminal_width() - 1));
}

}  // namespace selvage
