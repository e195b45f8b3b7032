// SPDX-License-Identifier: MIT
//
// What the client makes of a whole answer. The input is a play for a hostile server, so that it gets past
// sizes and hashes that no fuzzer guesses: the first byte chooses the request, then every two bytes are a
// move,
//
//     'b' n      the true first frame: of the manifest, or of the nth part (or page) asked for
//     'd' n      the next n + 1 true bytes, as Data; 'D' the same times 256
//     'e' 0      the true last frame
//     'x' n      from now on, the nth byte of every payload is wrong; 'X' 0: none is
//     't' n      a frame of type n, whose payload is what is left of the input
//
// The reader must never deliver a part that is not in the directory, twice, or with other bytes.
#include <algorithm>
#include <cstdlib>
#include <set>
#include <span>

#include "client/session/answer_reader.h"
#include "tests/support/fake_pack.h"

namespace {

using namespace selvage;
using Payload = std::vector<std::byte>;

void require(bool claim) {
  if (!claim) std::abort();
}

const std::shared_ptr<const Pack>& pack() {
  static const auto made = Pack::from_bytes(fake_pack_bytes(3, 700)).value();
  return made;
}

GetRequest request(std::uint8_t choice) {
  static const auto manifest =
      std::make_shared<const Manifest>(Manifest{"row", pack()->id(), pack()->directory(), 0});
  GetRequest made{manifest, {.kind = Selection::Kind::Ids, .ids = {1, 2}}};
  if (choice & 2) made.have.push_back(pack()->directory().regions[1].levels[0].part.hash);
  if (choice & 4) {
    const PartRef& ref = pack()->directory().regions[2].levels[0].part;
    const auto front = pack()->part(ref).first(300);
    made.unfinished = std::make_shared<UnfinishedParts>();
    made.unfinished->emplace(ref.hash, Payload(front.begin(), front.end()));
  }
  return made;
}

/// The honest server's side of the play, and its lies.
class Play {
 public:
  Play(bool is_manifest, bool summary_only, const GetRequest& asked)
      : is_manifest_(is_manifest), summary_only_(summary_only), asked_(asked) {
    parts_ = select_parts(asked.manifest->directory, asked.selection).value();
    if (summary_only) parts_ = with_pages(asked.manifest->directory, std::move(parts_), Pages::Needed);
  }

  /// False when the reader has had enough.
  bool move(AnswerReader& reader, char kind, std::uint8_t n, std::span<const std::byte> rest) {
    switch (kind) {
      case 'b':
        return begin(reader, n);
      case 'd':
        return data(reader, n + std::size_t{1});
      case 'D':
        return data(reader, 256 * (n + std::size_t{1}));
      case 'e': {
        RequestEnd end{};
        end.parts = begun_;
        end.bytes = sent_;
        return message(reader, end);
      }
      case 'x':
        wrong_ = n;
        return true;
      case 'X':
        wrong_ = ~std::size_t{0};
        return true;
      case 't':
        return send(reader, static_cast<FrameType>(n % (kLastFrameType + 1)), 0, {rest.begin(), rest.end()});
      default:
        return false;
    }
  }

 private:
  bool begin(AnswerReader& reader, std::uint8_t n) {
    if (is_manifest_) {
      left_ = pack()->directory_bytes();
      ManifestBegin made{pack()->id(), pack()->header().summary_size, left_.size(), left_.size()};
      if (summary_only_) left_ = left_.first(made.data_size = made.summary_size);
      return message(reader, made);
    }
    const PartId id = parts_[n % parts_.size()];
    const PartRef& ref = *pack()->directory().find(id);
    left_ = pack()->part(ref);
    PartBegin made{id, ref.size, 0, ref.hash};
    if (asked_.unfinished && n >= 128) {
      made.offset = 300;
      left_ = left_.subspan(std::min<std::size_t>(300, left_.size()));
    }
    ++begun_;
    return message(reader, made);
  }

  bool data(AnswerReader& reader, std::size_t count) {
    const auto now = left_.first(std::min(count, left_.size()));
    left_ = left_.subspan(now.size());
    sent_ += now.size();
    return send(reader, FrameType::Data, left_.empty() ? kFlagEnd : std::uint8_t{0},
                {now.begin(), now.end()});
  }

  template <class Message>
  bool message(AnswerReader& reader, const Message& made) {
    const Payload frame = to_frame(made, 1);
    return send(reader, Message::kType, 0, {frame.begin() + kFrameHeaderSize, frame.end()});
  }

  bool send(AnswerReader& reader, FrameType type, std::uint8_t flags, Payload payload) {
    if (wrong_ < payload.size()) payload[wrong_] ^= std::byte{0x41};
    const FrameHeader header{static_cast<std::uint32_t>(payload.size()), type, flags, 1, 0};
    const auto complete = reader.on_frame({header, payload});
    return complete && !*complete;
  }

  const bool is_manifest_, summary_only_;
  const GetRequest& asked_;
  std::vector<PartId> parts_;
  std::span<const std::byte> left_;
  std::uint32_t begun_ = 0;
  std::uint64_t sent_ = 0;
  std::size_t wrong_ = ~std::size_t{0};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::uint8_t choice = data[0];
  GetRequest asked = request(choice);
  const bool is_first = (choice & 16) != 0;
  if (is_first) asked.have.clear(), asked.unfinished.reset();
  std::set<PartId> delivered;
  const auto on_part = [&](const PartId& id, std::vector<std::byte> bytes) {
    const PartRef* ref = asked.manifest->directory.find(id);
    require(ref != nullptr && check_part(*ref, bytes).has_value());
    require(delivered.insert(id).second);
  };
  const auto summary_of = [](std::span<const std::byte> directory) {
    return parse_summary(directory.first(pack()->header().summary_size), directory.size()).value();
  };
  auto parts = is_first ? PartsReader(FirstRequest{asked.selection}, on_part)
                        : std::move(PartsReader::for_request(asked, on_part).value());
  if (is_first && (choice & 32) == 0) parts.begin(summary_of(pack()->directory_bytes()));
  ManifestReader manifest({.name = "row", .summary_only = is_first}, 4096,
                          [](const Manifest& opened) -> Result<void> {
                            require(opened.pack_id == pack()->id());
                            return {};
                          });
  ModelsReader models;
  const bool is_manifest = (choice & 1) != 0;
  AnswerReader& reader = choice & 8    ? static_cast<AnswerReader&>(models)
                         : is_manifest ? static_cast<AnswerReader&>(manifest)
                                       : parts;
  Play play(is_manifest, is_first, asked);
  const auto bytes = std::as_bytes(std::span(data, size));
  for (std::size_t at = 1; at + 1 < size; at += 2) {
    if (!play.move(reader, static_cast<char>(data[at]), data[at + 1], bytes.subspan(at + 2))) break;
  }
  parts.leave_unfinished();
  return 0;
}
