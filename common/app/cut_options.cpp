// SPDX-License-Identifier: MIT
#include "common/app/cut_options.h"

#include <charconv>

#include <CLI/CLI.hpp>

namespace selvage {
namespace {

std::uint32_t region_count_of(const std::string& text) {
  if (text == "auto") return 0;
  std::uint32_t count = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, count);
  if (error != std::errc{} || stop != end)
    throw CLI::ValidationError("--regions", "'" + text + "' is neither auto nor a number of regions");
  return count;
}

}  // namespace

void add_level_options(CLI::App& command, std::uint32_t& levels, std::vector<double>& ratios,
                       std::vector<double>& errors) {
  constexpr const char* kGroup = "Levels of detail";
  auto* by_count =
      command
          .add_option("--levels", levels,
                      "levels of detail, the finest included: 2 adds one of at most an eighth of the "
                      "triangles, 3 a quarter and a sixteenth, more halve each time; 1: none")
          ->check(CLI::Range(1, 16))
          ->capture_default_str()
          ->group(kGroup);
  auto* by_ratio = command
                       .add_option("--level-ratios", ratios,
                                   "instead: shares of the triangles, falling, for instance 0.25,0.05")
                       ->delimiter(',')
                       ->excludes(by_count)
                       ->group(kGroup);
  command
      .add_option("--level-errors", errors,
                  "instead: deviations that collapses may leave, in model units, rising")
      ->delimiter(',')
      ->excludes(by_count)
      ->excludes(by_ratio)
      ->group(kGroup);
}

CLI::Option* add_region_count_option(CLI::App& command, std::uint32_t& count, const std::string& help) {
  return command
      .add_option_function<std::string>(
          "--regions", [&count](const std::string& text) { count = region_count_of(text); }, help)
      ->type_name("auto|N")
      ->default_str("auto");
}

}  // namespace selvage
