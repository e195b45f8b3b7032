// SPDX-License-Identifier: MIT
#include "common/net/messages.h"

#include "common/net/message_fields.h"
#include "common/net/publish_messages.h"
#include "common/net/text.h"

#include "messages.pb.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace selvage {
namespace {

using namespace message_fields;

bool is_known(std::uint32_t code) {
  return code >= static_cast<std::uint32_t>(ErrorCode::InvalidArgument) &&
         code <= static_cast<std::uint32_t>(ErrorCode::Timeout);
}

// ---- struct -> protobuf

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
      message_fields::put(selection.box, *out.mutable_box());
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

// ---- protobuf -> struct

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
