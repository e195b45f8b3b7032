// SPDX-License-Identifier: MIT
#include "server/operate/metrics.h"

#include <chrono>
#include <sstream>

#include <prometheus/text_serializer.h>

namespace selvage {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;

class Families {
 public:
  MetricFamily& add(MetricType type, const char* name, const char* help) {
    return all_.emplace_back(MetricFamily{name, help, type, {}});
  }
  void gauge(const char* name, const char* help, double value) {
    put(add(MetricType::Gauge, name, help), value, {});
  }
  void counter(const char* name, const char* help, std::uint64_t value) {
    put(add(MetricType::Counter, name, help), static_cast<double>(value), {});
  }
  static void put(MetricFamily& family, double value, std::vector<ClientMetric::Label> labels) {
    ClientMetric metric;
    metric.label = std::move(labels);
    metric.counter.value = metric.gauge.value = value;
    family.metric.push_back(std::move(metric));
  }
  const std::vector<MetricFamily>& all() const { return all_; }

 private:
  std::vector<MetricFamily> all_;
};

void add_traffic(Families& families, const ServerCounters& counters) {
  families.gauge("selvage_connections", "Connections at the moment", static_cast<double>(counters.sessions));
  families.counter("selvage_connections_total", "Connections accepted", counters.connections);
  families.counter("selvage_connections_refused_total", "Connections over a limit",
                   counters.connections_refused);
  MetricFamily& requests = families.add(MetricType::Counter, "selvage_requests_total", "Requests by kind");
  const std::pair<const char*, std::uint64_t> kinds[] = {
      {"list", counters.lists},      {"open", counters.opens},        {"get", counters.gets},
      {"status", counters.statuses}, {"publish", counters.publishes}, {"unpublish", counters.unpublishes}};
  for (const auto& [kind, count] : kinds)
    Families::put(requests, static_cast<double>(count), {{"kind", kind}});
  MetricFamily& errors = families.add(MetricType::Counter, "selvage_errors_total", "Errors sent, by code");
  for (std::size_t code = 1; code < counters.errors.size(); ++code) {
    if (code > static_cast<std::size_t>(ErrorCode::Timeout)) break;
    const std::string name(to_string(static_cast<ErrorCode>(code)));
    Families::put(errors, static_cast<double>(counters.errors[code]), {{"code", name}});
  }
  families.counter("selvage_sent_bytes_total", "Bytes of frames sent, before encryption",
                   counters.bytes_sent);
}

void add_models(Families& families, const SessionServices& services) {
  const PackStore::Summary summary = services.store.summary();
  families.gauge("selvage_models", "Packs in the store, damaged ones included", summary.models);
  families.gauge("selvage_models_damaged", "Packs that are refused",
                 static_cast<double>(summary.refused.size()));
  families.gauge("selvage_model_bytes", "Size of all packs", static_cast<double>(summary.bytes));
}

void add_publishing(Families& families, const SessionServices& services) {
  const ServerCounters& counters = services.counters;
  families.counter("selvage_uploaded_bytes_total", "Bytes of meshes received", counters.bytes_uploaded);
  families.counter("selvage_published_total", "Meshes that became models", counters.published);
  families.counter("selvage_publish_failed_total", "Meshes that did not", counters.publish_failed);
  const std::size_t jobs = services.publishing == nullptr ? 0 : services.publishing->jobs().size();
  families.gauge("selvage_publish_jobs", "Uploads being ingested or waiting for it",
                 static_cast<double>(jobs));
}

}  // namespace

std::string metrics_text(const SessionServices& services) {
  Families families;
  MetricFamily& build = families.add(MetricType::Gauge, "selvage_build_info", "Always 1");
  Families::put(build, 1, {{"version", SELVAGE_VERSION}});
  const std::chrono::duration<double> started = services.counters.started.time_since_epoch();
  families.gauge("selvage_start_time_seconds", "When the server started, in seconds of Unix time",
                 started.count());
  add_traffic(families, services.counters);
  add_models(families, services);
  add_publishing(families, services);
  std::ostringstream text;
  prometheus::TextSerializer().Serialize(text, families.all());
  return text.str();
}

}  // namespace selvage
