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
#include <set>
#include <string>
#include <vector>

#include "client/session/get_request.h"
#include "common/net/frame.h"
#include "common/net/messages.h"

namespace selvage {

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
  /// LimitExceeded, or BadStream if the bytes are no directory or not that of the pack they are said to be
  /// of.
  using OnManifest = std::function<Result<void>(Manifest)>;

  /// `on_manifest` is called once, with the answer's last frame; an error of it is that of the request.
  ManifestReader(const OpenModel& asked, std::uint64_t max_bytes, OnManifest on_manifest)
      : name_(asked.name),
        summary_only_(asked.summary_only),
        max_bytes_(max_bytes),
        on_manifest_(std::move(on_manifest)) {}
  Result<bool> on_frame(const Frame& frame) override;

 private:
  Result<bool> on_begin(const Frame& frame);
  Result<bool> on_data(const Frame& frame);
  Result<Manifest> manifest() const;

  std::string name_;
  bool summary_only_;
  std::uint64_t max_bytes_;
  OnManifest on_manifest_;
  std::optional<ManifestBegin> begin_;
  std::vector<std::byte> bytes_;
};

class PartsReader final : public AnswerReader {
 public:
  /// Called for every whole part that matches its hash, in the order of arrival.
  using OnPart = std::function<void(const PartId&, std::vector<std::byte>)>;

  /// What the request asks for, by the same rule as the server's: an error here would be one there. The
  /// directory must be complete.
  static Result<PartsReader> for_request(const GetRequest& request, OnPart on_part);

  /// For a request that travels with the one that opens the model: pages of the directory come among the
  /// parts, each before what it lists. begin() must come before the first part does.
  PartsReader(const FirstRequest& request, OnPart on_part);
  /// `directory` as the summary gives it.
  void begin(Directory directory);

  /// For measuring servers with little client work: parts are then only counted, their hashes not computed.
  void skip_hashes() { checks_hashes_ = false; }

  Result<bool> on_frame(const Frame& frame) override;
  const GetStats& stats() const { return stats_; }

  /// The answer breaks off here: what has come of a part goes where the request said.
  void leave_unfinished();

 private:
  struct Current {
    PartId id;
    const PartRef* ref;  ///< in the directory
  };

  PartsReader(const GetRequest& request, std::uint32_t expected, OnPart on_part);
  Result<bool> on_begin(const Frame& frame);
  Result<bool> on_data(const Frame& frame);
  Result<bool> on_end(const Frame& frame);
  const PartRef* find_asked_for(const PartId& id) const;
  Result<void> deliver();

  Selection selection_;
  std::vector<Hash> have_;  ///< ascending
  std::shared_ptr<UnfinishedParts> unfinished_;
  OnPart on_part_;
  bool checks_hashes_ = true;

  std::shared_ptr<const Manifest> manifest_;  ///< whose directory is used, or ...
  std::unique_ptr<Directory> growing_;        ///< ... one that pages are read into
  std::optional<SelectedParts> asked_for_;    ///< once there is a directory
  std::optional<std::uint32_t> expected_;     ///< parts; absent: only the whole answer tells

  std::set<PartId> begun_;
  std::optional<Current> current_;
  std::vector<std::byte> bytes_;  ///< of the current part so far
  GetStats stats_;
};

}  // namespace selvage
