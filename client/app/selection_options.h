// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/pack/selection.h"

namespace CLI {
class App;
}

namespace selvage {

/// --regions, --box, --all, --joins and the choice of levels, as `get` and `unpack` share them.
struct SelectionOptions {
  std::string regions, box;
  bool all = false;
  Joins joins = Joins::Closure;
  unsigned level = 0;
  std::optional<double> max_error;
  std::optional<std::uint64_t> budget;

  void add_to(CLI::App& command);
  /// InvalidArgument says which option is malformed. Without any, everything is selected.
  Result<Selection> selection() const;
};

}  // namespace selvage
