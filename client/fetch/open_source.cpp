// SPDX-License-Identifier: MIT
#include "client/fetch/open_source.h"

#include <filesystem>

#include "client/fetch/pack_source.h"
#include "client/fetch/server_source.h"
#include "client/http/http_source.h"

namespace selvage {
namespace {

bool is_url(const std::string& text) { return text.starts_with("http://") || text.starts_with("https://"); }

}  // namespace

Result<OpenedSource> open_source(const std::string& text, const ClientOptions& connection) {
  if (is_url(text)) {
    HttpOptions options;
    options.connect_timeout = connection.connect_timeout;
    options.silence_timeout = connection.silence_timeout;
    options.max_directory_bytes = connection.max_directory_bytes;
    return OpenedSource{std::make_unique<HttpSource>(text, options), true};
  }
  std::error_code ignored;
  if (std::filesystem::exists(text, ignored)) return OpenedSource{std::make_unique<PackSource>(text), false};

  const std::size_t slash = text.rfind('/');
  auto server = parse_host_port(text.substr(0, slash));
  if (slash == std::string::npos || slash + 1 == text.size() || !server) {
    return fail(ErrorCode::InvalidArgument,
                "'" + text + "' is neither a pack that exists nor HOST:PORT/MODEL nor a URL");
  }
  return OpenedSource{std::make_unique<ServerSource>(std::move(*server), text.substr(slash + 1), connection),
                      true};
}

}  // namespace selvage
