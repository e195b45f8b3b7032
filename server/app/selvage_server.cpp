// SPDX-License-Identifier: MIT
//
// selvage-server: serves a folder of packs. The threads and signals of the server are here; what it says to
// clients is in server/session, what it takes from publishers in server/publish.
#include <atomic>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/thread_pool.hpp>
#include <fmt/format.h>

#include "common/base/log.h"
#include "common/base/replace_file.h"
#include "common/net/tcp_stream.h"
#include "common/net/tls.h"
#include "common/pack/mapped_file.h"
#include "server/app/server_options.h"
#include "server/operate/health_server.h"
#include "server/operate/metrics.h"
#include "server/publish/publisher.h"
#include "server/session/listener.h"
#include "server/store/pack_store.h"

namespace {

using namespace selvage;

constexpr const char* kExamples =
    "Examples:\n"
    "  selvage-server --store packs\n"
    "  selvage-server --store packs --listen 0.0.0.0:7878 --cert server.crt --key server.key --tokens "
    "tokens\n"
    "  selvage-server --store packs --listen 192.168.1.5:7878 --allow-plain\n"
    "  selvage-server --config /etc/selvage/server.toml --health 127.0.0.1:7879\n"
    "  selvage-server --store packs --listen 127.0.0.1:0 --port-file port.txt\n"
    "\n"
    "The first line on stdout is 'listening on HOST:PORT'. SIGINT and SIGTERM let requests in flight "
    "finish,\n"
    "a second one cuts them off; SIGHUP reads the certificate, its key and the tokens again, for "
    "connections\n"
    "to come. Exit codes: 0 stopped by a signal, 130 cut off by a second, 1 failure, 100 and more bad "
    "options.";

/// How often we look for what changed in the store, to log it; clients see it at once in any case.
constexpr std::chrono::seconds kWatchInterval{1};

/// For whoever started us, a person or a script.
Result<void> announce(const ServerOptions& options, const HostPort& address) {
  fmt::print("listening on {}\n", address.to_string());
  std::fflush(stdout);
  if (options.port_file.empty()) return {};
  const std::string text = std::to_string(address.port) + "\n";
  return replace_file(options.port_file, text);
}

Result<std::shared_ptr<TlsContext>> load_tls(const ServerOptions& options) {
  if (!options.is_encrypted()) return std::shared_ptr<TlsContext>();
  return tls_server_context(options.tls);
}

Result<AccessTable> load_tokens(const ServerOptions& options) {
  if (options.tokens.empty()) return AccessTable();
  return AccessTable::read(options.tokens);
}

/// SIGHUP: what cannot be read leaves what is in force.
void reload(const ServerOptions& options, AccessControl& access, Listener& listener) {
  if (auto table = load_tokens(options)) {
    log(LogLevel::Info, "tokens read again", {{"tokens", std::to_string(table->token_count())}});
    access.replace(std::move(*table));
  } else {
    log(LogLevel::Error, "the tokens stay as they were: " + table.error().to_string());
  }
  if (auto tls = load_tls(options); !tls) {
    log(LogLevel::Error, "the certificate stays as it was: " + tls.error().to_string());
  } else if (*tls) {
    listener.set_tls(std::move(*tls));
    log(LogLevel::Info, "certificate read again");
  }
}

/// Counts the signals that ask us to stop, and passes them on; SIGHUP calls `on_hangup`.
class Signals {
 public:
  /// On the listener's strand: otherwise the listener could be gone, and cancel() over, before wait() comes
  /// round.
  Signals(Listener& listener, std::function<void()> on_hangup)
      : signals_(listener.executor(), SIGINT, SIGTERM, SIGHUP),
        listener_(listener),
        on_hangup_(std::move(on_hangup)) {
    wait();
  }
  int stops() const { return stops_; }
  void cancel() { signals_.cancel(); }

 private:
  void wait() {
    signals_.async_wait([this](const boost::system::error_code& error, int signal) {
      if (error) return;
      if (signal == SIGHUP) {
        on_hangup_();
      } else {
        stop();
      }
      wait();
    });
  }

  void stop() {
    ++stops_;
    log(LogLevel::Info,
        stops_ == 1 ? "stopping; once more to cut off the requests in flight" : "cutting off");
    listener_.shut_down();
  }

  asio::signal_set signals_;
  Listener& listener_;
  const std::function<void()> on_hangup_;
  std::atomic<int> stops_ = 0;
};

void log_event(const StoreEvent& event) {
  switch (event.kind) {
    case StoreEvent::Kind::Appeared:
    case StoreEvent::Kind::Replaced:
      return log(LogLevel::Info,
                 event.kind == StoreEvent::Kind::Appeared ? "model appeared" : "model replaced",
                 {{"model", event.model}, {"bytes", std::to_string(event.size_bytes)}});
    case StoreEvent::Kind::Refused:
      return log(LogLevel::Warning, "model refused", {{"model", event.model}, {"reason", event.reason}});
    case StoreEvent::Kind::Gone:
      return log(LogLevel::Info, "model gone", {{"model", event.model}});
  }
}

/// Looks at the store now and then, so that what happens to it is logged and counted though nobody asks.
void watch(PackStore& store, std::stop_token stop) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  bool was_readable = true;
  while (!stop.stop_requested()) {
    const auto models = store.list();
    if (!models && was_readable) log(LogLevel::Error, models.error().to_string());
    was_readable = models.has_value();
    never.wait_for(lock, stop, kWatchInterval, [] { return false; });
  }
}

