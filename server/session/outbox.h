// SPDX-License-Identifier: MIT
//
// What a session has still to send, and in which order. Control frames go first and come out in the order
// they went in; answers with data share what is left: each write carries at most what suits the
// connection (ByteStream::write_size), taken from the most urgent answer, and the next write begins with the
// next of the same urgency. So a small request beside a large one waits for a write, not for the end; a
// cancel or a change of urgency acts after one.
//
// Data goes out only against credit. A Batch points into the mapped pack, part bytes are not copied on the
// way, but for parts so small that a place of their own in the gather list costs more than the copy.
//
// Single-strand. No I/O: the session writes what take() gives.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <vector>

#include "common/net/byte_stream.h"
#include "common/net/messages.h"
#include "common/pack/pack.h"
#include "server/session/limits.h"

namespace selvage {

/// One part of an answer; `ref` points into the answer's pack.
struct SendItem {
  PartId id;
  std::uint32_t offset = 0;  ///< the client has the bytes before it
  const PartRef* ref = nullptr;
};

/// An answer that carries bytes of a pack: what `manifest` says of its directory, if that is set, then parts,
/// then RequestEnd.
struct Answer {
  std::uint32_t request_id = 0;
  std::shared_ptr<const Pack> pack;
  std::optional<ManifestBegin> manifest;
  std::vector<SendItem> items;
  std::uint32_t held = 0;    ///< parts that the client said it has
  std::uint8_t urgency = 0;  ///< 0 goes first
};

/// Frames for one write: small ones gathered in a buffer, part bytes where they lie in their packs.
class Batch {
 public:
  void clear();
  bool empty() const { return runs_.empty(); }
  std::size_t size_bytes() const { return size_bytes_; }

  /// What to write, but for the first `written` bytes; valid until the batch changes.
  const Pieces& pieces(std::size_t written = 0);

  template <class Message>
  void add(const Message& message, std::uint32_t request_id, std::uint32_t seq) {
    const std::size_t start = buffer_.size();
    append_frame(buffer_, message, request_id, seq);
    add_buffered(start);
  }
  void add_bytes(std::span<const std::byte> bytes);  ///< of whole frames
  /// `payload` stays where it is.
  void add_data(const FrameHeader& header, const Piece& payload);
  void keep(const std::shared_ptr<const Pack>& pack);

 private:
  /// A run of `buffer_`, or bytes elsewhere. `buffer_` moves as it grows, so runs are places, not pointers.
  struct Run {
    const std::byte* outside = nullptr;
    std::size_t start = 0, size = 0;
    bool is_mapped = false;
  };
  void add_buffered(std::size_t start);

  std::vector<std::byte> buffer_;
  std::vector<Run> runs_;
  Pieces pieces_;
  std::vector<std::shared_ptr<const Pack>> kept_;
  std::size_t size_bytes_ = 0;
};

class Outbox {
 public:
  /// So much of control frames goes into one write before data has its turn.
  static constexpr std::size_t kControlShare = 32u << 10;
  /// A part is not cut finer than this, unless it ends.
  static constexpr std::size_t kMinChunk = 2u << 10;
  /// Data up to this size is copied beside its header.
  static constexpr std::size_t kCopiedData = 512;

  explicit Outbox(const SessionLimits& limits)
      : max_answers_(limits.requests), max_parts_(limits.queued_parts), max_control_(limits.queued_bytes) {}

  /// A whole frame (see to_frame). Always accepted: the reader stops reading while full().
  void push_control(std::vector<std::byte> frame);
  bool full() const { return control_bytes_ >= max_control_; }

  /// LimitExceeded when too many requests or parts are queued, InvalidArgument when the request id is in use.
  Result<void> push_answer(Answer answer);

  /// Drops what is left of that answer; false if there is none (any more).
  bool cancel(std::uint32_t request_id);
  /// Drops an answer whose pack has been damaged since, and gives its request id; 0 if there is none.
  std::uint32_t drop_damaged();
  /// Changes the urgency of that answer, if it is still here.
  void reprioritise(std::uint32_t request_id, std::uint8_t urgency);
  void drop_answers() {
    answers_.clear();
    queued_parts_ = 0;
  }

  /// Protocol if the client grants more than can be.
  Result<void> grant(std::uint64_t bytes);

  /// Nothing more to send, now or when credit comes.
  bool idle() const { return control_.empty() && answers_.empty(); }

  /// Fills `batch`, which it clears first, with the next write, in which data goes up to a size of about
  /// `quantum`; leaves it empty when there is nothing that may be sent now. With less than kMinChunk only
  /// control frames and the ends of parts may go.
  void take(Batch& batch, std::size_t quantum);

 private:
  /// An answer under way.
  struct Sending {
    Answer answer;
    std::size_t next = 0;     ///< item being sent
    std::uint64_t at = 0;     ///< byte of it (of the directory first, where there is a manifest)
    bool introduced = false;  ///< its ManifestBegin or PartBegin went out
    std::uint32_t seq = 0;
    RequestEnd sums;
  };

  using Answers = std::list<Sending>;
  Answers::iterator find(std::uint32_t request_id);

  void take_control(Batch& batch);
  void take_answers(Batch& batch);
  bool take_from(Sending& sending, Batch& batch);
  std::uint64_t chunk(std::uint64_t left, const Batch& batch) const;
  bool send_bytes(Sending& sending, std::span<const std::byte> bytes, Batch& batch);
  bool send_manifest(Sending& sending, Batch& batch);
  bool send_item(Sending& sending, Batch& batch);

  const std::uint32_t max_answers_, max_parts_, max_control_;
  std::list<std::vector<std::byte>> control_;
  std::size_t control_bytes_ = 0;
  Answers answers_;  ///< among those of one urgency, the first one's turn is next
  std::size_t queued_parts_ = 0;
  std::uint64_t credit_ = 0;
  std::size_t quantum_ = 0;  ///< of the take() under way
};

}  // namespace selvage
