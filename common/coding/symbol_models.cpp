// SPDX-License-Identifier: MIT
#include "common/coding/symbol_models.h"

namespace selvage {

StartModel fresh_model() {
  StartModel model{};
  for (unsigned i = 0; i <= kSymbols; ++i)
    model.cumulative[i] = static_cast<std::uint16_t>(kProbabilityOne * i / kSymbols);
  model.uses = 4;
  model.uses_limit = 127;
  return model;
}

}  // namespace selvage
