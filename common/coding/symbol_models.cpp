// SPDX-License-Identifier: MIT
#include "common/coding/symbol_models.h"

#include <algorithm>

namespace selvage {

StartModel fresh_model() {
  StartModel model{};
  for (unsigned i = 0; i < kSymbols; ++i)
    model.cumulative[i] = static_cast<std::uint16_t>(kProbabilityOne * i / kSymbols);
  model.uses = 4;
  model.uses_limit = 127;
  return model;
}

SymbolModels::SymbolModels(std::span<const StartModel> start)
    : cumulative_(start.size() * kSymbols + 1), rates_(start.size()) {
  for (std::size_t i = 0; i < start.size(); ++i) {
    std::copy_n(start[i].cumulative, kSymbols, &cumulative_[i * kSymbols]);
    rates_[i] = {start[i].uses, start[i].uses_limit};
  }
}

}  // namespace selvage
