// SPDX-License-Identifier: MIT
//
// From the frames of one answer to what was asked for. Pure: fed by the session's reader, and by tests with
// whatever a hostile server might say. Nothing is believed: order, sizes, hashes and identity are checked
// against the request and, for parts, against the directory that was opened.
//
// Protocol errors mean that the peer does not speak the protocol: the session ends. Other errors end the
// request.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/net/frame.h"
#include "common/net/messages.h"
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

class AnswerReader {
 public:
  virtual ~AnswerReader() = default;
  /// True when this frame completes the answer. Error frames do not come here.
  virtual Result<bool> on_frame(const Frame& frame) = 0;
};

class PongReader final : public AnswerReader {
 public:
  Result<bool> on_frame(const Frame& frame) override;
};

class ModelsReader final : public AnswerReader {
 public:
  Result<bool> on_frame(const Frame& frame) override;
  Models take() { return std::move(models_); }

 private:
  Models models_;
};

class StatusReader final : public AnswerReader {
 public:
  Result<bool> on_frame(const Frame& frame) override;
  StatusReport take() { return std::move(report_); }

 private:
  StatusReport report_;
};

/// An answer without data: of Unpublish.
class EndReader final : public AnswerReader {
 public:
  Result<bool> on_frame(const Frame& frame) override;
};

class PublishReader final : public AnswerReader {
 public:
  /// Called once: from where on the server wants the bytes, and for which request.
  using OnReady = std::function<void(std::uint32_t request_id, std::uint64_t offset)>;
  using OnProgress = std::function<void(const PublishProgress&)>;

  PublishReader(std::uint64_t size_bytes, OnReady on_ready, OnProgress on_progress)
      : size_bytes_(size_bytes), on_ready_(std::move(on_ready)), on_progress_(std::move(on_progress)) {}
  Result<bool> on_frame(const Frame& frame) override;
  Published take() { return std::move(published_); }

 private:
  std::uint64_t size_bytes_;
  OnReady on_ready_;
  OnProgress on_progress_;
  bool is_ready_ = false;
  Published published_;
};

class ManifestReader final : public AnswerReader {
 public:
  ManifestReader(std::string name, std::uint64_t max_bytes) : name_(std::move(name)), max_bytes_(max_bytes) {}
  Result<bool> on_frame(const Frame& frame) override;
  /// LimitExceeded, or BadStream if the bytes are no directory or not that of the pack they are said to be
  /// of.
  Result<Manifest> manifest() const;

 private:
  Result<bool> on_begin(const Frame& frame);
  Result<bool> on_data(const Frame& frame);

  std::string name_;
  std::uint64_t max_bytes_;
  std::optional<ManifestBegin> begin_;
  std::vector<std::byte> bytes_;
};

/// What a get brought.
struct GetStats {
  std::uint32_t parts = 0;  ///< received
  std::uint64_t bytes = 0;  ///< of them
  std::uint32_t held = 0;   ///< not sent, because the client said it has them
};

struct GetRequest {
  std::shared_ptr<const Manifest> manifest;
  Selection selection;
  std::vector<Hash> have;
  std::uint8_t urgency = kDefaultUrgency;
};

class PartsReader final : public AnswerReader {
 public:
  /// Called for every whole part that matches its hash, in the order of arrival.
  using OnPart = std::function<void(const PartId&, std::vector<std::byte>)>;

  /// What the request asks for, by the same rule as the server's: an error here would be one there.
  static Result<PartsReader> for_request(const GetRequest& request, OnPart on_part);

  /// For measuring servers with little client work: parts are then only counted, their hashes not computed.
  void skip_hashes() { checks_hashes_ = false; }

  Result<bool> on_frame(const Frame& frame) override;
  const GetStats& stats() const { return stats_; }

 private:
  struct Expected {
    PartId id;
    const PartRef* ref;  ///< in the manifest's directory
    bool begun = false;
  };

  PartsReader(std::shared_ptr<const Manifest> manifest, OnPart on_part);
  Result<bool> on_begin(const Frame& frame);
  Result<bool> on_data(const Frame& frame);
  Result<bool> on_end(const Frame& frame);

  std::shared_ptr<const Manifest> manifest_;
  OnPart on_part_;
  std::vector<Expected> expected_;  ///< ascending by id
  const Expected* current_ = nullptr;
  std::vector<std::byte> bytes_;  ///< of the current part so far
  bool checks_hashes_ = true;
  GetStats stats_;
};

}  // namespace selvage
