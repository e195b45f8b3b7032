// SPDX-License-Identifier: MIT
//
// selvage-server: serves a folder of packs. The threads and signals of the server are here; what it says to
// clients is in server/session.
#include <csignal>
#include <cstdio>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/thread_pool.hpp>
#include <fmt/format.h>

#include "common/base/log.h"
#include "common/base/replace_file.h"
#include "common/net/tcp_stream.h"
#include "server/session/listener.h"
#include "server/store/pack_store.h"

namespace {

using namespace selvage;

constexpr const char* kExamples =
    "Examples:\n"
    "  selvage-server --store packs\n"
    "  selvage-server --store packs --listen 0.0.0.0:7878\n"
    "  selvage-server --store packs --listen 127.0.0.1:0 --port-file port.txt\n"
    "\n"
    "The first line on stdout is 'listening on HOST:PORT'. SIGINT and SIGTERM let requests in flight "
    "finish,\n"
    "a second one cuts them off. Exit codes: 0 stopped by a signal, 130 cut off by a second, 1 failure,\n"
    "100 and more bad options.";

struct Options {
  std::string store;
  std::string listen = "127.0.0.1:7878";
  std::string port_file;
  unsigned threads = 0;
  bool verbose = false;
  ServerLimits limits;
};

void add_seconds(CLI::App& app, const std::string& name, std::chrono::milliseconds& value,
                 const std::string& help) {
  const auto set = [&value](const double& seconds) {
    value = std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000));
  };
  app.add_option_function<double>(name, set, help)
      ->check(CLI::Range(0.001, 86400.0))
      ->default_str(fmt::format("{:g}", static_cast<double>(value.count()) / 1000))
      ->type_name("SECONDS")
      ->group("Limits");
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("--store", options.store, "folder with NAME.selvage packs")->required()->type_name("DIR");
  app.add_option("--listen", options.listen, "address to listen on; port 0 picks a free one")
      ->capture_default_str()
      ->type_name("HOST:PORT");
  app.add_option("--port-file", options.port_file, "write the port to this file once listening")
      ->type_name("FILE");
  app.add_option("--threads", options.threads, "network threads; 0: one for each processor")
      ->capture_default_str();
  app.add_flag("--verbose", options.verbose, "log every connection's end");

  SessionLimits& session = options.limits.session;
  app.add_option("--max-connections", options.limits.connections, "clients at a time")
      ->capture_default_str()
      ->group("Limits");
  app.add_option("--max-requests", session.requests, "requests in flight for each client")
      ->capture_default_str()
      ->group("Limits");
  app.add_option("--max-rate", session.bytes_per_second, "bytes a second for each client; 0: no limit")
      ->capture_default_str()
      ->type_name("BYTES")
      ->group("Limits");
  add_seconds(app, "--handshake-timeout", session.handshake_timeout, "for a client to say hello");
  add_seconds(app, "--idle-timeout", session.idle_timeout, "for a client that says nothing");
  add_seconds(app, "--write-timeout", session.write_timeout,
              "for a client that takes nothing of what it asked for");
  add_seconds(app, "--shutdown-grace", options.limits.shutdown_grace, "for requests in flight at the end");
}

/// For whoever started us, a person or a script.
Result<void> announce(const Options& options, const HostPort& address) {
  fmt::print("listening on {}\n", address.to_string());
  std::fflush(stdout);
  if (options.port_file.empty()) return {};
  const std::string text = std::to_string(address.port) + "\n";
  return replace_file(options.port_file, text);
}

/// Counts the signals that ask us to stop, and passes them on.
class StopSignals {
 public:
  /// On the listener's strand: otherwise the listener could be gone, and cancel() over, before wait() comes
  /// round.
  explicit StopSignals(Listener& listener)
      : signals_(listener.executor(), SIGINT, SIGTERM), listener_(listener) {
    wait();
  }
  int count() const { return count_; }
  void cancel() { signals_.cancel(); }

 private:
  void wait() {
    signals_.async_wait([this](const boost::system::error_code& error, int) {
      if (error) return;
      ++count_;
      log(LogLevel::Info,
          count_ == 1 ? "stopping; once more to cut off the requests in flight" : "cutting off");
      listener_.shut_down();
      wait();
    });
  }

  asio::signal_set signals_;
  Listener& listener_;
  int count_ = 0;
};

void run_on_threads(asio::io_context& io, unsigned threads) {
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < threads; ++i) others.emplace_back([&io] { io.run(); });
  io.run();
}

Result<int> serve(const Options& options) {
  auto address = parse_host_port(options.listen);
  if (!address) return forward_error(address, "--listen");
  auto store = PackStore::open_folder(options.store);
  if (!store) return forward_error(store, "--store");

  const unsigned threads =
      options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
  asio::io_context io(static_cast<int>(threads));
  asio::thread_pool workers(1);
  auto listener = Listener::bind(io, *address, **store, workers.get_executor(), options.limits);
  if (!listener) return forward_error(listener);
  StopSignals signals(**listener);
  auto announced = announce(options, (*listener)->address());
  if (!announced) return forward_error(announced, "--port-file");

  asio::co_spawn((*listener)->executor(), (*listener)->run(), [&signals](std::exception_ptr thrown) {
    signals.cancel();
    if (thrown) std::rethrow_exception(thrown);
  });
  run_on_threads(io, threads);
  workers.join();
  return signals.count() > 1 ? 130 : 0;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Serves the selvage packs of a folder.", "selvage-server");
  app.set_version_flag("--version", SELVAGE_VERSION);
  app.footer(kExamples);
  Options options;
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  set_log_level(options.verbose ? LogLevel::Debug : LogLevel::Info);
  std::signal(SIGPIPE, SIG_IGN);

  const auto served = serve(options);
  if (served) return *served;
  std::fprintf(stderr, "selvage-server: %s\n", served.error().to_string().c_str());
  return 1;
} catch (const std::exception& exception) {
  std::fprintf(stderr, "selvage-server: %s\n", exception.what());
  return 1;
}
