// SPDX-License-Identifier: MIT
//
// Charts as inline SVG: any browser shows them, and nothing is fetched.
#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "client/app/load_output.h"

namespace selvage {
namespace {

constexpr double kWidth = 860, kHeight = 220, kLeft = 70, kTop = 28, kBottom = 30;

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// A number of 1, 2 or 5 times a power of ten that is not below `value`.
double round_up(double value) {
  if (value <= 0) return 1;
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (value <= step * power) return step * power;
  }
  return 10 * power;
}

std::string text_at(double x, double y, const std::string& text, const char* anchor) {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}'>{}</text>\n", x, y, anchor, escaped(text));
}

using Value = std::function<double(const LoadSample&)>;

std::string time_chart(const LoadReport& report, const std::string& title, const Value& value) {
  double most = 0, end = 1;
  for (const LoadSample& sample : report.samples) {
    most = std::max(most, value(sample));
    end = std::max(end, sample.seconds);
  }
  const double top = round_up(most), plot = kWidth - kLeft - 20, depth = kHeight - kTop - kBottom;
  std::string svg = fmt::format("<svg width='{}' height='{}'>\n", kWidth, kHeight);
  svg += text_at(kLeft, 16, title, "start");
  for (int i = 0; i <= 4; ++i) {
    const double y = kTop + depth * (1 - i / 4.0);
    svg += fmt::format("<line x1='{}' x2='{}' y1='{:.1f}' y2='{:.1f}'/>\n", kLeft, kLeft + plot, y, y);
    svg += text_at(kLeft - 6, y + 4, fmt::format("{:g}", top * i / 4), "end");
  }
  svg += text_at(kLeft, kHeight - 10, "0 s", "middle") +
         text_at(kLeft + plot, kHeight - 10, fmt::format("{:.1f} s", end), "middle");
  std::string points;
  for (const LoadSample& sample : report.samples)
    points += fmt::format("{:.1f},{:.1f} ", kLeft + plot * sample.seconds / end,
                          kTop + depth * (1 - value(sample) / top));
  return svg + fmt::format("<polyline points='{}'/>\n</svg>\n", points);
}

/// Percentiles to the nines, as is usual: 0, 90, 99, 99.9 % at equal distances.
std::string percentile_chart(const std::string& title, const LatencyHistogram& latency) {
  const double nines =
      std::min(4.0, std::log10(static_cast<double>(std::max<std::uint64_t>(latency.count(), 10))));
  const auto at = [&](double x) {
    return static_cast<double>(latency.percentile(1 - std::pow(10, -x)).count()) / 1e6;
  };
  const double top = round_up(at(nines)), plot = kWidth - kLeft - 20, depth = kHeight - kTop - kBottom;
  std::string svg = fmt::format("<svg width='{}' height='{}'>\n", kWidth, kHeight);
  svg += text_at(kLeft, 16, title + ": latency in ms by percentile", "start");
  for (int i = 0; i <= 4; ++i) {
    const double y = kTop + depth * (1 - i / 4.0);
    svg += fmt::format("<line x1='{}' x2='{}' y1='{:.1f}' y2='{:.1f}'/>\n", kLeft, kLeft + plot, y, y);
    svg += text_at(kLeft - 6, y + 4, fmt::format("{:g}", top * i / 4), "end");
  }
  for (int i = 0; i <= static_cast<int>(nines); ++i)
    svg += text_at(kLeft + plot * i / nines, kHeight - 10,
                   fmt::format("{:g} %", 100 * (1 - std::pow(10, -i))), "middle");
  std::string points;
  for (int i = 0; i <= 200; ++i)
    points +=
        fmt::format("{:.1f},{:.1f} ", kLeft + plot * i / 200, kTop + depth * (1 - at(nines * i / 200) / top));
  return svg + fmt::format("<polyline points='{}'/>\n</svg>\n", points);
}

}  // namespace

std::string load_chart(const LoadReport& report, const std::string& title) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'><title>{0}</title>\n<style>body {{ font: "
      "13px "
      "sans-serif; margin: 24px }} svg {{ display: block; margin: 18px 0 }} svg line {{ stroke: #ddd }} svg "
      "text {{ "
      "fill: #333 }} polyline {{ fill: none; stroke: #1667b7; stroke-width: 1.5 }}</style></head><body>\n"
      "<h1>{0}</h1>\n<pre>{1}</pre>\n",
      escaped(title), escaped(load_text(report, {})));
  html += time_chart(report, "requests a second", [](const LoadSample& s) { return s.requests_per_second; });
  html += time_chart(report, "received, MB a second",
                     [](const LoadSample& s) { return s.bytes_per_second / 1e6; });
  html += time_chart(report, "mean latency, ms", [](const LoadSample& s) { return s.mean_latency_ms; });
  html += time_chart(report, "clients connected", [](const LoadSample& s) { return double(s.clients); });
  for (const auto& [name, kind] : report.kinds) {
    for (const auto& [label, latency] : kind.latency) html += percentile_chart(name + ", " + label, latency);
  }
  return html + "</body></html>\n";
}

}  // namespace selvage
