// SPDX-License-Identifier: MIT
#include "client/load/load_script.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "client/load/units.h"

namespace selvage {
namespace {

constexpr std::uint32_t kMaxRounds = 1'000'000'000;
constexpr std::uint32_t kMaxClients = 50'000;
constexpr std::string_view kSteps =
    "list, open NAME, get WHAT, think TIME, disconnect, stall TIME, vanish SIZE, garbage SIZE, publish FILE "
    "NAME";

using Words = std::vector<std::string>;

tl::unexpected<Error> wrong(std::string message) { return fail(ErrorCode::BadFile, std::move(message)); }

Words words_of(std::string_view line) {
  std::istringstream in{std::string(line.substr(0, line.find('#')))};
  return {std::istream_iterator<std::string>(in), {}};
}

std::string joined(const Words& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::optional<std::uint32_t> whole_number(const std::string& text, std::uint32_t least, std::uint32_t most) {
  const auto value = parse_plain_number(text);
  if (!value || *value < least || *value > most || *value != static_cast<std::uint32_t>(*value))
    return std::nullopt;
  return static_cast<std::uint32_t>(*value);
}

// ---- steps
// ---------------------------------------------------------------------------------------------------

/// The options behind what a get is to fetch, in any order: "level 2 joins none cancel after 30ms".
Result<void> parse_get_options(std::span<const std::string> words, LoadStep& step) {
  while (!words.empty()) {
    const std::string& option = words[0];
    const bool has_after = words.size() >= 3 && words[1] == "after";
    const std::string value = has_after ? words[2] : words.size() >= 2 ? words[1] : "";
    if (option == "level") {
      const auto level = whole_number(value, 0, 255);
      if (!level) return wrong("'" + value + "' is no level; write for instance: level 2");
      step.selection.level = static_cast<std::uint8_t>(*level);
    } else if (option == "urgency") {
      const auto urgency = whole_number(value, 0, 7);
      if (!urgency) return wrong("'" + value + "' is no urgency; it is from 0, first, to 7");
      step.urgency = static_cast<std::uint8_t>(*urgency);
    } else if (option == "joins" && (value == "none" || value == "closure" || value == "all")) {
      step.selection.joins = value == "none" ? Joins::None : value == "all" ? Joins::All : Joins::Closure;
    } else if (option == "cancel" && has_after && parse_time(value)) {
      step.cancel_after = parse_time(value);
    } else if (option == "drop" && has_after && parse_size(value)) {
      step.drop_after_bytes = parse_size(value);
    } else {
      return wrong("'" + option + " " + value +
                   "' is nothing that a get can do; it can: level N, joins none|closure|all, urgency N, "
                   "cancel after TIME, drop after SIZE");
    }
    words = words.subspan(has_after ? 3 : 2);
  }
  return {};
}

Result<LoadStep> parse_get(const Words& words) {
  LoadStep step{.kind = LoadStep::Kind::Get};
  std::size_t used = 2;
  const std::string what = words.size() > 1 ? words[1] : "";
  if (what == "random" || what == "box") used = 3;
  if (words.size() < used || what.empty())
    return wrong("write: get all, get 3,5-7, get random 20% or get box x0,y0,z0,x1,y1,z1");
  if (what == "random") {
    const auto percent = parse_percent(words[2]);
    if (!percent || *percent < 1 || *percent > 100)
      return wrong("'" + words[2] + "' is no share; write for instance: get random 20%");
    step.random_percent = static_cast<int>(*percent);
  } else if (what == "box") {
    auto box = parse_box(words[2]);
    if (!box) return wrong(box.error().message);
    step.selection.kind = Selection::Kind::Box;
    step.selection.box = *box;
  } else if (what != "all") {
    auto selection = parse_region_list(what);
    if (!selection) return wrong(selection.error().message);
    step.selection = std::move(*selection);
  }
  auto ok = parse_get_options(std::span(words).subspan(used), step);
  if (!ok) return forward_error(ok);
  return step;
}

Result<LoadStep> parse_think(const Words& words) {
  LoadStep step{.kind = LoadStep::Kind::Think};
  const std::string text = words.size() == 2 ? words[1] : "";
  const std::size_t dash = text.find('-');
  const auto least = parse_time(text.substr(0, dash));
  const auto most = dash == std::string::npos ? least : parse_time(text.substr(dash + 1));
  if (!least || !most || *least > *most)
    return wrong("'" + text + "' is no time; write for instance: think 50ms, think 2s or think 20ms-200ms");
  step.think_least = *least;
  step.think_most = *most;
  return step;
}

Result<LoadStep> parse_step(const Words& words) {
  const std::string& verb = words[0];
  if (verb == "list" && words.size() == 1) return LoadStep{.kind = LoadStep::Kind::List};
  if (verb == "open" && words.size() == 2) return LoadStep{.kind = LoadStep::Kind::Open, .model = words[1]};
  if (verb == "get") return parse_get(words);
  if (verb == "think" || verb == "wait") return parse_think(words);
  if (verb == "disconnect" && words.size() == 1) return LoadStep{.kind = LoadStep::Kind::Disconnect};
  if (verb == "stall" && words.size() == 2 && parse_time(words[1]))
    return LoadStep{.kind = LoadStep::Kind::Stall, .stall = *parse_time(words[1])};
  if (verb == "publish" && words.size() == 3) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(words[1], ignored)) return wrong("no such file: " + words[1]);
    return LoadStep{.kind = LoadStep::Kind::Publish, .model = words[2], .file = words[1]};
  }
  if ((verb == "vanish" || verb == "garbage") && words.size() == 2 && parse_size(words[1])) {
    const auto kind = verb == "vanish" ? LoadStep::Kind::Vanish : LoadStep::Kind::Garbage;
    return LoadStep{.kind = kind, .bytes = *parse_size(words[1])};
  }
  return wrong("unknown step '" + joined(words) + "'; steps are " + std::string(kSteps));
}

// ---- lines
// ---------------------------------------------------------------------------------------------------

/// Reads line by line; holds what later lines need to know of earlier ones.
class ScriptParser {
 public:
  Result<void> line(const Words& words) {
    const std::string& word = words[0];
    if (word == "duration" || word == "ramp") return time_line(words);
    if (word == "expect") return expect_line(words);
    if (word == "client") return client_line(words);
    if (is_closed_)
      return wrong("nothing may follow loop; a new kind of client begins with: client NAME COUNT");
    if (word == "link") return link_line(words);
    if (word == "every") return every_line(words);
    if (word == "decode" || word == "verify") return flag_line(words);
    if (word == "loop" || word == "repeat") return loop_line(words);
    return step_line(words);
  }

