// SPDX-License-Identifier: MIT
#include "common/net/publish_messages.h"

#include <span>
#include <utility>

#include "common/net/message_fields.h"
#include "common/net/text.h"

#include "messages.pb.h"

namespace selvage {
namespace {

using namespace message_fields;

wire::PublishCut to_wire(const PublishCut& cut) {
  wire::PublishCut out;
  out.set_by(static_cast<std::uint32_t>(cut.by));
  out.set_mode(static_cast<std::uint32_t>(cut.mode));
  out.set_regions(cut.regions);
  out.set_min_region(cut.min_region);
  out.set_max_region(cut.max_region);
  out.set_smooth(cut.smooth);
  out.set_levels(cut.levels);
  for (const double ratio : cut.level_ratios) out.add_level_ratios(ratio);
  for (const double error : cut.level_errors) out.add_level_errors(error);
  return out;
}

template <class T>
std::span<const T> first_of(const std::vector<T>& all) {
  return std::span(all).first(std::min(all.size(), kMaxRepeated));
}

bool is_file_name(const std::string& text) {
  return text != "." && text != ".." && text.find_first_of(std::string_view("/\\\0", 3)) == std::string::npos;
}

PublishCut cut_from(const wire::PublishCut& in, Check& check) {
  PublishCut out;
  check.that(in.by() <= PublishCut::kLastBy, "by");
  check.that(in.mode() <= PublishCut::kLastMode, "mode");
  out.by = static_cast<PublishCut::By>(in.by());
  out.mode = static_cast<PublishCut::Mode>(in.mode());
  out.regions = in.regions();
  out.min_region = in.min_region();
  out.max_region = in.max_region();
  out.smooth = in.smooth();
  out.levels = in.levels();
  check.that(out.levels > 0 && out.levels <= kMaxLevels, "levels");
  const auto list_from = [&](const auto& values, std::string_view field) {
    check.that(static_cast<std::uint32_t>(values.size()) < kMaxLevels, field);
    for (const double value : values) check.that(std::isfinite(value) && value >= 0, field);
    return std::vector<double>(values.begin(), values.end());
  };
  out.level_ratios = list_from(in.level_ratios(), "level_ratios");
  out.level_errors = list_from(in.level_errors(), "level_errors");
  check.that(out.level_ratios.empty() || out.level_errors.empty(), "levels");
  return out;
}

std::string stage_from(const std::string& text) { return printable_utf8(text, kMaxStageLength); }

std::uint32_t permille_from(std::uint32_t value, Check& check) {
  check.that(value <= 1000, "permille");
  return value;
}

}  // namespace

wire::Publish to_wire(const Publish& message) {
  wire::Publish out;
  out.set_name(message.name);
  out.set_file(message.file);
  out.set_size_bytes(message.size_bytes);
  out.set_hash(bytes_of(message.hash));
  out.set_replace(message.replace);
  out.set_lossless(message.lossless);
  out.set_bits(message.bits);
  out.set_units(clean(message.units));
  *out.mutable_cut() = to_wire(message.cut);
  return out;
}

wire::PublishReady to_wire(const PublishReady& message) {
  wire::PublishReady out;
  out.set_offset(message.offset);
  return out;
}

wire::PublishProgress to_wire(const PublishProgress& message) {
  wire::PublishProgress out;
  out.set_stage(message.stage);
  out.set_permille(message.permille);
  out.set_ahead(message.ahead);
  return out;
}

wire::Published to_wire(const Published& message) {
  wire::Published out;
  out.set_name(message.name);
  out.set_pack_id(bytes_of(message.pack_id));
  out.set_size_bytes(message.size_bytes);
  out.set_regions(message.regions);
  out.set_vertices(message.vertices);
  out.set_triangles(message.triangles);
  for (const std::string& note : first_of(message.notes)) out.add_notes(clean(note));
  return out;
}

wire::Unpublish to_wire(const Unpublish& message) {
  wire::Unpublish out;
  out.set_name(message.name);
  return out;
}

wire::StatusReport to_wire(const StatusReport& message) {
  wire::StatusReport out;
  out.set_software(clean(message.software));
  out.set_uptime_seconds(message.uptime_seconds);
  out.set_draining(message.draining);
  out.set_encrypted(message.is_encrypted);
  out.set_models(message.models);
  out.set_model_bytes(message.model_bytes);
  for (const ModelProblem& problem : first_of(message.problems)) {
    wire::ModelProblem& put_problem = *out.add_problems();
    put_problem.set_name(problem.name);
    put_problem.set_problem(clean(problem.problem));
  }
  out.set_connections(message.connections);
  out.set_max_connections(message.max_connections);
  out.set_connections_accepted(message.connections_accepted);
  out.set_connections_refused(message.connections_refused);
  out.set_requests(message.requests);
  out.set_errors(message.errors);
  out.set_bytes_sent(message.bytes_sent);
  out.set_bytes_uploaded(message.bytes_uploaded);
  out.set_published(message.published);
  out.set_publish_failed(message.publish_failed);
  for (const PublishJob& job : first_of(message.jobs)) {
    wire::PublishJob& put_job = *out.add_jobs();
    put_job.set_name(job.name);
    put_job.set_stage(job.stage);
    put_job.set_permille(job.permille);
  }
  return out;
}

Result<Publish> from_wire(const wire::Publish& in) {
  Check check(FrameType::Publish);
  Publish out;
  out.name = name_from(in.name(), "name", check);
  out.file = name_from(in.file(), "file", check);
  check.that(is_file_name(out.file), "file");
  out.size_bytes = in.size_bytes();
  check.that(out.size_bytes > 0, "size_bytes");
  out.hash = hash_from(in.hash(), "hash", check);
  out.replace = in.replace();
  out.lossless = in.lossless();
  out.bits = u8_from(in.bits(), 255, "bits", check);
  out.units = in.units();
  check.that(out.units.size() <= kMaxNameLength && is_printable_utf8(out.units), "units");
  if (in.has_cut()) out.cut = cut_from(in.cut(), check);
  return check.result(std::move(out));
}

Result<PublishReady> from_wire(const wire::PublishReady& in) { return PublishReady{in.offset()}; }

Result<PublishProgress> from_wire(const wire::PublishProgress& in) {
  Check check(FrameType::PublishProgress);
  PublishProgress out{stage_from(in.stage()), permille_from(in.permille(), check), in.ahead()};
  return check.result(std::move(out));
}

Result<Published> from_wire(const wire::Published& in) {
  Check check(FrameType::Published);
  Published out;
  out.name = name_from(in.name(), "name", check);
  out.pack_id = hash_from(in.pack_id(), "pack_id", check);
  out.size_bytes = in.size_bytes();
  out.regions = in.regions();
  out.vertices = in.vertices();
  out.triangles = in.triangles();
  check.that(static_cast<std::size_t>(in.notes_size()) <= kMaxRepeated, "notes");
  for (const std::string& note : in.notes()) out.notes.push_back(clean(note));
  return check.result(std::move(out));
}

Result<Unpublish> from_wire(const wire::Unpublish& in) {
  Check check(FrameType::Unpublish);
  Unpublish out{name_from(in.name(), "name", check)};
  return check.result(std::move(out));
}

Result<StatusReport> from_wire(const wire::StatusReport& in) {
  Check check(FrameType::StatusReport);
  StatusReport out;
  out.software = clean(in.software());
  out.uptime_seconds = in.uptime_seconds();
  out.draining = in.draining();
  out.is_encrypted = in.encrypted();
  out.models = in.models();
  out.model_bytes = in.model_bytes();
  check.that(static_cast<std::size_t>(in.problems_size()) <= kMaxRepeated, "problems");
  for (const wire::ModelProblem& problem : in.problems()) {
    out.problems.push_back({name_from(problem.name(), "problems", check), clean(problem.problem())});
  }
  out.connections = in.connections();
  out.max_connections = in.max_connections();
  out.connections_accepted = in.connections_accepted();
  out.connections_refused = in.connections_refused();
  out.requests = in.requests();
  out.errors = in.errors();
  out.bytes_sent = in.bytes_sent();
  out.bytes_uploaded = in.bytes_uploaded();
  out.published = in.published();
  out.publish_failed = in.publish_failed();
  check.that(static_cast<std::size_t>(in.jobs_size()) <= kMaxRepeated, "jobs");
  for (const wire::PublishJob& job : in.jobs()) {
    out.jobs.push_back({name_from(job.name(), "jobs", check), stage_from(job.stage()),
                        permille_from(job.permille(), check)});
  }
  return check.result(std::move(out));
}

}  // namespace selvage
