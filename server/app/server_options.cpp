// SPDX-License-Identifier: MIT
#include "server/app/server_options.h"

#include <map>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "server/app/toml_config.h"

namespace selvage {
namespace {

const std::string kLimits = "Limits", kPublishing = "Publishing", kSecurity = "Security";

template <class Duration>
CLI::Option* add_seconds(CLI::App& app, const std::string& name, Duration& value, const std::string& help) {
  const auto set = [&value](const double& seconds) {
    value = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
  };
  const std::chrono::duration<double> now = value;
  return app.add_option_function<double>(name, set, help)
      ->check(CLI::Range(0.001, 1e8))
      ->default_str(fmt::format("{:g}", now.count()))
      ->type_name("SECONDS");
}

/// "64KiB", "256MiB" or plain bytes.
template <class Bytes>
CLI::Option* add_bytes(CLI::App& app, const std::string& name, Bytes& value, const std::string& help) {
  return app.add_option(name, value, help)
      ->transform(CLI::AsSizeValue(false))
      ->capture_default_str()
      ->type_name("BYTES");
}

template <class Count>
CLI::Option* add_count(CLI::App& app, const std::string& name, Count& value, const std::string& help) {
  return app.add_option(name, value, help)->capture_default_str()->type_name("N");
}

void add_security(CLI::App& app, ServerOptions& options) {
  app.option_defaults()->group(kSecurity);
  auto* cert = app.add_option("--cert", options.tls.certificate,
                              "encrypt with TLS 1.3: the certificate and those up to its authority, PEM")
                   ->type_name("FILE");
  auto* key =
      app.add_option("--key", options.tls.key, "the certificate's private key, PEM")->type_name("FILE");
  cert->needs(key);
  key->needs(cert);
  app.add_flag("--allow-plain", options.allow_plain,
               "serve other machines without encryption, on a network that you trust");
  app.add_option("--tokens", options.tokens, "who may read and publish; without it all read and none publish")
      ->type_name("FILE");
}

void add_limits(CLI::App& app, ServerOptions& options) {
  app.option_defaults()->group(kLimits);
  ServerLimits& server = options.limits;
  SessionLimits& session = server.session;
  add_count(app, "--max-connections", server.connections, "clients at a time");
  add_count(app, "--max-connections-per-address", server.connections_per_address,
            "clients at a time from one address");
  add_count(app, "--max-requests", session.requests, "requests in flight for each client");
  add_count(app, "--max-ids", session.ids_per_request, "regions named in one request");
  add_count(app, "--max-queued-parts", session.queued_parts, "parts still to be sent to one client");
  add_count(app, "--max-opened-models", session.opened_models, "models that a client has open at a time");
  add_bytes(app, "--max-message", session.message_bytes, "of one message from a client")
      ->check(CLI::Range(std::uint64_t{128} << 10, std::uint64_t{kMaxPayload}));
  add_bytes(app, "--max-queued", session.queued_bytes, "of answers without data that a client does not take");
  add_bytes(app, "--max-rate", session.bytes_per_second, "a second for each client; 0: no limit");
  add_seconds(app, "--handshake-timeout", session.handshake_timeout, "for a client to say hello");
  add_seconds(app, "--idle-timeout", session.idle_timeout, "for a client that says nothing");
  add_seconds(app, "--write-timeout", session.write_timeout,
              "for a client that takes nothing of what it asked for");
  add_seconds(app, "--shutdown-grace", server.shutdown_grace, "for requests in flight at the end");
}

void add_publishing(CLI::App& app, ServerOptions& options) {
  app.option_defaults()->group(kPublishing);
  PublishLimits& publish = options.publish;
  add_bytes(app, "--max-upload", publish.upload_bytes, "of one mesh file");
  add_bytes(app, "--max-staged", publish.staged_bytes, "of all uploads under way or waiting to be resumed");
  add_seconds(app, "--staged-age", publish.staged_age, "until an upload that nobody resumes is removed");
  add_count(app, "--publish-queue", publish.queue, "uploads that wait while another is ingested");
  add_count(app, "--publish-threads", publish.threads, "that ingest; 0: one for each processor");
}

}  // namespace

void add_options(CLI::App& app, ServerOptions& options) {
  app.config_formatter(std::make_shared<TomlConfig>(app));
  app.set_config("--config", "", "a TOML file of these options, without their dashes; the command line wins")
      ->type_name("FILE");
  app.add_option("--store", options.store, "folder with NAME.selvage packs")->required()->type_name("DIR");
  app.add_option("--listen", options.listen, "address to listen on; port 0 picks a free one")
      ->capture_default_str()
      ->type_name("HOST:PORT");
  app.add_option("--port-file", options.port_file, "write the port to this file once listening")
      ->type_name("FILE");
  app.add_option("--health", options.health, "serve /metrics, /healthz and /readyz by HTTP on this address")
      ->type_name("HOST:PORT");
  add_seconds(app, "--store-poll", options.store_poll,
              "read the folder this often, besides when the kernel tells of a change");
  app.add_option("--threads", options.threads, "network threads; 0: one for each processor")
      ->capture_default_str();
  app.add_option("--congestion-control", options.congestion_control,
                 "of TCP, instead of the system's: with bbr, cancels and pings act sooner on slow links")
      ->type_name("NAME");
  auto* verbose = app.add_flag("--verbose", options.verbose, "log every connection and request");
  app.add_flag("--quiet", options.quiet, "log warnings and errors only")->excludes(verbose);
  const std::map<std::string, LogFormat> formats = {{"text", LogFormat::Text}, {"json", LogFormat::Json}};
  app.add_option("--log-format", options.log_format, "lines on stderr: text, or one JSON object each")
      ->transform(CLI::CheckedTransformer(formats, CLI::ignore_case))
      ->default_str("text")
      ->type_name("text|json");
  add_security(app, options);
  add_limits(app, options);
  add_publishing(app, options);
}

}  // namespace selvage