Result<std::unique_ptr<HealthServer>> start_health(const ServerOptions& options,
                                                   const SessionServices& services, const Signals& signals) {
  if (options.health.empty()) return std::unique_ptr<HealthServer>();
  auto address = parse_host_port(options.health);
  if (!address) return forward_error(address);
  HealthPages pages;
  pages.metrics = [&services] { return metrics_text(services); };
  pages.readiness = [&services, &signals]() -> Result<void> {
    if (signals.stops() > 0) return fail(ErrorCode::Unavailable, "shutting down");
    auto models = services.store.list();
    if (!models) return forward_error(models);
    return {};
  };
  auto health = HealthServer::start(*address, std::move(pages));
  if (health) log(LogLevel::Info, "health and metrics", {{"address", (*health)->address().to_string()}});
  return health;
}

/// As many descriptors as the system lets us have, since every connection needs one.
void allow_many_files() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

/// Connections beyond what there are descriptors for would be refused by the system, without a word.
void check_file_limit(const ServerOptions& options) {
  constexpr rlim_t kOthers = 100;
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= options.limits.connections + kOthers)
    return;
  log(LogLevel::Warning, "fewer descriptors than --max-connections; LimitNOFILE or ulimit -n raise them",
      {{"descriptors", std::to_string(limit.rlim_cur)},
       {"max_connections", std::to_string(options.limits.connections)}});
}

void run_on_threads(asio::io_context& io, unsigned threads) {
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < threads; ++i) others.emplace_back([&io] { io.run(); });
  io.run();
}

/// Encryption is the rule for whatever leaves this machine.
Result<void> check_exposure(const ServerOptions& options, const Listener& listener) {
  if (options.is_encrypted() || options.allow_plain || listener.is_on_loopback()) return {};
  return fail(ErrorCode::InvalidArgument,
              "--listen " + options.listen +
                  ": other machines would be served unencrypted; give --cert and --key, or --allow-plain "
                  "where the network can be trusted");
}

Result<int> serve(const ServerOptions& options) {
  auto address = parse_host_port(options.listen);
  if (!address) return forward_error(address, "--listen");
  auto store = PackStore::open_folder(options.store, {options.store_poll, log_event});
  if (!store) return forward_error(store, "--store");
  auto tls = load_tls(options);
  if (!tls) return forward_error(tls);
  auto tokens = load_tokens(options);
  if (!tokens) return forward_error(tokens, "--tokens");

  check_file_limit(options);
  const unsigned threads =
      options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
  // What is used by what stands below it comes first, so that it goes last.
  AccessControl access(std::move(*tokens));
  ServerCounters counters;
  asio::io_context io(static_cast<int>(threads));
  Publisher publisher(**store, counters, options.publish);
  asio::thread_pool workers(1);
  const SessionServices services{**store,
                                 workers.get_executor(),
                                 access,
                                 counters,
                                 &publisher,
                                 options.limits.connections,
                                 options.is_encrypted()};
  auto listener = Listener::bind(io, *address, services, options.limits, std::move(*tls));
  if (!listener) return forward_error(listener);
  if (!options.congestion_control.empty()) {
    auto chosen = (*listener)->use_congestion_control(options.congestion_control);
    if (!chosen) return forward_error(chosen, "--congestion-control");
  }
  if (auto ok = check_exposure(options, **listener); !ok) return forward_error(ok);
  Signals signals(**listener, [&] { reload(options, access, **listener); });
  auto health = start_health(options, services, signals);
  if (!health) return forward_error(health, "--health");
  const std::jthread watcher([&](std::stop_token stop) { watch(**store, stop); });
  auto announced = announce(options, (*listener)->address());
  if (!announced) return forward_error(announced, "--port-file");

  asio::co_spawn((*listener)->executor(), (*listener)->run(), [&signals](std::exception_ptr thrown) {
    signals.cancel();
    if (thrown) std::rethrow_exception(thrown);
  });
  run_on_threads(io, threads);
  workers.join();
  return signals.stops() > 1 ? 130 : 0;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Serves the selvage packs of a folder.", "selvage-server");
  app.set_version_flag("--version", SELVAGE_VERSION);
  app.footer(kExamples);
  ServerOptions options;
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  set_log_level(options.log_level());
  set_log_format(options.log_format);
  std::signal(SIGPIPE, SIG_IGN);  // of whoever reads our stdout
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of that upload
  survive_truncated_files();
  allow_many_files();

  const auto served = serve(options);
  if (served) return *served;
  std::fprintf(stderr, "selvage-server: %s\n", served.error().to_string().c_str());
  return 1;
} catch (const std::exception& exception) {
  std::fprintf(stderr, "selvage-server: %s\n", exception.what());
  return 1;
}
