// SPDX-License-Identifier: MIT
#include "client/http/http_source.h"

#include <algorithm>
#include <condition_variable>
#include <set>

#include "client/http/range_plan.h"
#include "common/pack/pack.h"

namespace selvage {
namespace {

/// Enough for the header and the directory of most models in one round trip.
constexpr std::uint64_t kFirstRead = 64u << 10;

/// "https://host/path/bunny.selvage?x" -> "bunny"
std::string name_in(const std::string& url) {
  const std::string path = url.substr(0, url.find_first_of("?#"));
  std::string name = path.substr(path.rfind('/') + 1);
  if (name.ends_with(".selvage")) name.resize(name.size() - 8);
  return name;
}

/// Keeps parts that nobody has consumed below a bound, by not reading on.
class Window {
 public:
  explicit Window(std::uint64_t bytes)
      : size_(bytes), consumed_(std::make_shared<ConsumedBytes>([this] { wake(); })) {}
  ~Window() { consumed_->close(); }

  Receipt hold(std::uint64_t bytes) {
    held_ += bytes;
    return Receipt(consumed_, bytes);
  }

  /// False if `stop` came first.
  bool wait_for_room(const std::stop_token& stop) {
    held_ -= consumed_->take();
    while (held_ > size_ && !stop.stop_requested()) {
      std::unique_lock lock(mutex_);
      wakes_.wait(lock, stop, [this] { return is_awake_; });
      is_awake_ = false;
      lock.unlock();
      held_ -= consumed_->take();
    }
    return !stop.stop_requested();
  }

 private:
  void wake() {
    const std::scoped_lock lock(mutex_);
    is_awake_ = true;
    wakes_.notify_one();
  }

  const std::uint64_t size_;
  std::uint64_t held_ = 0;
  std::mutex mutex_;
  std::condition_variable_any wakes_;
  bool is_awake_ = false;
  std::shared_ptr<ConsumedBytes> consumed_;
};

/// Cuts the bytes of one range into its parts.
class RangeCutter {
 public:
  using OnWhole = std::function<Result<void>(const PartId&, std::vector<std::byte>)>;

  RangeCutter(PlannedRange range, const Directory& directory, std::shared_ptr<UnfinishedParts> unfinished,
              OnWhole on_whole)
      : range_(std::move(range)),
        directory_(directory),
        unfinished_(std::move(unfinished)),
        on_whole_(std::move(on_whole)),
        at_(range_.begin) {}
  /// What has come of a part is left for another try.
  ~RangeCutter() {
    if (unfinished_ && !part_.empty()) unfinished_->insert_or_assign(ref().hash, std::move(part_));
  }
  RangeCutter(const RangeCutter&) = delete;
  RangeCutter& operator=(const RangeCutter&) = delete;

  Result<void> add(std::span<const std::byte> bytes) {
    while (!bytes.empty() && next_ < range_.pieces.size()) {
      const WantedPiece& piece = range_.pieces[next_];
      const std::uint64_t wanted = at_ < piece.begin ? piece.begin - at_ : piece.end - at_;
      const auto taken = bytes.first(std::min<std::uint64_t>(wanted, bytes.size()));
      if (at_ >= piece.begin) {
        if (at_ == piece.begin) begin_part();
        part_.insert(part_.end(), taken.begin(), taken.end());
      }
      at_ += taken.size();
      bytes = bytes.subspan(taken.size());
      if (at_ < piece.end) continue;
      auto whole = check_part(ref(), part_);
      if (!whole) {
        part_.clear();
        return forward_error(whole, "region " + std::to_string(piece.id.region));
      }
      ++next_;
      auto ok = on_whole_(piece.id, std::exchange(part_, {}));
      if (!ok) return ok;
    }
    return {};
  }

 private:
  const PartRef& ref() const { return *directory_.find(range_.pieces[next_].id); }

  void begin_part() {
    part_.clear();
    if (!unfinished_) return;
    const auto front = unfinished_->find(ref().hash);
    if (front != unfinished_->end()) part_ = front->second;
  }

