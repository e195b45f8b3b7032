// SPDX-License-Identifier: MIT
//
// One good message of every kind, with no field left at its default.
#pragma once

#include "common/net/messages.h"

namespace selvage {

template <class Message>
Message sample() {
  return {};  // those without fields
}

inline Hash sample_hash(std::uint8_t seed) {
  Hash hash;
  for (std::size_t i = 0; i < Hash::kSize; ++i) hash.bytes[i] = static_cast<std::uint8_t>(seed + i);
  return hash;
}

template <>
inline Hello sample() {
  return {1, 3, "some client 1.0", 1 << 20, "token"};
}
template <>
inline HelloAck sample() {
  return {1, "some server 1.0", 1 << 19, 32, 65'536, 120'000};
}
template <>
inline ListModels sample() {
  return {"armadillo"};
}
template <>
inline Models sample() {
  return {{{"bunny", sample_hash(1), 123'456, 40, 34'834, 69'451, ""}, {"häuschen", {}, 12, 0, 0, 0, "torn"}},
          true};
}
template <>
inline OpenModel sample() {
  return {"bunny", true, sample_hash(8)};
}
template <>
inline ManifestBegin sample() {
  return {sample_hash(2), 400, 12'345, 400};
}
template <>
inline GetParts sample() {
  GetParts get;
  get.model = "bunny";
  get.pack_id = sample_hash(3);
  get.selection = {.kind = Selection::Kind::Ids,
                   .ids = {3, 5, 70'000},
                   .joins = Joins::All,
                   .level = 2,
                   .levels = {{5, 0}, {3, 255}}};
  get.have = {sample_hash(4), sample_hash(5)};
  get.partial = {{sample_hash(6), 4096}};
  get.urgency = 1;
  get.pages = Pages::All;
  return get;
}
template <>
inline Reprioritise sample() {
  return {6};
}
template <>
inline PartBegin sample() {
  return {{PartKind::Bundle, 17, 0}, 5000, 4096, sample_hash(7)};
}
template <>
inline RequestEnd sample() {
  return {12, std::uint64_t{5} << 32, 3};
}
template <>
inline Credit sample() {
  return {65'536};
}
template <>
inline ErrorMessage sample() {
  return {Error{ErrorCode::NotFound, "no model named 'bunny'"}, true};
}
template <>
inline GoAway sample() {
  return {"shutting down"};
}

template <>
inline Publish sample() {
  PublishCut cut;
  cut.by = PublishCut::By::Components;
  cut.mode = PublishCut::Mode::Cad;
  cut.regions = 7;
  cut.min_region = 100;
  cut.max_region = 5000;
  cut.smooth = true;
  cut.levels = 3;
  cut.level_ratios = {0.25, 0.0625};
  return {"bunny", "bunny.ply", 123'456, sample_hash(8), true, true, 12, "mm", cut};
}
template <>
inline PublishReady sample() {
  return {std::uint64_t{5} << 32};
}
template <>
inline PublishProgress sample() {
  return {"encode", 500, 2};
}
template <>
inline Published sample() {
  return {"bunny", sample_hash(9), 123'456, 40, 34'834, 69'451, {"3 triangles dropped", "2 kept"}};
}
template <>
inline Unpublish sample() {
  return {"bunny"};
}
template <>
inline StatusReport sample() {
  StatusReport report;
  report.software = "some server 1.0";
  report.uptime_seconds = 3600;
  report.draining = report.is_encrypted = true;
  report.models = 3;
  report.model_bytes = std::uint64_t{5} << 32;
  report.problems = {{"torn", "the pack is damaged"}};
  report.connections = 4;
  report.max_connections = 4096;
  report.connections_accepted = 100;
  report.connections_refused = 5;
  report.requests = 1000;
  report.errors = 6;
  report.bytes_sent = std::uint64_t{6} << 32;
  report.bytes_uploaded = 7;
  report.published = 8;
  report.publish_failed = 9;
  report.jobs = {{"lucy", "segment", 250}};
  return report;
}

}  // namespace selvage
