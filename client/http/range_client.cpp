// SPDX-License-Identifier: MIT
#include "client/http/range_client.h"

#include <algorithm>
#include <charconv>
#include <new>
#include <optional>

#include <curl/curl.h>

namespace selvage {
namespace {

/// All of an answer's headers, redirections included.
constexpr std::size_t kMaxHeaderBytes = 64 << 10;
constexpr long kMaxRedirects = 5;

void initialise_curl_once() {
  static const CURLcode done = curl_global_init(CURL_GLOBAL_DEFAULT);
  (void)done;
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return out;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

bool take_number(std::string_view& text, std::uint64_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

bool take_text(std::string_view& text, std::string_view expected) {
  if (!text.starts_with(expected)) return false;
  text.remove_prefix(expected.size());
  return true;
}

struct ContentRange {
  std::uint64_t first = 0, last = 0, total = 0;
};

/// "bytes 0-99/1234"
std::optional<ContentRange> parse_content_range(std::string_view text) {
  ContentRange range;
  const bool ok = take_text(text, "bytes ") && take_number(text, range.first) && take_text(text, "-") &&
                  take_number(text, range.last) && take_text(text, "/") && take_number(text, range.total) &&
                  text.empty() && range.first <= range.last && range.last < range.total;
  return ok ? std::optional(range) : std::nullopt;
}

/// What later answers must agree with.
struct FileIdentity {
  std::uint64_t size = 0;
  std::string validator;  ///< a strong ETag or a Last-Modified, for If-Range; empty: neither was given
};

/// The headers of the answer that is coming in.
struct Headers {
  long status = 0;
  std::optional<ContentRange> range;
  std::string etag, last_modified, encoding, location;
};

Error error_of_status(long status) {
  const std::string said = "the web server answers " + std::to_string(status);
  if (status == 404 || status == 410) return {ErrorCode::NotFound, said + ": no such file"};
  if (status == 401 || status == 403)
    return {ErrorCode::Unauthorised, said + ": it does not give out this file"};
  if (status == 416) return {ErrorCode::BadStream, said + ": the file is shorter than its own header says"};
  if (status == 408 || status == 425 || status == 429 || status >= 500) return {ErrorCode::Unavailable, said};
  return {ErrorCode::Unsupported, said + " to a request for a range of bytes"};
}

}  // namespace

/// One request and its answer.
class Transfer {
 public:
  Transfer(RangeRequest request, std::optional<FileIdentity>& file)
      : request_(std::move(request)), file_(file) {}
  ~Transfer() {
    curl_slist_free_all(extra_headers_);
    if (easy_ != nullptr) curl_easy_cleanup(easy_);
  }
  Transfer(const Transfer&) = delete;
  Transfer& operator=(const Transfer&) = delete;

  Result<CURL*> prepare(const std::string& url, const HttpOptions& options);
  Result<void> outcome(CURLcode code);

 private:
  static std::size_t on_header(char* data, std::size_t, std::size_t size, void* self) {
    return static_cast<Transfer*>(self)->header_line({data, size}) ? size : 0;
  }
  static std::size_t on_body(char* data, std::size_t, std::size_t size, void* self) {
    const auto bytes = std::as_bytes(std::span(data, size));
    return static_cast<Transfer*>(self)->body(bytes) ? size : CURL_WRITEFUNC_ERROR;
  }

  bool header_line(std::string_view line);
  Result<void> check_headers();
  bool body(std::span<const std::byte> bytes);
  bool refuse(Error error) {
    if (!error_) error_ = std::move(error);
    return false;
  }

  RangeRequest request_;
  std::optional<FileIdentity>& file_;
  CURL* easy_ = nullptr;
  curl_slist* extra_headers_ = nullptr;
  bool is_conditional_ = false;

  std::size_t header_bytes_ = 0;
  Headers headers_;
  std::uint64_t expected_ = 0;  ///< bytes, once the headers were accepted
  std::uint64_t received_ = 0;
  bool is_accepted_ = false;
  std::optional<Error> error_;
};

Result<CURL*> Transfer::prepare(const std::string& url, const HttpOptions& options) {
  easy_ = curl_easy_init();
  if (easy_ == nullptr) return fail(ErrorCode::LimitExceeded, "out of memory for a transfer");
  const std::string range = std::to_string(request_.begin) + "-" + std::to_string(request_.end - 1);
  const bool is_https = lower(url).starts_with("https:");
  curl_easy_setopt(easy_, CURLOPT_URL, url.c_str());
  curl_easy_setopt(easy_, CURLOPT_PRIVATE, this);
  curl_easy_setopt(easy_, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(easy_, CURLOPT_PROTOCOLS_STR, "http,https");
  // A redirection never leads out of encryption.
  curl_easy_setopt(easy_, CURLOPT_REDIR_PROTOCOLS_STR, is_https ? "https" : "http,https");
  curl_easy_setopt(easy_, CURLOPT_FOLLOWLOCATION, 1L);
  curl_easy_setopt(easy_, CURLOPT_MAXREDIRS, kMaxRedirects);
  curl_easy_setopt(easy_, CURLOPT_RANGE, range.c_str());
  curl_easy_setopt(easy_, CURLOPT_USERAGENT, "selvage/" SELVAGE_VERSION);
  curl_easy_setopt(easy_, CURLOPT_CONNECTTIMEOUT_MS, static_cast<long>(options.connect_timeout.count()));
  curl_easy_setopt(easy_, CURLOPT_LOW_SPEED_LIMIT, 1L);
  curl_easy_setopt(easy_, CURLOPT_LOW_SPEED_TIME,
                   std::max(1L, static_cast<long>((options.silence_timeout.count() + 999) / 1000)));
  curl_easy_setopt(easy_, CURLOPT_HEADERFUNCTION, &Transfer::on_header);
  curl_easy_setopt(easy_, CURLOPT_HEADERDATA, this);
  curl_easy_setopt(easy_, CURLOPT_WRITEFUNCTION, &Transfer::on_body);
  curl_easy_setopt(easy_, CURLOPT_WRITEDATA, this);
  is_conditional_ = file_ && !file_->validator.empty();
  if (is_conditional_) {
    // With another file there by now, the answer is 200 and not a range of the wrong bytes.
    extra_headers_ = curl_slist_append(extra_headers_, ("If-Range: " + file_->validator).c_str());
    curl_easy_setopt(easy_, CURLOPT_HTTPHEADER, extra_headers_);
  }
  return easy_;
}

/// False ends the transfer.
bool Transfer::header_line(std::string_view line) {
  header_bytes_ += line.size();
  if (header_bytes_ > kMaxHeaderBytes)
    return refuse({ErrorCode::BadStream, "the web server's headers do not end"});
  if (line.starts_with("HTTP/")) {
    headers_ = {};
    const std::size_t space = line.find(' ');
    std::string_view status = space == std::string_view::npos ? "" : line.substr(space + 1);
    std::uint64_t value = 0;
    headers_.status = take_number(status, value) && value < 1000 ? static_cast<long>(value) : 0;
    return true;
  }
  if (trimmed(line).empty()) {
    const bool is_interim = headers_.status >= 100 && headers_.status < 200;
    const bool is_redirection = headers_.status >= 300 && headers_.status < 400 && !headers_.location.empty();
    if (is_interim || is_redirection || is_accepted_) return true;
    auto ok = check_headers();
    return ok ? true : refuse(std::move(ok.error()));
  }
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return true;
  const std::string name = lower(trimmed(line.substr(0, colon)));
  const std::string_view value = trimmed(line.substr(colon + 1));
  if (name == "content-range") headers_.range = parse_content_range(value);
  if (name == "content-encoding") headers_.encoding = lower(value);
  if (name == "etag") headers_.etag = value;
  if (name == "last-modified") headers_.last_modified = value;
  if (name == "location") headers_.location = value;
  return true;
}

Result<void> Transfer::check_headers() {
  if (headers_.status == 200) {
    if (is_conditional_) return fail(ErrorCode::ModelChanged, "the file on the web server has changed");
    return fail(ErrorCode::Unsupported,
                "the web server answers 200 to a request for a range of bytes: it would send the whole file. "
                "Serve the pack from one that supports Range, or with selvage-server");
  }
  if (headers_.status != 206) return tl::unexpected(error_of_status(headers_.status));
  if (!headers_.encoding.empty() && headers_.encoding != "identity") {
    return fail(ErrorCode::Unsupported, "the web server encodes the file (" + headers_.encoding +
                                            "), so its ranges are not those of the pack");
  }
  const auto& range = headers_.range;
  if (!range) return fail(ErrorCode::BadStream, "the web server does not say which range it sends");
  const std::uint64_t last = request_.end - 1;
  const bool is_whole = range->last == last;
  const bool ends_early = request_.may_be_short && range->last < last && range->last + 1 == range->total;
  if (range->first != request_.begin || (!is_whole && !ends_early)) {
    return fail(ErrorCode::BadStream, "the web server sends another range than was asked for");
  }
  const bool is_strong = !headers_.etag.empty() && !headers_.etag.starts_with("W/");
  const FileIdentity file{range->total, is_strong ? headers_.etag : headers_.last_modified};
  if (!file_) {
    file_ = file;
  } else if (file_->size != file.size || (is_conditional_ && file_->validator != file.validator)) {
    return fail(ErrorCode::ModelChanged, "the file on the web server has changed");
  }
  expected_ = range->last - range->first + 1;
  is_accepted_ = true;
  return {};
}

bool Transfer::body(std::span<const std::byte> bytes) {
  if (!is_accepted_)
    return refuse({ErrorCode::BadStream, "the web server sends bytes before it says what they are"});
  if (bytes.size() > expected_ - received_) {
    return refuse({ErrorCode::BadStream, "the web server sends more than the range that was asked for"});
  }
  received_ += bytes.size();
  try {
    auto taken = request_.on_bytes(bytes);
    return taken ? true : refuse(std::move(taken.error()));
  } catch (const std::bad_alloc&) {  // which must not pass through C
    return refuse({ErrorCode::LimitExceeded, "out of memory while receiving"});
  }
}

Result<void> Transfer::outcome(CURLcode code) {
  if (error_) return tl::unexpected(*error_);
  const std::string why = curl_easy_strerror(code);
  switch (code) {
    case CURLE_OK:
      if (!is_accepted_) return tl::unexpected(error_of_status(headers_.status));
      if (received_ != expected_)
        return fail(ErrorCode::Io, "the web server stops in the middle of an answer");
      return {};
    case CURLE_OPERATION_TIMEDOUT:
      return fail(ErrorCode::Timeout, "the web server keeps silent for too long");
    case CURLE_COULDNT_RESOLVE_HOST:
      return fail(ErrorCode::NotFound, "no such host");
    case CURLE_COULDNT_CONNECT:
      return fail(ErrorCode::Unavailable, "cannot connect to the web server");
    case CURLE_URL_MALFORMAT:
    case CURLE_UNSUPPORTED_PROTOCOL:
      return fail(ErrorCode::InvalidArgument, "not a usable URL (" + why + ")");
    case CURLE_TOO_MANY_REDIRECTS:
      return fail(ErrorCode::Unsupported, "the web server redirects in circles");
    case CURLE_PEER_FAILED_VERIFICATION:
    case CURLE_SSL_CONNECT_ERROR:
      return fail(ErrorCode::Unauthorised, "the web server's certificate is not to be trusted (" + why + ")");
    case CURLE_WEIRD_SERVER_REPLY:
      return fail(ErrorCode::BadStream, "that is no web server (" + why + ")");
    default:
      return fail(ErrorCode::Io, "the connection to the web server broke (" + why + ")");
  }
}

// ---- client
// --------------------------------------------------------------------------------------------------

struct RangeClient::Impl {
  Impl(std::string address, HttpOptions limits) : url(std::move(address)), options(limits) {
    initialise_curl_once();
    multi = curl_multi_init();
  }
  ~Impl() {
    stop_all();
    curl_multi_cleanup(multi);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  struct Running {
    CURL* easy;
    std::unique_ptr<Transfer> transfer;
  };

  Result<void> start(RangeRequest request) {
    auto transfer = std::make_unique<Transfer>(std::move(request), file);
    auto easy = transfer->prepare(url, options);
    if (!easy) return forward_error(easy);
    curl_multi_add_handle(multi, *easy);
    running.push_back({*easy, std::move(transfer)});
    return {};
  }

  Result<void> end(CURL* easy, CURLcode code) {
    const auto found = std::ranges::find(running, easy, &Running::easy);
    auto outcome = found->transfer->outcome(code);
    curl_multi_remove_handle(multi, easy);
    running.erase(found);
    return outcome;
  }

  void stop_all() {
    for (const Running& one : running) curl_multi_remove_handle(multi, one.easy);
    running.clear();
  }

  /// Takes note of every transfer that has ended.
  Result<void> reap() {
    int left = 0;
    while (CURLMsg* message = curl_multi_info_read(multi, &left)) {
      if (message->msg != CURLMSG_DONE) continue;
      auto ok = end(message->easy_handle, message->data.result);
      if (!ok) return ok;
    }
    return {};
  }

  const std::string url;
  const HttpOptions options;
  CURLM* multi = nullptr;
  std::optional<FileIdentity> file;
  std::vector<Running> running;
};

RangeClient::RangeClient(std::string url, HttpOptions options)
    : impl_(std::make_unique<Impl>(std::move(url), options)) {}
RangeClient::~RangeClient() = default;

std::uint64_t RangeClient::file_size() const { return impl_->file ? impl_->file->size : 0; }

Result<void> RangeClient::fetch(std::vector<RangeRequest> requests, const std::stop_token& stop) {
  const std::stop_callback wakes(stop, [multi = impl_->multi] { curl_multi_wakeup(multi); });
  std::size_t next = 0;
  Result<void> outcome;
  while (outcome && (next < requests.size() || !impl_->running.empty())) {
    while (outcome && next < requests.size() && impl_->running.size() < impl_->options.connections) {
      outcome = impl_->start(std::move(requests[next++]));
      if (!impl_->file) break;  // until the first answer says which file it is
    }
    int active = 0;
    curl_multi_perform(impl_->multi, &active);
    if (outcome) outcome = impl_->reap();
    if (stop.stop_requested()) outcome = fail(ErrorCode::Cancelled, "cancelled");
    if (outcome && active > 0) curl_multi_poll(impl_->multi, nullptr, 0, 1000, nullptr);
  }
  impl_->stop_all();
  return outcome;
}

}  // namespace selvage