  Result<LoadScript> finish() {
    for (const ClientKind& kind : script_.kinds) {
      if (kind.steps.empty()) return wrong("client " + kind.name + " has no step");
    }
    if (script_.kinds.empty()) return wrong("the script has no step");
    return std::move(script_);
  }

 private:
  /// Steps before any `client` line are those of the only kind.
  ClientKind& kind() {
    if (script_.kinds.empty()) script_.kinds.push_back({.name = "client"});
    return script_.kinds.back();
  }

  Result<void> time_line(const Words& words) {
    const auto time = words.size() == 2 ? parse_time(words[1]) : std::nullopt;
    if (!time) return wrong("write for instance: " + words[0] + " 30s");
    if (words[0] == "ramp") {
      script_.ramp = *time;
    } else {
      script_.duration = *time;
    }
    return {};
  }

  Result<void> expect_line(const Words& words) {
    auto expectation = parse_expectation({words.begin() + 1, words.end()});
    if (!expectation) return forward_error(expectation);
    script_.expectations.push_back(std::move(*expectation));
    return {};
  }

  Result<void> client_line(const Words& words) {
    const auto count = words.size() == 3 ? whole_number(words[2], 1, kMaxClients) : std::nullopt;
    if (!count) return wrong("write for instance: client viewer 200");
    if (!script_.kinds.empty() && script_.kinds.back().steps.empty())
      return wrong("client " + script_.kinds.back().name + ", before this line, has no step");
    if (std::ranges::find(script_.kinds, words[1], &ClientKind::name) != script_.kinds.end())
      return wrong("there is a client " + words[1] + " already");
    script_.kinds.push_back({.name = words[1], .count = *count});
    is_closed_ = has_open_ = false;
    return {};
  }

  Result<void> link_line(const Words& words) {
    LinkShape link;
    for (const std::string& word : std::span(words).subspan(1)) {
      if (const auto rate = parse_rate(word); rate && *rate > 0) {
        link.bytes_per_second = *rate;
      } else if (const auto time = parse_time(word)) {
        link.round_trip = *time;
      } else {
        return wrong("'" + word +
                     "' is neither a rate nor a round trip; write for instance: link 20mbit 50ms");
      }
    }
    if (words.size() < 2 || words.size() > 3) return wrong("write for instance: link 20mbit 50ms");
    kind().link = link;
    return {};
  }

  Result<void> every_line(const Words& words) {
    const auto time = words.size() == 2 ? parse_time(words[1]) : std::nullopt;
    if (!time || time->count() == 0) return wrong("write for instance: every 500ms");
    kind().every = time;
    return {};
  }

  Result<void> flag_line(const Words& words) {
    if (words.size() != 1) return wrong("write " + words[0] + " alone on its line");
    kind().decodes = true;
    kind().verifies |= words[0] == "verify";
    return {};
  }

  Result<void> loop_line(const Words& words) {
    if (words.size() == 2 && words[1] == "forever") {
      kind().rounds.reset();
    } else {
      const auto rounds = words.size() == 2 ? whole_number(words[1], 1, kMaxRounds) : std::nullopt;
      if (!rounds) return wrong("write: " + words[0] + " N or " + words[0] + " forever");
      kind().rounds = *rounds;
    }
    is_closed_ = true;
    return {};
  }

  Result<void> step_line(const Words& words) {
    auto step = parse_step(words);
    if (!step) return forward_error(step);
    has_open_ |= step->kind == LoadStep::Kind::Open;
    const bool needs_model = step->kind == LoadStep::Kind::Get || step->kind == LoadStep::Kind::Stall ||
                             step->kind == LoadStep::Kind::Vanish;
    if (needs_model && !has_open_) return wrong("open a model before " + words[0]);
    step->label = joined(words);
    kind().steps.push_back(std::move(*step));
    return {};
  }

  LoadScript script_;
  bool is_closed_ = false;  ///< the kind's loop line has come
  bool has_open_ = false;
};

}  // namespace

Result<LoadScript> parse_load_script(std::string_view text) {
  ScriptParser parser;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const Words words = words_of(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    if (words.empty()) continue;
    auto ok = parser.line(words);
    if (!ok) return forward_error(ok, "line " + std::to_string(number));
  }
  return parser.finish();
}

Result<LoadScript> read_load_script(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(ErrorCode::NotFound, path.string() + ": cannot read it");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  auto script = parse_load_script(text);
  if (!script) return forward_error(script, path.string());
  return script;
}

}  // namespace selvage
