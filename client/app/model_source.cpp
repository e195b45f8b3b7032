// SPDX-License-Identifier: MIT
#include "client/app/model_source.h"

#include <mutex>
#include <optional>

#include <fmt/format.h>

#include "client/session/blocking_client.h"
#include "client/stitch/part_collector.h"
#include "common/base/task_group.h"

namespace selvage {
namespace {

using Clock = std::chrono::steady_clock;

struct ModelAddress {
  HostPort server;
  std::string model;
};

Result<ModelAddress> parse_address(const std::string& text) {
  const std::size_t slash = text.rfind('/');
  auto server = parse_host_port(text.substr(0, slash));
  if (slash == std::string::npos || slash + 1 == text.size() || !server) {
    return fail(ErrorCode::InvalidArgument,
                "'" + text + "' is neither a pack that exists nor HOST:PORT/MODEL");
  }
  return ModelAddress{std::move(*server), text.substr(slash + 1)};
}

/// Decodes parts on worker threads and keeps the first failure.
class Decoding {
 public:
  Decoding(const Directory& directory, unsigned threads, Clock::time_point begin)
      : collector_(directory), begin_(begin), tasks_(threads) {}

  /// `keep_alive` is destroyed once the part is decoded: the bytes' owner, and what tells a server to send
  /// more.
  template <class KeepAlive>
  void add(const PartId& id, std::span<const std::byte> bytes, KeepAlive keep_alive) {
    auto held = std::make_shared<KeepAlive>(std::move(keep_alive));
    tasks_.run([this, id, bytes, held] { note(id, collector_.add(id, bytes)); });
  }

  Result<void> failure() {
    const std::scoped_lock lock(mutex_);
    if (failure_) return tl::unexpected(*failure_);
    return {};
  }

  Result<void> finish(FetchedModel& model) {
    tasks_.wait();
    if (auto ok = failure(); !ok) return ok;
    model.mesh = collector_.mesh();
    model.regions = collector_.region_count();
    model.time_to_first_region = first_region_.value_or(begin_) - begin_;
    model.time_to_mesh = Clock::now() - begin_;
    return {};
  }

 private:
  void note(const PartId& id, Result<void> outcome) {
    const auto now = Clock::now();
    const std::scoped_lock lock(mutex_);
    if (!outcome && !failure_) failure_ = std::move(outcome.error());
    if (id.kind == PartKind::Region && !first_region_) first_region_ = now;
  }

  PartCollector collector_;
  const Clock::time_point begin_;
  std::mutex mutex_;
  std::optional<Error> failure_;
  std::optional<Clock::time_point> first_region_;
  TaskGroup tasks_;  // last: its tasks use the rest
};

}  // namespace

std::string provenance(const Directory& directory) {
  const Grid& grid = directory.grid;
  return fmt::format("selvage model {}, grid of {} bits, step {}, origin {} {} {}", directory.name, grid.bits,
                     grid.step, grid.origin.x, grid.origin.y, grid.origin.z);
}

Result<FetchedModel> fetch_from_pack(const std::filesystem::path& path, const FetchOptions& options) {
  const auto begin = Clock::now();
  auto pack = Pack::open(path);
  if (!pack) return forward_error(pack);
  auto selection = resolve_names((*pack)->directory(), options.selection);
  if (!selection) return forward_error(selection, path.string());
  auto parts = select_parts((*pack)->directory(), *selection);
  if (!parts) return forward_error(parts, path.string());

  FetchedModel model;
  model.directory = (*pack)->directory();
  model.directory_bytes = (*pack)->directory_bytes().size();
  Decoding decoding(model.directory, options.threads, begin);
  for (const PartId& id : *parts) {
    const PartRef& ref = *model.directory.find(id);
    if (auto ok = check_part(ref, (*pack)->part(ref)); !ok) return forward_error(ok, path.string());
    decoding.add(id, (*pack)->part(ref), *pack);
    model.part_bytes += ref.size;
    ++model.parts;
  }
  if (auto ok = decoding.finish(model); !ok) return forward_error(ok, path.string());
  return model;
}

Result<FetchedModel> fetch_from_server(const std::string& address, const FetchOptions& options,
                                       const FetchProgress& progress) {
  const auto begin = Clock::now();
  auto where = parse_address(address);
  if (!where) return forward_error(where);
  auto client = BlockingClient::connect(where->server, options.connection);
  if (!client) return forward_error(client, address);
  auto manifest = client->open(where->model);
  if (!manifest) return forward_error(manifest, address);
  auto selection = resolve_names((*manifest)->directory, options.selection);
  if (!selection) return forward_error(selection, address);
  auto expected = select_parts((*manifest)->directory, *selection);
  if (!expected) return forward_error(expected, address);

  FetchedModel model;
  model.directory = (*manifest)->directory;
  model.directory_bytes = (*manifest)->directory_bytes;
  Decoding decoding(model.directory, options.threads, begin);
  auto stats = client->get({*manifest, *selection, {}}, [&](ReceivedPart part) -> Result<void> {
    model.part_bytes += part.bytes.size();
    ++model.parts;
    progress(model.parts, static_cast<std::uint32_t>(expected->size()), model.part_bytes);
    // Moving a vector keeps its bytes where they are.
    const std::span<const std::byte> bytes(part.bytes);
    const PartId id = part.id;
    decoding.add(id, bytes, std::move(part));
    return decoding.failure();
  });
  if (!stats) return forward_error(stats, address);
  if (auto ok = decoding.finish(model); !ok) return forward_error(ok, address);
  return model;
}

Result<FetchedModel> fetch(const std::string& source, const FetchOptions& options,
                           const FetchProgress& progress) {
  if (std::filesystem::exists(source)) return fetch_from_pack(source, options);
  return fetch_from_server(source, options, progress);
}

Result<Directory> fetch_directory(const std::string& source, const ClientOptions& connection) {
  if (std::filesystem::exists(source)) {
    auto pack = Pack::open(source);
    if (!pack) return forward_error(pack);
    return (*pack)->directory();
  }
  auto where = parse_address(source);
  if (!where) return forward_error(where);
  auto client = BlockingClient::connect(where->server, connection);
  if (!client) return forward_error(client, source);
  auto manifest = client->open(where->model);
  if (!manifest) return forward_error(manifest, source);
  return (*manifest)->directory;
}

}  // namespace selvage
