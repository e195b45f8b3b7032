// SPDX-License-Identifier: MIT
#include "common/net/message_fields.h"

#include <algorithm>
#include <cmath>

#include "common/net/text.h"

#include "messages.pb.h"

namespace selvage::message_fields {

std::string name_from(const std::string& text, std::string_view field, Check& check) {
  check.that(!text.empty() && text.size() <= kMaxNameLength && is_printable_utf8(text), field);
  return text;
}

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

}  // namespace selvage::message_fields
