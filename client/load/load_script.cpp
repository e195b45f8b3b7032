// SPDX-License-Identifier: MIT
#include "client/load/load_script.h"

#include <charconv>
#include <fstream>
#include <iterator>
#include <sstream>

namespace selvage {
namespace {

constexpr std::uint32_t kMaxRounds = 1'000'000'000;
constexpr std::uint32_t kMaxPauseMs = 3'600'000;

std::vector<std::string> words_of(std::string_view line) {
  std::istringstream in{std::string(line.substr(0, line.find('#')))};
  return {std::istream_iterator<std::string>(in), {}};
}

/// A number from 1 to `most` followed by exactly `unit`.
std::optional<std::uint32_t> number_with(std::string_view text, std::string_view unit, std::uint32_t most) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
  if (error != std::errc{} || rest != unit || value == 0 || value > most) return std::nullopt;
  return value;
}

Result<LoadStep> parse_get(const std::vector<std::string>& words) {
  LoadStep step{.kind = LoadStep::Kind::Get};
  if (words.size() == 3 && words[1] == "random") {
    const auto percent = number_with(words[2], "%", 100);
    if (!percent)
      return fail(ErrorCode::BadFile, "'" + words[2] + "' is no share; write for instance: get random 20%");
    step.random_percent = static_cast<int>(*percent);
    return step;
  }
  if (words.size() != 2) return fail(ErrorCode::BadFile, "write: get all, get 3,5-7 or get random 20%");
  if (words[1] == "all") return step;
  auto selection = parse_region_list(words[1]);
  if (!selection) return fail(ErrorCode::BadFile, selection.error().message);
  step.selection = std::move(*selection);
  return step;
}

Result<LoadStep> parse_step(const std::vector<std::string>& words) {
  if (words[0] == "list" && words.size() == 1) return LoadStep{.kind = LoadStep::Kind::List};
  if (words[0] == "open" && words.size() == 2)
    return LoadStep{.kind = LoadStep::Kind::Open, .model = words[1]};
  if (words[0] == "get") return parse_get(words);
  if (words[0] == "wait" && words.size() == 2) {
    const auto ms = number_with(words[1], "ms", kMaxPauseMs),
               seconds = number_with(words[1], "s", kMaxPauseMs / 1000);
    if (!ms && !seconds)
      return fail(ErrorCode::BadFile,
                  "'" + words[1] + "' is no time; write for instance: wait 50ms or wait 2s");
    return LoadStep{.kind = LoadStep::Kind::Wait,
                    .pause = std::chrono::milliseconds(ms ? *ms : *seconds * 1000)};
  }
  return fail(ErrorCode::BadFile,
              "unknown step '" + words[0] + "'; steps are list, open NAME, get WHAT, wait TIME, repeat N");
}

Result<void> parse_repeat(const std::vector<std::string>& words, LoadScript& script) {
  if (words.size() == 2 && words[1] == "forever") {
    script.rounds.reset();
    return {};
  }
  const auto rounds = words.size() == 2 ? number_with(words[1], "", kMaxRounds) : std::nullopt;
  if (!rounds) return fail(ErrorCode::BadFile, "write: repeat N or repeat forever");
  script.rounds = *rounds;
  return {};
}

}  // namespace

Result<LoadScript> parse_load_script(std::string_view text) {
  LoadScript script;
  bool has_repeat = false, has_open = false;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::vector<std::string> words = words_of(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    if (words.empty()) continue;
    const std::string line = "line " + std::to_string(number);
    if (has_repeat) return fail(ErrorCode::BadFile, line + ": nothing may follow repeat");
    if (words[0] == "repeat") {
      has_repeat = true;
      if (auto ok = parse_repeat(words, script); !ok) return forward_error(ok, line);
      continue;
    }
    auto step = parse_step(words);
    if (!step) return forward_error(step, line);
    has_open |= step->kind == LoadStep::Kind::Open;
    if (step->kind == LoadStep::Kind::Get && !has_open)
      return fail(ErrorCode::BadFile, line + ": open a model before get");
    script.steps.push_back(std::move(*step));
  }
  if (script.steps.empty()) return fail(ErrorCode::BadFile, "the script has no step");
  return script;
}

Result<LoadScript> read_load_script(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(ErrorCode::NotFound, path.string() + ": cannot read it");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  auto script = parse_load_script(text);
  if (!script) return forward_error(script, path.string());
  return script;
}

std::string_view to_string(LoadStep::Kind kind) {
  switch (kind) {
    case LoadStep::Kind::List:
      return "list";
    case LoadStep::Kind::Open:
      return "open";
    case LoadStep::Kind::Get:
      return "get";
    case LoadStep::Kind::Wait:
      return "wait";
  }
  return "?";
}

}  // namespace selvage
