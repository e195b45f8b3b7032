// SPDX-License-Identifier: MIT
#include "client/session/answer_reader.h"

#include <algorithm>

#include "common/pack/pack.h"

namespace selvage {

static_assert(kUsualUrgency == kDefaultUrgency);

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
    case FrameType::RequestEnd: {
      if (!begin_ || bytes_.size() != begin_->data_size) return out_of_place(frame);
      auto made = manifest();
      if (!made) return forward_error(made);
      if (auto ok = on_manifest_(std::move(*made)); !ok) return forward_error(ok);
      return true;
    }
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
  if (begin->data_size != (summary_only_ ? begin->summary_size : begin->directory_size)) {
    return fail(ErrorCode::BadStream,
                "the server sends another part of the directory of '" + name_ + "' than it was asked for");
  }
  begin_ = *begin;
  return false;
}

Result<bool> ManifestReader::on_data(const Frame& frame) {
  if (!begin_) return out_of_place(frame);
  auto fits = check_data(frame, begin_->data_size - bytes_.size());
  if (!fits) return forward_error(fits);
  bytes_.insert(bytes_.end(), frame.payload.begin(), frame.payload.end());  // grows with what really came
  return false;
}

Result<Manifest> ManifestReader::manifest() const {
  auto directory = summary_only_ ? parse_summary(bytes_, begin_->directory_size)
                                 : parse_directory(bytes_, begin_->summary_size);
  if (!directory) return forward_error(directory, "the directory of '" + name_ + "'");
  if (pack_id(bytes_, begin_->summary_size) != begin_->pack_id) {
    return fail(ErrorCode::BadStream, "the directory of '" + name_ + "' is not that of its pack");
  }
  return Manifest{name_, begin_->pack_id, std::move(*directory), bytes_.size()};
}

// ---- parts
// ---------------------------------------------------------------------------------------------------

PartsReader::PartsReader(const GetRequest& request, std::uint32_t expected, OnPart on_part)
    : selection_(request.selection),
      have_(request.have),
      unfinished_(request.unfinished),
      on_part_(std::move(on_part)),
      manifest_(request.manifest),
      asked_for_(SelectedParts(manifest_->directory, selection_)),
      expected_(expected) {
  std::ranges::sort(have_);
}

PartsReader::PartsReader(const FirstRequest& request, OnPart on_part)
    : selection_(request.selection), unfinished_(request.unfinished), on_part_(std::move(on_part)) {}

Result<PartsReader> PartsReader::for_request(const GetRequest& request, OnPart on_part) {
  const Directory& directory = request.manifest->directory;
  auto ids = select_parts(directory, request.selection);
  if (!ids) return forward_error(ids);
  std::vector<Hash> have = request.have;
  std::ranges::sort(have);
  const auto held = std::ranges::count_if(
      *ids, [&](const PartId& id) { return std::ranges::binary_search(have, directory.find(id)->hash); });
  PartsReader reader(request, static_cast<std::uint32_t>(ids->size()) - static_cast<std::uint32_t>(held),
                     std::move(on_part));
  reader.stats_.held = static_cast<std::uint32_t>(held);
  return reader;
}

void PartsReader::begin(Directory directory) {
  growing_ = std::make_unique<Directory>(std::move(directory));
  asked_for_.emplace(*growing_, selection_);
}

/// Null: the server sends what was not asked for, or before the page that lists it.
const PartRef* PartsReader::find_asked_for(const PartId& id) const {
  const Directory& directory = growing_ ? *growing_ : manifest_->directory;
  const bool is_page = id.kind == PartKind::Page;
  if (is_page ? !growing_ : !asked_for_->contains(id)) return nullptr;
  const PartRef* ref = directory.find(id);
  const bool is_held = ref != nullptr && std::ranges::binary_search(have_, ref->hash);
  return is_held || begun_.contains(id) ? nullptr : ref;
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
  if (!asked_for_)
    return fail(ErrorCode::BadStream, "the server sends parts of a model before its directory");
  const PartRef* ref = find_asked_for(begin->id);
  if (ref == nullptr) {
    return fail(ErrorCode::BadStream,
                "the server sends a part that was not asked for: " + name_of(begin->id));
  }
  if (begin->size != ref->size || begin->hash != ref->hash) {
    return fail(ErrorCode::BadStream,
                "the server sends another part than the directory lists: " + name_of(begin->id));
  }
  bytes_.clear();
  if (unfinished_) {
    // Not taken away: another part may have the same bytes.
    const auto front = unfinished_->find(begin->hash);
    if (front != unfinished_->end()) bytes_ = front->second;
  }
  if (begin->offset == 0) bytes_.clear();  // a server need not take up a part where it broke off
  if (begin->offset != bytes_.size()) {
    return fail(ErrorCode::BadStream, "the server leaves out the front of " + name_of(begin->id));
  }
  begun_.insert(begin->id);
  current_ = Current{begin->id, ref};
  return false;
}

Result<bool> PartsReader::on_data(const Frame& frame) {
  if (!current_) return out_of_place(frame);
  auto fits = check_data(frame, current_->ref->size - bytes_.size());
  if (!fits) return forward_error(fits);
  bytes_.insert(bytes_.end(), frame.payload.begin(), frame.payload.end());
  stats_.bytes += frame.payload.size();
  if (!frame.ends()) return false;
  if (auto ok = deliver(); !ok) return forward_error(ok);
  return false;
}

Result<void> PartsReader::deliver() {
  const auto [id, ref] = *std::exchange(current_, std::nullopt);
  if (id.kind == PartKind::Page) {
    if (auto ok = read_page(*growing_, id.region, bytes_); !ok) return ok;
    ++stats_.pages;
  } else {
    auto whole = checks_hashes_ ? check_part(*ref, bytes_) : Result<void>();
    if (!whole) return forward_error(whole, name_of(id));
    ++stats_.parts;
  }
  on_part_(id, std::exchange(bytes_, {}));
  return {};
}

Result<bool> PartsReader::on_end(const Frame& frame) {
  auto end = parse<RequestEnd>(frame.payload);
  if (!end) return forward_error(end);
  if (growing_) {
    // Now that its pages are there, they tell what the answer had to be.
    auto ids = select_parts(*growing_, selection_);
    if (!ids) return forward_error(ids);
    expected_ = static_cast<std::uint32_t>(ids->size());
    std::ranges::sort(*ids);
    for (const PartId& id : begun_) {
      if (id.kind != PartKind::Page && !std::ranges::binary_search(*ids, id)) expected_.reset();
    }
  }
  if (current_ || stats_.parts != expected_ || end->parts != stats_.parts + stats_.pages ||
      end->bytes != stats_.bytes) {
    return fail(ErrorCode::BadStream, "the server ends an answer of " +
                                          (expected_ ? std::to_string(*expected_) : "other") +
                                          " parts after " + std::to_string(stats_.parts));
  }
  return true;
}

void PartsReader::leave_unfinished() {
  if (!current_ || !unfinished_ || bytes_.empty()) return;
  unfinished_->insert_or_assign(current_->ref->hash, std::move(bytes_));
  current_.reset();
}

}  // namespace selvage
