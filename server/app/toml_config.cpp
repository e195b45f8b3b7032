// SPDX-License-Identifier: MIT
#include "server/app/toml_config.h"

#include <fmt/format.h>
#include <toml++/toml.h>

namespace selvage {
namespace {

[[noreturn]] void fail_at(const toml::source_region& where, const std::string& what) {
  throw CLI::ConfigError(fmt::format("the configuration's line {}: {}", where.begin.line, what),
                         CLI::ExitCodes::ConfigError);
}

/// The value as it would stand on the command line.
std::string to_argument(std::string_view key, const toml::node& value) {
  if (const auto* text = value.as_string()) return text->get();
  if (const auto* number = value.as_integer()) return std::to_string(number->get());
  if (const auto* number = value.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* flag = value.as_boolean()) return flag->get() ? "true" : "false";
  fail_at(value.source(), fmt::format("'{}' is neither text nor a number nor true or false", key));
}

}  // namespace

std::vector<CLI::ConfigItem> TomlConfig::from_config(std::istream& input) const {
  toml::table table;
  try {
    table = toml::parse(input);
  } catch (const toml::parse_error& error) {
    fail_at(error.source(), std::string(error.description()));
  }
  std::vector<CLI::ConfigItem> found;
  for (const auto& [key, value] : table) {
    const std::string name(key.str());
    if (app_.get_option_no_throw("--" + name) == nullptr) {
      fail_at(key.source(), fmt::format("there is no option '{}'; selvage-server --help lists them", name));
    }
    CLI::ConfigItem item;
    item.name = name;
    item.inputs.push_back(to_argument(name, value));
    found.push_back(std::move(item));
  }
  return found;
}

}  // namespace selvage
