// SPDX-License-Identifier: MIT
#include "client/load/load_report.h"

namespace selvage {

std::uint64_t KindReport::error_count() const {
  std::uint64_t count = 0;
  for (const auto& [kind, times] : errors) count += times;
  return count;
}

void KindReport::merge(const KindReport& other) {
  for (const auto& [label, histogram] : other.latency) latency[label].merge(histogram);
  first_region.merge(other.first_region);
  for (const auto& [kind, times] : other.errors) errors[kind] += times;
  requests += other.requests;
  parts += other.parts;
  useful_bytes += other.useful_bytes;
  received_bytes += other.received_bytes;
  cancelled += other.cancelled;
  dropped += other.dropped;
  verified += other.verified;
  late_rounds += other.late_rounds;
}

KindReport LoadReport::total() const {
  KindReport all;
  for (const auto& [name, kind] : kinds) all.merge(kind);
  return all;
}

}  // namespace selvage
