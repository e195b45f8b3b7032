// SPDX-License-Identifier: MIT
//
// Options on cutting a mesh into regions and levels, which selvage-pack and publishing clients have alike.
// What they fill must outlive the command.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace selvage {

/// --levels, or --level-ratios or --level-errors instead; at most one of the two lists is filled.
void add_level_options(CLI::App& command, std::uint32_t& levels, std::vector<double>& ratios,
                       std::vector<double>& errors);

/// --regions auto|N; auto is 0.
CLI::Option* add_region_count_option(CLI::App& command, std::uint32_t& count, const std::string& help);

}  // namespace selvage
