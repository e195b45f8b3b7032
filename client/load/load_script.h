// SPDX-License-Identifier: MIT
//
// What a load test does, as docs/LOAD.md describes it: kinds of clients, each with a list of steps, and what
// is expected of the server. A script without `client` lines is one kind.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/load/expectation.h"
#include "common/base/result.h"
#include "common/pack/selection.h"

namespace selvage {

struct LoadStep {
  enum class Kind : std::uint8_t { List, Open, Get, Think, Disconnect, Stall, Vanish, Garbage, Publish };
  Kind kind = Kind::List;
  std::string label;  ///< what it is called in reports: its words
  std::string model;  ///< Open; Publish, where the number of the client is appended

  Selection selection;                ///< Get, unless random_percent is set
  std::optional<int> random_percent;  ///< Get: 1..100, of the regions, others each time
  std::uint8_t urgency = 3;           ///< Get
  /// Get: what has not come by then is cancelled.
  std::optional<std::chrono::milliseconds> cancel_after;
  /// Get: the connection is dropped once so many bytes of the answer have come; the rest comes over another.
  std::optional<std::uint64_t> drop_after_bytes;

  std::chrono::milliseconds think_least{}, think_most{};  ///< Think: a time in between, another each time

  std::filesystem::path file;  ///< Publish: the mesh

  std::chrono::milliseconds stall{};  ///< Stall: how long a client that asks for everything reads nothing
  std::uint64_t bytes = 0;            ///< Vanish: after how many it goes; Garbage: how many it sends
};

/// The link that each client of a kind has, emulated in this process.
struct LinkShape {
  std::uint64_t bytes_per_second = 0;  ///< towards the client; 0: as fast as it comes
  std::chrono::milliseconds round_trip{};
};

struct ClientKind {
  std::string name;
  std::uint32_t count = 1;
  LinkShape link;
  /// A round starts every so often, however long the last one took; absent: when the last one ends.
  std::optional<std::chrono::milliseconds> every;
  bool decodes = false;
  bool verifies = false;  ///< hashes, decodes and stitches everything
  std::vector<LoadStep> steps;
  std::optional<std::uint32_t> rounds = 1;  ///< absent: until the time is up
};

struct LoadScript {
  std::optional<std::chrono::milliseconds> duration;  ///< after which no step begins
  std::chrono::milliseconds ramp{};                   ///< over which the clients start, evenly
  std::vector<ClientKind> kinds;
  std::vector<Expectation> expectations;
};

/// BadFile with the line that is wrong.
Result<LoadScript> parse_load_script(std::string_view text);
Result<LoadScript> read_load_script(const std::filesystem::path& path);

}  // namespace selvage
