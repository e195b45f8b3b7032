// SPDX-License-Identifier: MIT
//
// What client and server say to each other, as plain structs. This is the only door to protobuf, and the one
// place where fields from the wire are checked: a struct that came out of parse() holds what its comments
// say. docs/PROTOCOL.md tells when each is sent.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/base/hash.h"
#include "common/base/result.h"
#include "common/net/frame.h"
#include "common/net/publish_cut.h"
#include "common/pack/directory.h"
#include "common/pack/selection.h"

namespace selvage {

inline constexpr std::uint32_t kProtocolVersion = 1;

/// A window smaller than this could stall between two chunks; the server refuses it.
inline constexpr std::uint64_t kMinInitialCredit = 64u << 10;
/// More than this outstanding is an overflow, not a grant.
inline constexpr std::uint64_t kMaxCredit = std::uint64_t{1} << 40;

inline constexpr std::size_t kMaxNameLength = 128;
inline constexpr std::size_t kMaxTextLength = 1024;
inline constexpr std::size_t kMaxTokenLength = 4096;
inline constexpr std::size_t kMaxStageLength = 32;
inline constexpr std::size_t kMaxRepeated = 100;  ///< notes, problems, jobs: more are left out
inline constexpr std::uint8_t kMaxUrgency = 7;
inline constexpr std::uint8_t kDefaultUrgency = 3;

/// The client's first frame.
struct Hello {
  static constexpr FrameType kType = FrameType::Hello;
  std::uint32_t min_version = kProtocolVersion;
  std::uint32_t max_version = kProtocolVersion;      ///< not below min_version
  std::string software;                              ///< name and version, for logs
  std::uint64_t initial_credit = kMinInitialCredit;  ///< kMinInitialCredit to kMaxCredit
  std::string token;                                 ///< empty: none; at most kMaxTokenLength bytes
};

/// The server's first frame: the version they speak, and what the server puts up with.
struct HelloAck {
  static constexpr FrameType kType = FrameType::HelloAck;
  std::uint32_t version = kProtocolVersion;
  std::string software;
  std::uint32_t max_message_bytes = 0;  ///< longest payload a client may send
  std::uint32_t max_requests = 0;       ///< in flight at a time
  std::uint32_t max_ids = 0;            ///< region ids in one GetParts
  std::uint32_t idle_timeout_ms = 0;    ///< a client that sends nothing for so long is dropped
};

struct ListModels {
  static constexpr FrameType kType = FrameType::ListModels;
  std::string after;  ///< only names greater than this one; empty: from the start
};

struct ModelInfo {
  std::string name;
  Hash pack_id;
  std::uint64_t size_bytes = 0;
  std::uint32_t regions = 0;
  std::uint32_t vertices = 0;
  std::uint32_t triangles = 0;
  std::string problem;  ///< why the model cannot be opened; empty if it can
};

struct Models {
  static constexpr FrameType kType = FrameType::Models;
  std::vector<ModelInfo> models;  ///< strictly ascending by name
  bool more = false;              ///< there are names after the last of these (which then exists)
};

struct OpenModel {
  static constexpr FrameType kType = FrameType::OpenModel;
  std::string name;
  bool summary_only = false;      ///< the first page of the directory will do for now
  std::optional<Hash> held = {};  ///< pack whose directory the client has: not sent again if it is that one
};

/// The directory, its summary page or nothing follows in Data frames.
struct ManifestBegin {
  static constexpr FrameType kType = FrameType::ManifestBegin;
  Hash pack_id;
  std::uint32_t summary_size = 0;
  std::uint64_t directory_size = 0;  ///< not below summary_size, not 0
  std::uint64_t data_size = 0;  ///< what follows: directory_size, summary_size, or 0 if the client has it
};

/// A part of which the client holds the first bytes.
struct PartialPart {
  Hash hash;
  std::uint32_t offset = 0;  ///< how many
};

struct GetParts {
  static constexpr FrameType kType = FrameType::GetParts;
  std::string model;
  std::optional<Hash> pack_id;  ///< absent: whichever pack has that name now
  Selection selection;          ///< a box is finite and not inside out
  std::vector<Hash> have;       ///< parts that need not be sent
  std::vector<PartialPart> partial;
  std::uint8_t urgency = kDefaultUrgency;  ///< 0, most urgent, to kMaxUrgency
  Pages pages = Pages::None;               ///< of the directory, for clients that opened its summary only
};

/// Changes the urgency of the request in the frame's header, from the next write on.
struct Reprioritise {
  static constexpr FrameType kType = FrameType::Reprioritise;
  std::uint8_t urgency = kDefaultUrgency;  ///< 0 to kMaxUrgency
};

/// A part's bytes follow in Data frames, from `offset` to `size`.
struct PartBegin {
  static constexpr FrameType kType = FrameType::PartBegin;
  PartId id;
  std::uint32_t size = 0;    ///< not 0
  std::uint32_t offset = 0;  ///< below size
  Hash hash;
};

/// The last frame of an answer with Data in it.
struct RequestEnd {
  static constexpr FrameType kType = FrameType::RequestEnd;
  std::uint32_t parts = 0;  ///< sent
  std::uint64_t bytes = 0;  ///< of Data payload sent
  std::uint32_t held = 0;   ///< left out because the client has them
};

struct Credit {
  static constexpr FrameType kType = FrameType::Credit;
  std::uint32_t bytes = 0;  ///< not 0
};

/// Ends the request in the frame's header; with request id 0 it ends the connection.
struct ErrorMessage {
  static constexpr FrameType kType = FrameType::Error;
  Error error;  ///< without offset; text without control characters
  bool retryable = false;
};

struct GoAway {
  static constexpr FrameType kType = FrameType::GoAway;
  std::string reason;
};

/// A mesh that is to become a model. Its bytes follow in Data frames once PublishReady has said from where
/// on.
struct Publish {
  static constexpr FrameType kType = FrameType::Publish;
  std::string name;              ///< of the model
  std::string file;              ///< the mesh file's name, without folders; its extension names the format
  std::uint64_t size_bytes = 0;  ///< of the mesh file, not 0
  Hash hash;                     ///< of the whole mesh file
  bool replace = false;          ///< a model that has the name already
  bool lossless = false;
  std::uint8_t bits = 14;  ///< of the grid
  std::string units;
  PublishCut cut;  ///< its numbers are finite and its lists short; ingest checks what they ask for
};

struct PublishReady {
  static constexpr FrameType kType = FrameType::PublishReady;
  std::uint64_t offset = 0;  ///< how many bytes the server holds already
};

struct PublishProgress {
  static constexpr FrameType kType = FrameType::PublishProgress;
  std::string stage;           ///< "wait", "check", "read" and the stages of ingest
  std::uint32_t permille = 0;  ///< of that stage; at most 1000
  std::uint32_t ahead = 0;     ///< others to be ingested before this one
};

/// The model is in the list, and on the disk.
struct Published {
  static constexpr FrameType kType = FrameType::Published;
  std::string name;
  Hash pack_id;
  std::uint64_t size_bytes = 0;  ///< of the pack
  std::uint32_t regions = 0;
  std::uint32_t vertices = 0;
  std::uint32_t triangles = 0;
  std::vector<std::string> notes;  ///< what was wrong with the mesh and could be mended
};

struct Unpublish {
  static constexpr FrameType kType = FrameType::Unpublish;
  std::string name;
};

struct PublishJob {
  std::string name;
  std::string stage;
  std::uint32_t permille = 0;
};

struct ModelProblem {
  std::string name;
  std::string problem;
};

/// How the server is. Sums are since it started.
struct StatusReport {
  static constexpr FrameType kType = FrameType::StatusReport;
  std::string software;
  std::uint64_t uptime_seconds = 0;
  bool draining = false;
  bool is_encrypted = false;  ///< connections are TLS
  std::uint32_t models = 0;   ///< damaged ones included
  std::uint64_t model_bytes = 0;
  std::vector<ModelProblem> problems;  ///< damaged models, not all if they are many
  std::uint64_t connections = 0;       ///< now
  std::uint64_t max_connections = 0;
  std::uint64_t connections_accepted = 0;
  std::uint64_t connections_refused = 0;
  std::uint64_t requests = 0;
  std::uint64_t errors = 0;
  std::uint64_t bytes_sent = 0;
  std::uint64_t bytes_uploaded = 0;
  std::uint64_t published = 0;
  std::uint64_t publish_failed = 0;
  std::vector<PublishJob> jobs;  ///< the first is being worked on
};

/// Frames without payload.
struct Status {
  static constexpr FrameType kType = FrameType::Status;
};
struct Cancel {
  static constexpr FrameType kType = FrameType::Cancel;
};
struct Ping {
  static constexpr FrameType kType = FrameType::Ping;
};
struct Pong {
  static constexpr FrameType kType = FrameType::Pong;
};

/// Checks and takes apart a payload that arrived in a frame of type Message::kType. Safe on hostile input;
/// memory is bounded by a small multiple of the payload. Protocol names the message and the field.
/// Defined for every struct with a kType above.
template <class Message>
Result<Message> parse(std::span<const std::byte> payload);

/// Appends the whole frame. The payload must not exceed kMaxPayload (assert): senders of lists page them.
template <class Message>
void append_frame(std::vector<std::byte>& out, const Message& message, std::uint32_t request_id,
                  std::uint32_t seq = 0);

template <class Message>
std::vector<std::byte> to_frame(const Message& message, std::uint32_t request_id, std::uint32_t seq = 0) {
  std::vector<std::byte> bytes;
  append_frame(bytes, message, request_id, seq);
  return bytes;
}

/// Whether the same request may succeed later, unchanged.
bool is_retryable(ErrorCode code);

}  // namespace selvage
