// SPDX-License-Identifier: MIT
//
// What a scripted client does, one step a line; `#` starts a comment:
//
//     list                     ask for the models
//     open NAME                open a model; the first step but lists and waits
//     get all                  fetch everything
//     get 3,5-7                fetch these regions
//     get random 20%           fetch a random share of the regions, another each time
//     wait 50ms                think; also 2s
//     repeat 10                start again from the top, so many times; `repeat forever` until the time is
//     up.
//                              At most one, at the end
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "common/pack/selection.h"

namespace selvage {

struct LoadStep {
  enum class Kind : std::uint8_t { List, Open, Get, Wait };
  Kind kind = Kind::List;
  std::string model;                  ///< Open
  Selection selection;                ///< Get, unless random_percent is set
  std::optional<int> random_percent;  ///< Get: 1..100
  std::chrono::milliseconds pause{};  ///< Wait
};

struct LoadScript {
  std::vector<LoadStep> steps;
  std::optional<std::uint32_t> rounds = 1;  ///< absent: forever
};

/// BadFile with the line that is wrong.
Result<LoadScript> parse_load_script(std::string_view text);
Result<LoadScript> read_load_script(const std::filesystem::path& path);

/// The name that a kind of step goes by in reports.
std::string_view to_string(LoadStep::Kind kind);

}  // namespace selvage
