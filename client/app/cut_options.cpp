// SPDX-License-Identifier: MIT
#include "client/app/cut_options.h"

#include <charconv>
#include <map>
#include <string>

#include <CLI/CLI.hpp>

namespace selvage {
namespace {

void add_levels(CLI::App& command, PublishCut& cut) {
  constexpr const char* kGroup = "Levels of detail";
  auto* levels =
      command
          .add_option("--levels", cut.levels,
                      "levels of detail, the finest included: 2 adds one of at most an eighth of the "
                      "triangles, 3 a quarter and a sixteenth, more halve each time; 1: none")
          ->check(CLI::Range(1, 16))
          ->capture_default_str()
          ->group(kGroup);
  auto* ratios = command
                     .add_option("--level-ratios", cut.level_ratios,
                                 "instead: shares of the triangles, falling, for instance 0.25,0.05")
                     ->delimiter(',')
                     ->excludes(levels)
                     ->group(kGroup);
  command
      .add_option("--level-errors", cut.level_errors,
                  "instead: deviations that collapses may leave, in model units, rising")
      ->delimiter(',')
      ->excludes(levels)
      ->excludes(ratios)
      ->group(kGroup);
}

/// "auto" or a count.
std::uint32_t regions_from(const std::string& text) {
  if (text == "auto") return 0;
  std::uint32_t count = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, count);
  if (error != std::errc{} || stop != end)
    throw CLI::ValidationError("--regions", "'" + text + "' is neither auto nor a number of regions");
  return count;
}

void add_segmentation(CLI::App& command, PublishCut& cut) {
  constexpr const char* kGroup = "Segmentation";
  const std::map<std::string, PublishCut::By> ways = {{"shape", PublishCut::By::Shape},
                                                      {"groups", PublishCut::By::Groups},
                                                      {"components", PublishCut::By::Components}};
  const std::map<std::string, PublishCut::Mode> modes = {{"xmrg", PublishCut::Mode::Xmrg},
                                                         {"classic", PublishCut::Mode::Classic},
                                                         {"zhang", PublishCut::Mode::Zhang},
                                                         {"mw99", PublishCut::Mode::ManganWhitaker},
                                                         {"cad", PublishCut::Mode::Cad}};
  command
      .add_option("--segment-by", cut.by,
                  "shape: parts that a person would see; groups: what the file's author named (OBJ g, o, "
                  "usemtl); components: connected pieces. For labels of your own, build a pack with "
                  "selvage-pack and put it into the server's folder")
      ->transform(CLI::CheckedTransformer(ways, CLI::ignore_case))
      ->default_str("shape")
      ->group(kGroup);
  command.add_option("--mode", cut.mode, "how parts are found; selvage-pack build --help tells more")
      ->transform(CLI::CheckedTransformer(modes, CLI::ignore_case))
      ->default_str("xmrg")
      ->group(kGroup);
  command
      .add_option_function<std::string>(
          "--regions", [&cut](const std::string& text) { cut.regions = regions_from(text); },
          "auto, or merge until so many are left")
      ->type_name("auto|N")
      ->default_str("auto")
      ->group(kGroup);
  command.add_option("--min-region", cut.min_region, "merge regions with fewer vertices; 0: as build does")
      ->capture_default_str()
      ->group(kGroup);
  command.add_option("--max-region", cut.max_region, "cut regions with more vertices; 0: as build does")
      ->capture_default_str()
      ->group(kGroup);
  command.add_flag("--smooth", cut.smooth, "xmrg, cad: smooth the borders between regions")->group(kGroup);
}

}  // namespace

void add_cut_options(CLI::App& command, PublishCut& cut) {
  add_levels(command, cut);
  add_segmentation(command, cut);
}

}  // namespace selvage
