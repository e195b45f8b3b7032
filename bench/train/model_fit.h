// SPDX-License-Identifier: MIT
//
// Start models from the symbols that parts were coded from.
#pragma once

#include <functional>
#include <vector>

#include "common/codec/codec_tables.h"
#include "common/coding/symbol_models.h"

namespace selvage::bench {

struct FittedBank {
  std::vector<PackedModel> packed;
  std::vector<bool> is_seen;
  std::vector<StartModel> start;
};

/// Of each model, what codes the parts' symbols in the fewest bits; `used_symbols(model)` are those that can
/// come up.
FittedBank fit_bank(const std::vector<std::vector<Token>>& parts, unsigned models,
                    const std::function<unsigned(unsigned)>& used_symbols);

}  // namespace selvage::bench
