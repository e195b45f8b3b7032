// SPDX-License-Identifier: MIT
#include "client/app/publish_cut_options.h"

#include <map>
#include <string>

#include <CLI/CLI.hpp>

#include "common/app/cut_options.h"

namespace selvage {
namespace {

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
  add_region_count_option(command, cut.regions, "auto, or merge until so many are left")->group(kGroup);
  command.add_option("--min-region", cut.min_region, "merge regions with fewer vertices; 0: as build does")
      ->capture_default_str()
      ->group(kGroup);
  command.add_option("--max-region", cut.max_region, "cut regions with more vertices; 0: as build does")
      ->capture_default_str()
      ->group(kGroup);
  command.add_flag("--smooth", cut.smooth, "xmrg, cad: smooth the borders between regions")->group(kGroup);
}

}  // namespace

void add_publish_cut_options(CLI::App& command, PublishCut& cut) {
  add_level_options(command, cut.levels, cut.level_ratios, cut.level_errors);
  add_segmentation(command, cut);
}

}  // namespace selvage
