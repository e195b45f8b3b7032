// SPDX-License-Identifier: MIT
//
// What the fields of messages have in common: checked on their way in, cleaned on both ways. For the sources
// of the messages only.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/base/hash.h"
#include "common/net/messages.h"

namespace selvage::wire {
class Box;
}

namespace selvage::message_fields {

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
std::string name_from(const std::string& text, std::string_view field, Check& check);

/// Free text for people is cleaned rather than refused, on its way out and in.
std::string clean(std::string_view text);

Hash hash_from(std::string_view bytes, std::string_view field, Check& check);
std::string bytes_of(const Hash& hash);
/// Written one behind the other.
std::vector<Hash> hashes_from(std::string_view bytes, std::string_view field, Check& check);

std::uint8_t u8_from(std::uint32_t value, std::uint32_t last, std::string_view field, Check& check);

Box box_from(const wire::Box& in, Check& check);
void put(const Box& box, wire::Box& out);

}  // namespace selvage::message_fields