  const PlannedRange range_;
  const Directory& directory_;
  const std::shared_ptr<UnfinishedParts> unfinished_;
  const OnWhole on_whole_;
  std::uint64_t at_;             ///< in the file
  std::size_t next_ = 0;         ///< piece
  std::vector<std::byte> part_;  ///< of the piece under way
};

}  // namespace

HttpSource::HttpSource(std::string url, HttpOptions options)
    : name_(name_in(url)), options_(options), ranges_(std::move(url), options) {}

Result<void> HttpSource::read(std::uint64_t begin, std::uint64_t end, bool may_be_short,
                              std::vector<std::byte>& into, const std::stop_token& stop) {
  RangeRequest request{begin, end, may_be_short, [&into](std::span<const std::byte> bytes) -> Result<void> {
                         into.insert(into.end(), bytes.begin(), bytes.end());
                         return {};
                       }};
  std::vector<RangeRequest> requests;
  requests.push_back(std::move(request));
  return ranges_.fetch(std::move(requests), stop);
}

Result<std::shared_ptr<const Manifest>> HttpSource::open(std::stop_token stop) {
  std::vector<std::byte> front;
  auto ok = read(0, kFirstRead, true, front, stop);
  if (!ok) return forward_error(ok);
  auto header = parse_pack_header(front, ranges_.file_size());
  if (!header) return forward_error(header);
  if (header->directory_size > options_.max_directory_bytes) {
    return fail(ErrorCode::LimitExceeded,
                "its directory has " + std::to_string(header->directory_size) + " bytes");
  }
  const std::uint64_t end = kPackHeaderSize + header->directory_size;
  if (end > front.size()) ok = read(front.size(), end, false, front, stop);
  if (!ok) return forward_error(ok);
  const auto bytes = std::span<const std::byte>(front).subspan(kPackHeaderSize, header->directory_size);
  auto directory = parse_directory(bytes, header->summary_size);
  if (!directory) return forward_error(directory);
  if (pack_id(bytes, header->summary_size) != header->id)
    return fail(ErrorCode::BadStream, "the header's id is not the hash of the summary page");
  return std::make_shared<const Manifest>(Manifest{name_, header->id, std::move(*directory), bytes.size()});
}

Result<GetStats> HttpSource::get(GetRequest request, const OnPart& on_part, std::stop_token stop) {
  const Directory& directory = request.manifest->directory;
  auto ids = select_parts(directory, request.selection);
  if (!ids) return forward_error(ids);
  const std::set<Hash> have(request.have.begin(), request.have.end());
  GetStats stats;
  std::vector<WantedPiece> pieces;
  for (const PartId& id : *ids) {
    const PartRef& ref = *directory.find(id);
    if (ref.offset + ref.size > ranges_.file_size())
      return fail(ErrorCode::BadStream, "the directory lists parts past the end of the pack");
    if (have.contains(ref.hash)) {
      ++stats.held;
      continue;
    }
    std::uint64_t begin = ref.offset;
    if (request.unfinished) {
      const auto front = request.unfinished->find(ref.hash);
      if (front != request.unfinished->end()) begin += front->second.size();
    }
    pieces.push_back({id, begin, ref.offset + ref.size});
  }

  Window window(options_.window_bytes);
  const auto on_whole = [&](const PartId& id, std::vector<std::byte> bytes) -> Result<void> {
    if (stop.stop_requested()) return fail(ErrorCode::Cancelled, "cancelled");
    ++stats.parts;
    stats.bytes += bytes.size();
    Receipt receipt = window.hold(bytes.size());
    auto ok = on_part({id, std::move(bytes), std::move(receipt)});
    if (!ok) return ok;
    if (!window.wait_for_room(stop)) return fail(ErrorCode::Cancelled, "cancelled");
    return {};
  };
  std::vector<RangeRequest> requests;
  for (PlannedRange& range : plan_ranges(std::move(pieces))) {
    const std::uint64_t begin = range.begin, end = range.end;
    auto cutter = std::make_shared<RangeCutter>(std::move(range), directory, request.unfinished, on_whole);
    requests.push_back(
        {begin, end, false, [cutter](std::span<const std::byte> bytes) { return cutter->add(bytes); }});
  }
  auto ok = ranges_.fetch(std::move(requests), stop);
  if (!ok) return forward_error(ok);
  if (request.unfinished) request.unfinished->clear();
  return stats;
}

}  // namespace selvage
