// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "common/pack/selection.h"

namespace CLI {
class App;
}

namespace selvage {

/// --regions, --box, --all and --joins, as `get` and `unpack` share them.
struct SelectionOptions {
  std::string regions, box;
  bool all = false;
  Joins joins = Joins::Closure;

  void add_to(CLI::App& command);
  /// InvalidArgument says which option is malformed. Without any, everything is selected.
  Result<Selection> selection() const;
};

}  // namespace selvage
