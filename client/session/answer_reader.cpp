// SPDX-License-Identifier: MIT
#include "client/session/answer_reader.h"

#include <algorithm>

#include "common/pack/pack.h"

namespace selvage {
namespace {

tl::unexpected<Error> out_of_place(const Frame& frame) {
  return fail(ErrorCode::Protocol, std::string(to_string(frame.header.type)) + " does not belong here");
}

/// Data may not go past the end of what it is part of, and says so exactly when it gets there.
Result<void> check_data(const Frame& frame, std::uint64_t left) {
  const std::size_t size = frame.payload.size();
  if (size == 0 || size > kMaxDataPayload || size > left)
    return fail(ErrorCode::Protocol, "a Data frame of a wrong size");
  if (frame.ends() != (size == left)) return fail(ErrorCode::Protocol, "a Data frame ends at a wrong place");
  return {};
}

std::string name_of(const PartId& id) {
  const std::string what = id.kind == PartKind::Page     ? "directory page "
                           : id.kind == PartKind::Region ? "region "
                                                         : "bundle ";
  return what + std::to_string(id.region) + (id.level > 0 ? " at level " + std::to_string(id.level) : "");
}

}  // namespace

Result<bool> PongReader::on_frame(const Frame& frame) {
  if (!frame.is(FrameType::Pong)) return out_of_place(frame);
  return true;
}

Result<bool> StatusReader::on_frame(const Frame& frame) {
  if (!frame.is(FrameType::StatusReport)) return out_of_place(frame);
  auto report = parse<StatusReport>(frame.payload);
  if (!report) return forward_error(report);
  report_ = std::move(*report);
  return true;
}

Result<bool> EndReader::on_frame(const Frame& frame) {
  if (!frame.is(FrameType::RequestEnd)) return out_of_place(frame);
  return true;
}

Result<bool> PublishReader::on_frame(const Frame& frame) {
  if (frame.is(FrameType::PublishReady) && !is_ready_) {
    auto ready = parse<PublishReady>(frame.payload);
    if (!ready) return forward_error(ready);
    if (ready->offset > size_bytes_) return fail(ErrorCode::Protocol, "the server holds more than there is");
    is_ready_ = true;
    on_ready_(frame.header.request_id, ready->offset);
    return false;
  }
  if (frame.is(FrameType::PublishProgress) && is_ready_) {
    auto progress = parse<PublishProgress>(frame.payload);
    if (!progress) return forward_error(progress);
    on_progress_(*progress);
    return false;
  }
  if (!frame.is(FrameType::Published) || !is_ready_) return out_of_place(frame);
  auto published = parse<Published>(frame.payload);
  if (!published) return forward_error(published);
  published_ = std::move(*published);
  return true;
}

Result<bool> ModelsReader::on_frame(const Frame& frame) {
  if (!frame.is(FrameType::Models)) return out_of_place(frame);
  auto models = parse<Models>(frame.payload);
  if (!models) return forward_error(models);
  models_ = std::move(*models);
  return true;
}

// ---- manifest
// ------------------------------------------------------------------------------------------------

Result<bool> ManifestReader::on_frame(const Frame& frame) {
  switch (frame.header.type) {
    case FrameType::ManifestBegin:
      return on_begin(frame);
    case FrameType::Data:
      return on_data(frame);
    case FrameType::RequestEnd:
      if (!begin_ || bytes_.size() != begin_->directory_size) return out_of_place(frame);
      return true;
    default:
      return out_of_place(frame);
  }
}

Result<bool> ManifestReader::on_begin(const Frame& frame) {
  if (begin_) return out_of_place(frame);
  auto begin = parse<ManifestBegin>(frame.payload);
  if (!begin) return forward_error(begin);
  if (begin->directory_size > max_bytes_) {
    return fail(ErrorCode::LimitExceeded,
                "the directory of '" + name_ + "' has " + std::to_string(begin->directory_size) + " bytes");
  }
  if (begin->data_size != begin->directory_size) {
    return fail(ErrorCode::BadStream, "the server sends a part of the directory of '" + name_ + "'");
  }
  begin_ = *begin;
  return false;
}

Result<bool> ManifestReader::on_data(const Frame& frame) {
  if (!begin_) return out_of_place(frame);
  auto fits = check_data(frame, begin_->directory_size - bytes_.size());
  if (!fits) return forward_error(fits);
  bytes_.insert(bytes_.end(), frame.payload.begin(), frame.payload.end());  // grows with what really came
  return false;
}

Result<Manifest> ManifestReader::manifest() const {
  auto directory = parse_directory(bytes_, begin_->summary_size);
  if (!directory) return forward_error(directory, "the directory of '" + name_ + "'");
  if (pack_id(bytes_, begin_->summary_size) != begin_->pack_id) {
    return fail(ErrorCode::BadStream, "the directory of '" + name_ + "' is not that of its pack");
  }
  return Manifest{name_, begin_->pack_id, std::move(*directory), bytes_.size()};
}

// ---- parts
// ---------------------------------------------------------------------------------------------------

PartsReader::PartsReader(std::shared_ptr<const Manifest> manifest, OnPart on_part)
    : manifest_(std::move(manifest)), on_part_(std::move(on_part)) {}

Result<PartsReader> PartsReader::for_request(const GetRequest& request, OnPart on_part) {
  const Directory& directory = request.manifest->directory;
  auto ids = select_parts(directory, request.selection);
  if (!ids) return forward_error(ids);
  std::ranges::sort(*ids);
  std::vector<Hash> have = request.have;
  std::ranges::sort(have);

  PartsReader reader(request.manifest, std::move(on_part));
  reader.expected_.reserve(ids->size());
  for (const PartId& id : *ids) {
    const PartRef* ref = directory.find(id);
    if (std::ranges::binary_search(have, ref->hash)) {
      ++reader.stats_.held;
    } else {
      reader.expected_.push_back({id, ref});
    }
  }
  return reader;
}

Result<bool> PartsReader::on_frame(const Frame& frame) {
  switch (frame.header.type) {
    case FrameType::PartBegin:
      return on_begin(frame);
    case FrameType::Data:
      return on_data(frame);
    case FrameType::RequestEnd:
      return on_end(frame);
    default:
      return out_of_place(frame);
  }
}

Result<bool> PartsReader::on_begin(const Frame& frame) {
  if (current_) return out_of_place(frame);
  auto begin = parse<PartBegin>(frame.payload);
  if (!begin) return forward_error(begin);
  const auto found = std::ranges::lower_bound(expected_, begin->id, {}, &Expected::id);
  if (found == expected_.end() || found->id != begin->id || found->begun) {
    return fail(ErrorCode::BadStream,
                "the server sends a part that was not asked for: " + name_of(begin->id));
  }
  if (begin->size != found->ref->size || begin->hash != found->ref->hash || begin->offset != 0) {
    return fail(ErrorCode::BadStream,
                "the server sends another part than the directory lists: " + name_of(begin->id));
  }
  found->begun = true;
  current_ = &*found;
  bytes_.clear();
  return false;
}

Result<bool> PartsReader::on_data(const Frame& frame) {
  if (!current_) return out_of_place(frame);
  auto fits = check_data(frame, current_->ref->size - bytes_.size());
  if (!fits) return forward_error(fits);
  bytes_.insert(bytes_.end(), frame.payload.begin(), frame.payload.end());
  if (!frame.ends()) return false;

  auto whole = checks_hashes_ ? check_part(*current_->ref, bytes_) : Result<void>();
  if (!whole) return forward_error(whole, name_of(current_->id));
  ++stats_.parts;
  stats_.bytes += bytes_.size();
  on_part_(std::exchange(current_, nullptr)->id, std::exchange(bytes_, {}));
  return false;
}

Result<bool> PartsReader::on_end(const Frame& frame) {
  auto end = parse<RequestEnd>(frame.payload);
  if (!end) return forward_error(end);
  if (current_ || stats_.parts != expected_.size() || end->parts != stats_.parts ||
      end->bytes != stats_.bytes) {
    return fail(ErrorCode::BadStream, "the server ends an answer of " + std::to_string(expected_.size()) +
                                          " parts after " + std::to_string(stats_.parts));
  }
  return true;
}

}  // namespace selvage
