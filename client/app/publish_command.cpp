// SPDX-License-Identifier: MIT
#include "client/app/publish_command.h"

#include <csignal>
#include <fstream>
#include <stop_token>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/session/blocking_client.h"
#include "common/base/hasher.h"
#include "common/base/progress_line.h"

namespace selvage {
namespace {

volatile std::sig_atomic_t g_interrupted = 0;

constexpr std::chrono::milliseconds kFirstPause{500}, kLongestPause{10'000};

/// The file, and what is said of it on the wire.
Result<Publish> describe(const PublishCommand& command) {
  std::ifstream file(command.model, std::ios::binary);
  if (!file) return fail(ErrorCode::NotFound, command.model.string() + ": cannot be read");
  Publish what;
  Hasher hasher;
  std::vector<char> block(1u << 20);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0) {
    const auto count = static_cast<std::size_t>(file.gcount());
    hasher.add(std::as_bytes(std::span(block.data(), count)));
    what.size_bytes += count;
  }
  if (what.size_bytes == 0) return fail(ErrorCode::BadFile, command.model.string() + ": is empty");
  what.hash = hasher.finish();
  what.name = command.name.empty() ? command.model.stem().string() : command.name;
  what.file = command.model.filename().string();
  what.replace = command.replace;
  what.lossless = command.lossless;
  what.bits = static_cast<std::uint8_t>(command.bits);
  what.units = command.units;
  what.cut = command.cut;
  return what;
}

PublishRequest request_for(const std::filesystem::path& path, const Publish& what) {
  auto file = std::make_shared<std::ifstream>(path, std::ios::binary);
  const auto read = [file, path](std::uint64_t offset, std::span<std::byte> into) -> Result<std::size_t> {
    file->clear();
    file->seekg(static_cast<std::streamoff>(offset));
    file->read(reinterpret_cast<char*>(into.data()), static_cast<std::streamsize>(into.size()));
    if (file->bad()) return fail(ErrorCode::Io, path.string() + ": cannot be read");
    return static_cast<std::size_t>(file->gcount());
  };
  return {what, read};
}

std::string to_text(const PublishState& state, const Publish& what) {
  const PublishProgress& server = state.server;
  if (server.stage.empty()) {
    return fmt::format("sent {:.0f} % of {} KiB",
                       100.0 * static_cast<double>(state.sent_bytes) / static_cast<double>(what.size_bytes),
                       what.size_bytes / 1024);
  }
  if (server.stage == "wait") return fmt::format("waits for {} others", server.ahead);
  return server.permille > 0 ? fmt::format("{} {} %", server.stage, server.permille / 10) : server.stage;
}

/// Requests a stop once Ctrl-C was pressed, for as long as it lives.
class StopOnInterrupt {
 public:
  explicit StopOnInterrupt(std::stop_source& source)
      : watcher_([&source](std::stop_token end) {
          while (!end.stop_requested() && g_interrupted == 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
          }
          if (g_interrupted != 0) source.request_stop();
        }) {}

 private:
  std::jthread watcher_;
};

/// A connection that breaks, a server that restarts or is full: what arrived is kept there.
bool may_resume(const Error& error) {
  return error.code == ErrorCode::Io || error.code == ErrorCode::Unavailable ||
         error.code == ErrorCode::Timeout;
}

Result<Published> publish_once(const PublishCommand& command, const Publish& what, ProgressLine& line,
                               std::uint64_t& sent, std::stop_token stop) {
  auto server = parse_host_port(command.server);
  if (!server) return forward_error(server);
  auto options = command.connection.client_options();
  if (!options) return forward_error(options);
  auto client = BlockingClient::connect(*server, *options);
  if (!client) return forward_error(client);
  const auto on_state = [&](const PublishState& state) {
    sent = std::max(sent, state.sent_bytes);
    line.show(to_text(state, what));
  };
  return client->publish(request_for(command.model, what), on_state, std::move(stop));
}

/// Goes on after a lost connection, with longer and longer pauses while nothing more gets through.
Result<Published> publish(const PublishCommand& command, const Publish& what) {
  std::stop_source source;
  const StopOnInterrupt stops(source);
  ProgressLine line;
  std::uint64_t sent = 0;
  auto pause = kFirstPause;
  for (int failures = 0;; ++failures) {
    const std::uint64_t sent_before = sent;
    auto published = publish_once(command, what, line, sent, source.get_token());
    if (sent > sent_before) {
      failures = 0;
      pause = kFirstPause;
    }
    if (published || !may_resume(published.error()) || failures >= command.retries) return published;
    line.show(fmt::format("{}; trying again", published.error().message));
    for (auto slept = pause * 0; slept < pause && g_interrupted == 0; slept += kFirstPause / 5) {
      std::this_thread::sleep_for(kFirstPause / 5);
    }
    if (g_interrupted != 0) return fail(ErrorCode::Cancelled, "cancelled; what was sent is kept for a while");
    pause = std::min(2 * pause, kLongestPause);
  }
}

}  // namespace

Result<void> run(const PublishCommand& command) {
  auto what = describe(command);
  if (!what) return forward_error(what);
  std::signal(SIGINT, [](int) { g_interrupted = 1; });
  auto published = publish(command, *what);
  if (!published) return forward_error(published, command.server);
  for (const std::string& note : published->notes) fmt::print(stderr, "{}: {}\n", what->file, note);
  if (command.json) {
    const nlohmann::ordered_json json = {
        {"name", published->name},         {"id", published->pack_id.to_hex()},
        {"bytes", published->size_bytes},  {"regions", published->regions},
        {"vertices", published->vertices}, {"triangles", published->triangles},
        {"notes", published->notes}};
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("{}/{}: {} vertices, {} triangles in {} region{}, {} bytes\n", command.server, published->name,
               published->vertices, published->triangles, published->regions,
               published->regions == 1 ? "" : "s", published->size_bytes);
  }
  return {};
}

Result<void> run(const UnpublishCommand& command) {
  auto server = parse_host_port(command.server);
  if (!server) return forward_error(server, command.server);
  auto options = command.connection.client_options();
  if (!options) return forward_error(options);
  auto client = BlockingClient::connect(*server, *options);
  if (!client) return forward_error(client, command.server);
  if (auto gone = client->unpublish(command.name); !gone) return forward_error(gone, command.server);
  fmt::print("{}/{} is gone\n", command.server, command.name);
  return {};
}

}  // namespace selvage
