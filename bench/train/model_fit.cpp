// SPDX-License-Identifier: MIT
#include "bench/train/model_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace selvage::bench {
namespace {

/// One model's symbols, part by part.
struct History {
  std::vector<std::uint8_t> symbols;
  std::vector<std::uint32_t> begins;  ///< of each part that uses the model
};

/// -log2 of a frequency.
const std::vector<float>& cost_of_frequency() {
  static const std::vector<float> costs = [] {
    std::vector<float> all(kProbabilityOne + 1);
    for (std::uint32_t f = 1; f <= kProbabilityOne; ++f)
      all[f] = static_cast<float>(kProbabilityBits - std::log2(static_cast<double>(f)));
    return all;
  }();
  return costs;
}

double adaptive_cost(const History& history, const StartModel& start) {
  double cost = 0;
  for (std::size_t i = 0; i < history.begins.size(); ++i) {
    SymbolModels model(std::span(&start, 1));
    const std::size_t end = i + 1 < history.begins.size() ? history.begins[i + 1] : history.symbols.size();
    for (std::size_t at = history.begins[i]; at < end; ++at) {
      cost += cost_of_frequency()[model.range(0, history.symbols[at]).frequency];
      model.update(0, history.symbols[at]);
    }
  }
  return cost;
}

/// Start levels from counts in which a part that uses the model often counts little more than one that uses
/// it seldom; then the confidence and the last rate that code the training parts in the fewest bits.
PackedModel fit_model(const History& history, unsigned used_symbols) {
  std::array<double, kSymbols> counts;
  for (unsigned s = 0; s < kSymbols; ++s) counts[s] = s < used_symbols ? 0.02 : 1e-9;
  double total = 0;
  for (std::size_t i = 0; i < history.begins.size(); ++i) {
    const std::size_t end = i + 1 < history.begins.size() ? history.begins[i + 1] : history.symbols.size();
    const auto length = static_cast<double>(end - history.begins[i]);
    const double weight = std::min(1.0, 64 / length);
    for (std::size_t at = history.begins[i]; at < end; ++at) counts[history.symbols[at]] += weight;
    total += weight * length;
  }
  PackedModel model{};
  for (unsigned s = 0; s < kSymbols; ++s)
    model.levels[s] = static_cast<std::uint8_t>(
        std::clamp(std::lround(-12 * std::log2(counts[s] / (total + 1))), 0L, 255L));
  double least = 1e300;
  PackedModel best = model;
  for (int limit : {31, 63, 127, 255}) {
    for (int uses : {4, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 255}) {
      if (uses > limit) continue;
      model.uses = static_cast<std::uint8_t>(uses);
      model.uses_limit = static_cast<std::uint8_t>(limit);
      const double cost = adaptive_cost(history, unpack(model));
      if (cost < least) least = cost, best = model;
    }
  }
  return best;
}

}  // namespace

FittedBank fit_bank(const std::vector<std::vector<Token>>& parts, unsigned models,
                    const std::function<unsigned(unsigned)>& used_symbols) {
  std::vector<History> histories(models);
  std::vector<std::size_t> last_part(models, parts.size());
  for (std::size_t part = 0; part < parts.size(); ++part) {
    for (const Token& token : parts[part]) {
      History& history = histories[token.model];
      if (last_part[token.model] != part)
        history.begins.push_back(static_cast<std::uint32_t>(history.symbols.size()));
      last_part[token.model] = part;
      history.symbols.push_back(static_cast<std::uint8_t>(token.symbol));
    }
  }
  FittedBank bank;
  for (unsigned m = 0; m < models; ++m) {
    const bool is_seen = !histories[m].symbols.empty();
    bank.is_seen.push_back(is_seen);
    bank.packed.push_back(is_seen ? fit_model(histories[m], used_symbols(m)) : PackedModel{});
    bank.start.push_back(is_seen ? unpack(bank.packed.back()) : fresh_model());
  }
  return bank;
}

}  // namespace selvage::bench
