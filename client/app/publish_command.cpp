// SPDX-License-Identifier: MIT
#include "client/app/publish_command.h"

#include <fstream>
#include <stop_token>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/fetch/retrying.h"
#include "common/base/hasher.h"
#include "common/base/progress_line.h"
#include "common/base/stop_on_interrupt.h"

namespace selvage {
namespace {

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
    if (file->bad()) return fail(ErrorCode::BadFile, path.string() + ": cannot be read any more");
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

Result<Published> publish_once(const PublishCommand& command, const Publish& what,
                               const OnPublishState& on_state, const std::stop_token& stop) {
  auto client = command.connection.connect(command.server, stop);
  if (!client) return forward_error(client);
  auto published = client->publish(request_for(command.model, what), on_state, stop);
  if (!published) return forward_error(published, command.server);
  return published;
}

/// Goes on after a lost connection, a restart of the server or while it is full: what arrived is kept there.
Result<Published> publish(const PublishCommand& command, const Publish& what) {
  const StopOnInterrupt interrupt;
  ProgressLine line;
  std::uint64_t sent = 0;  // written by the network thread, which publish_once outlives
  RetryPolicy policy;
  policy.give_up_after = std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * command.retry_seconds));
  Retrying retrying(policy, [&](const Error& error, std::chrono::milliseconds delay) {
    line.show_now(fmt::format("{}; trying again in {:.1f} s", error.message,
                              1e-3 * static_cast<double>(delay.count())));
  });
  for (;;) {
    const std::uint64_t sent_before = sent;
    const auto on_state = [&](const PublishState& state) {
      sent = std::max(sent, state.sent_bytes);
      line.show(to_text(state, what));
    };
    auto published = publish_once(command, what, on_state, interrupt.token());
    if (published) return published;
    if (sent > sent_before) retrying.note_progress();
    if (retrying.try_again(published.error(), interrupt.token())) continue;
    const bool is_cut_short = may_pass(published.error()) && interrupt.token().stop_requested();
    if (!is_cut_short) return published;
    return fail(ErrorCode::Cancelled, "cancelled; what was sent is kept for a while");
  }
}

}  // namespace

Result<void> run(const PublishCommand& command) {
  auto what = describe(command);
  if (!what) return forward_error(what);
  auto published = publish(command, *what);
  if (!published) return forward_error(published);
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
  auto client = command.connection.connect(command.server);
  if (!client) return forward_error(client);
  if (auto gone = client->unpublish(command.name); !gone) return forward_error(gone, command.server);
  fmt::print("{}/{} is gone\n", command.server, command.name);
  return {};
}

}  // namespace selvage
