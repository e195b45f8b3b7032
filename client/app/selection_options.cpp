// SPDX-License-Identifier: MIT
#include "client/app/selection_options.h"

#include <map>

#include <CLI/CLI.hpp>

namespace selvage {

void SelectionOptions::add_to(CLI::App& command) {
  const std::map<std::string, Joins> choices = {
      {"none", Joins::None}, {"closure", Joins::Closure}, {"all", Joins::All}};
  auto* by_number = command.add_option(
      "--regions", regions,
      "regions by number or by the name of a part, each at a level if you like, for instance "
      "wheel_left,3@0,5-7@1; =7 is the part called 7");
  auto* by_box =
      command.add_option("--box", box, "regions that meet the box x0,y0,z0,x1,y1,z1, in model units");
  auto* everything = command.add_flag("--all", all, "the whole model (default)");
  by_number->excludes(by_box)->excludes(everything);
  by_box->excludes(everything);
  command
      .add_option("--joins", joins,
                  "none: regions alone; closure: stitched where both sides are chosen; all: also strips to "
                  "regions not chosen, "
                  "for later")
      ->transform(CLI::CheckedTransformer(choices, CLI::ignore_case))
      ->default_str("closure");
  auto* by_level = command
                       .add_option("--level", level,
                                   "level of detail of regions without one of their own: 0 is the finest; "
                                   "where there is none so coarse, the coarsest")
                       ->check(CLI::Range(0, 255))
                       ->capture_default_str();
  auto* by_error =
      command
          .add_option("--max-error", max_error,
                      "the coarsest levels that are at most so far from the model, in its units; counts "
                      "simplification and rounding")
          ->check(CLI::NonNegativeNumber)
          ->excludes(by_level);
  command.add_option("--budget", budget, "the best levels that take at most so many bytes, joins included")
      ->excludes(by_level)
      ->excludes(by_error);
}

Result<Selection> SelectionOptions::selection() const {
  Selection selection;
  selection.joins = joins;
  selection.level = static_cast<std::uint8_t>(level);
  if (!regions.empty()) {
    auto listed = parse_region_list(regions);
    if (!listed) return forward_error(listed, "--regions");
    listed->joins = joins;
    listed->level = selection.level;
    return listed;
  } else if (!box.empty()) {
    auto parsed = parse_box(box);
    if (!parsed) return forward_error(parsed, "--box");
    selection.kind = Selection::Kind::Box;
    selection.box = *parsed;
  }
  return selection;
}

}  // namespace selvage
