// SPDX-License-Identifier: MIT
#pragma once

#include <istream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace selvage {

/// A TOML file as CLI11 wants it: a key for each option, named as on the command line without the dashes, at
/// the top level. Errors name the line; so do keys that are no option.
class TomlConfig final : public CLI::Config {
 public:
  /// `app` outlives this.
  explicit TomlConfig(const CLI::App& app) : app_(app) {}

  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override;
  /// Not offered.
  std::string to_config(const CLI::App*, bool, bool, std::string) const override { return {}; }

 private:
  const CLI::App& app_;
};

}  // namespace selvage
