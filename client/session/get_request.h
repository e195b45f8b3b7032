// SPDX-License-Identifier: MIT
//
// A request for parts, and what comes of it, whoever answers: a selvage server, a static web server, a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "client/session/credit_window.h"
#include "common/pack/directory.h"
#include "common/pack/selection.h"

namespace selvage {

/// A model as the client opened it.
struct Manifest {
  std::string name;
  Hash pack_id;
  Directory directory;
  std::uint64_t directory_bytes = 0;
};

/// The first bytes of parts whose answer broke off.
using UnfinishedParts = std::map<Hash, std::vector<std::byte>>;

inline constexpr std::uint8_t kUsualUrgency = 3;  ///< of 0, most urgent, to 7

/// The urgency of a get, which may change while it runs. Thread-safe.
class UrgencyDial {
 public:
  using Listener = std::function<void(std::uint8_t)>;

  explicit UrgencyDial(std::uint8_t urgency = kUsualUrgency) : urgency_(urgency) {}

  void turn(std::uint8_t urgency);
  std::uint8_t urgency() const;

  /// For whoever serves the get: `listener` is told of every turn, on the thread that turns, and must not
  /// block; an empty one ends it, and is not called again once this returns.
  void listen(Listener listener);

 private:
  mutable std::mutex mutex_;
  std::uint8_t urgency_;
  Listener listener_;
};

struct GetRequest {
  std::shared_ptr<const Manifest> manifest;
  Selection selection;
  std::vector<Hash> have = {};  ///< parts that need not come
  std::uint8_t urgency = kUsualUrgency;
  /// Where a get that fails leaves the parts it was in the middle of, so that the same get, tried again,
  /// fetches the rest of them only. Null: what was not finished is forgotten. Nobody else touches it
  /// meanwhile.
  std::shared_ptr<UnfinishedParts> unfinished = {};
  std::shared_ptr<UrgencyDial> dial = {};  ///< instead of `urgency`, where it is to change on the way
};

/// A get that opens its model on the way.
struct FirstRequest {
  Selection selection;  ///< without names, which nobody can resolve yet
  std::uint8_t urgency = kUsualUrgency;
  std::shared_ptr<UnfinishedParts> unfinished = {};  ///< as in GetRequest
  std::shared_ptr<UrgencyDial> dial = {};            ///< as in GetRequest
};

/// What a get brought.
struct GetStats {
  std::uint32_t parts = 0;  ///< received, without pages of the directory
  std::uint64_t bytes = 0;  ///< of them, without what an earlier get had left unfinished
  std::uint32_t held = 0;   ///< not sent, because the client said it has them
  std::uint32_t pages = 0;  ///< of the directory; their bytes are among `bytes`
};

/// A whole part with the right hash. Destroying it (or its receipt) tells the sender that there is room for
/// more: keep it until it is decoded, on whichever thread that happens.
struct ReceivedPart {
  PartId id;
  std::vector<std::byte> bytes;
  Receipt receipt;
};

}  // namespace selvage
