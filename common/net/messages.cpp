// SPDX-License-Identifier: MIT
#include "common/net/messages.h"

#include "common/net/text.h"

#include "messages.pb.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace selvage {
namespace {

// ---- single fields
// -------------------------------------------------------------------------------------------

/// Collects what is wrong with a message; the first complaint wins.
class Check {
 public:
  explicit Check(FrameType type) : type_(type) {}

  void that(bool claim, std::string_view field) {
    if (!claim && !failed_) failed_ = std::string(field);
  }

  template <class Message>
  Result<Message> result(Message message) const {
    if (!failed_) return message;
    return fail(ErrorCode::Protocol, "bad " + *failed_ + " in " + std::string(to_string(type_)));
  }

 private:
  FrameType type_;
  std::optional<std::string> failed_;
};

/// Names are compared, printed and looked up: printable UTF-8. What else a name may be, the store decides.
std::string name_from(const std::string& text, std::string_view field, Check& check) {
  check.that(!text.empty() && text.size() <= kMaxNameLength && is_printable_utf8(text), field);
  return text;
}

/// Free text for people is cleaned rather than refused, on its way out and in.
std::string clean(std::string_view text) { return printable_utf8(text, kMaxTextLength); }

Hash hash_from(std::string_view bytes, std::string_view field, Check& check) {
  Hash hash;
  check.that(bytes.size() == Hash::kSize, field);
  if (bytes.size() == Hash::kSize) std::copy_n(bytes.begin(), Hash::kSize, hash.bytes.begin());
  return hash;
}

std::string bytes_of(const Hash& hash) { return {hash.bytes.begin(), hash.bytes.end()}; }

std::vector<Hash> hashes_from(std::string_view bytes, std::string_view field, Check& check) {
  check.that(bytes.size() % Hash::kSize == 0, field);
  std::vector<Hash> hashes;
  hashes.reserve(bytes.size() / Hash::kSize);
  for (; bytes.size() >= Hash::kSize; bytes.remove_prefix(Hash::kSize)) {
    hashes.push_back(hash_from(bytes.substr(0, Hash::kSize), field, check));
  }
  return hashes;
}

std::uint8_t u8_from(std::uint32_t value, std::uint32_t last, std::string_view field, Check& check) {
  check.that(value <= last, field);
  return static_cast<std::uint8_t>(value);
}

Box box_from(const wire::Box& in, Check& check) {
  const Box box{{in.min_x(), in.min_y(), in.min_z()}, {in.max_x(), in.max_y(), in.max_z()}};
  for (double value : {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z}) {
    check.that(std::isfinite(value), "box");
  }
  check.that(box.min.x <= box.max.x && box.min.y <= box.max.y && box.min.z <= box.max.z, "box");
  return box;
}

void put(const Box& box, wire::Box& out) {
  out.set_min_x(box.min.x);
  out.set_min_y(box.min.y);
  out.set_min_z(box.min.z);
  out.set_max_x(box.max.x);
  out.set_max_y(box.max.y);
  out.set_max_z(box.max.z);
}

bool is_known(std::uint32_t code) {
  return code >= static_cast<std::uint32_t>(ErrorCode::InvalidArgument) &&
         code <= static_cast<std::uint32_t>(ErrorCode::Timeout);
}

// ---- struct -> protobuf
// --------------------------------------------------------------------------------------

wire::Hello to_wire(const Hello& message) {
  wire::Hello out;
  out.set_min_version(message.min_version);
  out.set_max_version(message.max_version);
  out.set_software(clean(message.software));
  out.set_initial_credit(message.initial_credit);
  out.set_token(message.token);
  return out;
}

wire::HelloAck to_wire(const HelloAck& message) {
  wire::HelloAck out;
  out.set_version(message.version);
  out.set_software(clean(message.software));
  out.set_max_message_bytes(message.max_message_bytes);
  out.set_max_requests(message.max_requests);
  out.set_max_ids(message.max_ids);
  out.set_idle_timeout_ms(message.idle_timeout_ms);
  return out;
}

wire::ListModels to_wire(const ListModels& message) {
  wire::ListModels out;
  out.set_after(message.after);
  return out;
}

wire::Models to_wire(const Models& message) {
  wire::Models out;
  for (const ModelInfo& model : message.models) {
    wire::ModelInfo& info = *out.add_models();
    info.set_name(model.name);
    info.set_pack_id(bytes_of(model.pack_id));
    info.set_size_bytes(model.size_bytes);
    info.set_regions(model.regions);
    info.set_vertices(model.vertices);
    info.set_triangles(model.triangles);
    info.set_problem(clean(model.problem));
  }
  out.set_more(message.more);
  return out;
}

wire::OpenModel to_wire(const OpenModel& message) {
  wire::OpenModel out;
  out.set_name(message.name);
  out.set_summary_only(message.summary_only);
  if (message.held) out.set_held(bytes_of(*message.held));
  return out;
}

wire::ManifestBegin to_wire(const ManifestBegin& message) {
  wire::ManifestBegin out;
  out.set_pack_id(bytes_of(message.pack_id));
  out.set_summary_size(message.summary_size);
  out.set_directory_size(message.directory_size);
  out.set_data_size(message.data_size);
  return out;
}

void put(const Selection& selection, wire::GetParts& out) {
  switch (selection.kind) {
    case Selection::Kind::All:
      out.set_all(true);
      break;
    case Selection::Kind::Ids:
      out.mutable_ids()->mutable_ids()->Add(selection.ids.begin(), selection.ids.end());
      break;
    case Selection::Kind::Box:
      put(selection.box, *out.mutable_box());
      break;
  }
  out.set_level(selection.level);
  for (const auto& [region, level] : selection.levels) {
    out.mutable_levels()->add_regions(region);
    out.mutable_levels()->add_levels(level);
  }
  out.set_joins(static_cast<std::uint32_t>(selection.joins));
}

wire::GetParts to_wire(const GetParts& message) {
  wire::GetParts out;
  out.set_model(message.model);
  if (message.pack_id) out.set_pack_id(bytes_of(*message.pack_id));
  put(message.selection, out);
  for (const Hash& hash : message.have) out.mutable_have()->append(hash.bytes.begin(), hash.bytes.end());
  for (const PartialPart& part : message.partial) {
    wire::PartialPart& partial = *out.add_partial();
    partial.set_hash(bytes_of(part.hash));
    partial.set_offset(part.offset);
  }
  out.set_urgency(message.urgency);
  out.set_pages(static_cast<std::uint32_t>(message.pages));
  return out;
}

wire::Reprioritise to_wire(const Reprioritise& message) {
  wire::Reprioritise out;
  out.set_urgency(message.urgency);
  return out;
}

wire::PartBegin to_wire(const PartBegin& message) {
  wire::PartBegin out;
  out.set_kind(static_cast<std::uint32_t>(message.id.kind));
  out.set_region(message.id.region);
  out.set_level(message.id.level);
  out.set_size(message.size);
  out.set_offset(message.offset);
  out.set_hash(message.hash.bytes.data(), Hash::kSize);
  return out;
}

wire::RequestEnd to_wire(const RequestEnd& message) {
  wire::RequestEnd out;
  out.set_parts(message.parts);
  out.set_bytes(message.bytes);
  out.set_held(message.held);
  return out;
}

wire::Credit to_wire(const Credit& message) {
  wire::Credit out;
  out.set_bytes(message.bytes);
  return out;
}

wire::Error to_wire(const ErrorMessage& message) {
  wire::Error out;
  out.set_code(static_cast<std::uint32_t>(message.error.code));
  out.set_retryable(message.retryable);
  out.set_message(clean(message.error.to_string()));
  return out;
}

wire::GoAway to_wire(const GoAway& message) {
  wire::GoAway out;
  out.set_reason(clean(message.reason));
  return out;
}

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

template <class T>
std::span<const T> first_of(const std::vector<T>& all) {
  return std::span(all).first(std::min(all.size(), kMaxRepeated));
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

// ---- protobuf -> struct
// --------------------------------------------------------------------------------------

Result<Hello> from_wire(const wire::Hello& in) {
  Check check(FrameType::Hello);
  check.that(in.min_version() <= in.max_version(), "versions");
  check.that(in.initial_credit() >= kMinInitialCredit && in.initial_credit() <= kMaxCredit, "initial_credit");
  check.that(in.token().size() <= kMaxTokenLength, "token");
  return check.result(
      Hello{in.min_version(), in.max_version(), clean(in.software()), in.initial_credit(), in.token()});
}

Result<HelloAck> from_wire(const wire::HelloAck& in) {
  return HelloAck{in.version(),      clean(in.software()), in.max_message_bytes(),
                  in.max_requests(), in.max_ids(),         in.idle_timeout_ms()};
}

Result<ListModels> from_wire(const wire::ListModels& in) {
  Check check(FrameType::ListModels);
  check.that(in.after().size() <= kMaxNameLength, "after");
  return check.result(ListModels{in.after()});
}

ModelInfo info_from(const wire::ModelInfo& in, Check& check) {
  return {name_from(in.name(), "name", check),
          hash_from(in.pack_id(), "pack_id", check),
          in.size_bytes(),
          in.regions(),
          in.vertices(),
          in.triangles(),
          clean(in.problem())};
}

Result<Models> from_wire(const wire::Models& in) {
  Check check(FrameType::Models);
  Models out;
  out.more = in.more();
  out.models.reserve(static_cast<std::size_t>(in.models_size()));
  for (const wire::ModelInfo& info : in.models()) {
    check.that(out.models.empty() || out.models.back().name < info.name(), "order of models");
    out.models.push_back(info_from(info, check));
  }
  check.that(!out.more || !out.models.empty(), "more");
  return check.result(std::move(out));
}

Result<OpenModel> from_wire(const wire::OpenModel& in) {
  Check check(FrameType::OpenModel);
  OpenModel out{name_from(in.name(), "name", check), in.summary_only()};
  if (!in.held().empty()) out.held = hash_from(in.held(), "held", check);
  return check.result(std::move(out));
}

Result<ManifestBegin> from_wire(const wire::ManifestBegin& in) {
  Check check(FrameType::ManifestBegin);
  const ManifestBegin out{hash_from(in.pack_id(), "pack_id", check), in.summary_size(), in.directory_size(),
                          in.data_size()};
  check.that(out.directory_size > 0 && out.summary_size <= out.directory_size, "sizes");
  check.that(out.data_size == 0 || out.data_size == out.summary_size || out.data_size == out.directory_size,
             "data_size");
  return check.result(out);
}

Selection selection_from(const wire::GetParts& in, Check& check) {
  Selection out;
  switch (in.what_case()) {
    case wire::GetParts::kAll:
      out.kind = Selection::Kind::All;
      break;
    case wire::GetParts::kIds:
      out.kind = Selection::Kind::Ids;
      out.ids.assign(in.ids().ids().begin(), in.ids().ids().end());
      break;
    case wire::GetParts::kBox:
      out.kind = Selection::Kind::Box;
      out.box = box_from(in.box(), check);
      break;
    case wire::GetParts::WHAT_NOT_SET:
      check.that(false, "selection");
      break;
  }
  out.level = u8_from(in.level(), 255, "level", check);
  const wire::RegionLevels& levels = in.levels();
  check.that(levels.regions_size() == levels.levels_size(), "levels");
  for (int i = 0; i < std::min(levels.regions_size(), levels.levels_size()); ++i)
    out.levels.push_back({levels.regions(i), u8_from(levels.levels(i), 255, "levels", check)});
  out.joins = static_cast<Joins>(u8_from(in.joins(), static_cast<std::uint32_t>(Joins::All), "joins", check));
  return out;
}

Result<GetParts> from_wire(const wire::GetParts& in) {
  Check check(FrameType::GetParts);
  GetParts out;
  out.model = name_from(in.model(), "model", check);
  if (!in.pack_id().empty()) out.pack_id = hash_from(in.pack_id(), "pack_id", check);
  out.selection = selection_from(in, check);
  out.have = hashes_from(in.have(), "have", check);
  out.partial.reserve(static_cast<std::size_t>(in.partial_size()));
  for (const wire::PartialPart& part : in.partial()) {
    out.partial.push_back({hash_from(part.hash(), "partial", check), part.offset()});
  }
  out.urgency = u8_from(in.urgency(), kMaxUrgency, "urgency", check);
  out.pages = static_cast<Pages>(u8_from(in.pages(), static_cast<std::uint32_t>(Pages::All), "pages", check));
  return check.result(std::move(out));
}

Result<Reprioritise> from_wire(const wire::Reprioritise& in) {
  Check check(FrameType::Reprioritise);
  const Reprioritise out{u8_from(in.urgency(), kMaxUrgency, "urgency", check)};
  return check.result(out);
}

Result<PartBegin> from_wire(const wire::PartBegin& in) {
  Check check(FrameType::PartBegin);
  PartBegin out;
  out.id.kind =
      static_cast<PartKind>(u8_from(in.kind(), static_cast<std::uint32_t>(PartKind::Page), "kind", check));
  out.id.region = in.region();
  out.id.level = u8_from(in.level(), 255, "level", check);
  out.size = in.size();
  out.offset = in.offset();
  out.hash = hash_from(in.hash(), "hash", check);
  check.that(out.offset < out.size, "size");
  return check.result(out);
}

Result<RequestEnd> from_wire(const wire::RequestEnd& in) {
  return RequestEnd{in.parts(), in.bytes(), in.held()};
}

Result<Credit> from_wire(const wire::Credit& in) {
  Check check(FrameType::Credit);
  check.that(in.bytes() > 0, "bytes");
  return check.result(Credit{in.bytes()});
}

/// A code that this build does not know comes from a newer peer: it stays an error of that request alone.
Result<ErrorMessage> from_wire(const wire::Error& in) {
  ErrorMessage out;
  out.error.code = is_known(in.code()) ? static_cast<ErrorCode>(in.code()) : ErrorCode::Unsupported;
  out.error.message = clean(in.message());
  out.retryable = in.retryable();
  return out;
}

Result<GoAway> from_wire(const wire::GoAway& in) { return GoAway{clean(in.reason())}; }

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

std::string stage_from(const std::string& text) { return printable_utf8(text, kMaxStageLength); }

std::uint32_t permille_from(std::uint32_t value, Check& check) {
  check.that(value <= 1000, "permille");
  return value;
}

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

template <class Message>
constexpr bool kIsEmpty = std::is_empty_v<Message>;

}  // namespace

template <class Message>
Result<Message> parse(std::span<const std::byte> payload) {
  const std::string name(to_string(Message::kType));
  if constexpr (kIsEmpty<Message>) {
    if (!payload.empty()) return fail(ErrorCode::Protocol, name + " carries no payload");
    return Message{};
  } else {
    decltype(to_wire(std::declval<const Message&>())) in;
    if (payload.size() > kMaxPayload ||
        !in.ParseFromArray(payload.data(), static_cast<int>(payload.size()))) {
      return fail(ErrorCode::Protocol, "malformed " + name);
    }
    return from_wire(in);
  }
}

template <class Message>
void append_frame(std::vector<std::byte>& out, const Message& message, std::uint32_t request_id,
                  std::uint32_t seq) {
  const std::size_t start = out.size();
  FrameHeader header{0, Message::kType, 0, request_id, seq};
  if constexpr (kIsEmpty<Message>) {
    out.resize(start + kFrameHeaderSize);
  } else {
    const auto wire = to_wire(message);
    header.length = static_cast<std::uint32_t>(wire.ByteSizeLong());
    assert(header.length <= kMaxPayload);
    out.resize(start + kFrameHeaderSize + header.length);
    wire.SerializeWithCachedSizesToArray(reinterpret_cast<std::uint8_t*>(&out[start]) + kFrameHeaderSize);
  }
  write_header(header, HeaderBytes(&out[start], kFrameHeaderSize));
}

// Every message of the header, both ways.
#define SELVAGE_MESSAGE(Message)                                       \
  template Result<Message> parse<Message>(std::span<const std::byte>); \
  template void append_frame<Message>(std::vector<std::byte>&, const Message&, std::uint32_t, std::uint32_t);
SELVAGE_MESSAGE(Hello)
SELVAGE_MESSAGE(HelloAck)
SELVAGE_MESSAGE(ListModels)
SELVAGE_MESSAGE(Models)
SELVAGE_MESSAGE(OpenModel)
SELVAGE_MESSAGE(ManifestBegin)
SELVAGE_MESSAGE(GetParts)
SELVAGE_MESSAGE(Reprioritise)
SELVAGE_MESSAGE(PartBegin)
SELVAGE_MESSAGE(RequestEnd)
SELVAGE_MESSAGE(Credit)
SELVAGE_MESSAGE(ErrorMessage)
SELVAGE_MESSAGE(GoAway)
SELVAGE_MESSAGE(Cancel)
SELVAGE_MESSAGE(Ping)
SELVAGE_MESSAGE(Pong)
SELVAGE_MESSAGE(Publish)
SELVAGE_MESSAGE(PublishReady)
SELVAGE_MESSAGE(PublishProgress)
SELVAGE_MESSAGE(Published)
SELVAGE_MESSAGE(Unpublish)
SELVAGE_MESSAGE(Status)
SELVAGE_MESSAGE(StatusReport)
#undef SELVAGE_MESSAGE

bool is_retryable(ErrorCode code) {
  return code == ErrorCode::Unavailable || code == ErrorCode::Timeout || code == ErrorCode::LimitExceeded;
}

}  // namespace selvage
