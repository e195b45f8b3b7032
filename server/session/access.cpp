// SPDX-License-Identifier: MIT
#include "server/session/access.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

namespace selvage {
namespace {

constexpr std::string_view kAnonymous = "anonymous";
constexpr std::string_view kHashPrefix = "sha256:";

int digit_of(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::optional<Sha256> hash_from(std::string_view text) {
  if (!text.starts_with(kHashPrefix)) return std::nullopt;
  text.remove_prefix(kHashPrefix.size());
  Sha256 hash;
  if (text.size() != 2 * hash.size()) return std::nullopt;
  for (std::size_t i = 0; i < hash.size(); ++i) {
    const int high = digit_of(text[2 * i]), low = digit_of(text[2 * i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    hash[i] = static_cast<std::uint8_t>(high * 16 + low);
  }
  return hash;
}

/// "read,publish"; false if a word is neither.
bool set_scopes(std::string_view text, Access& access) {
  std::istringstream scopes{std::string(text)};
  for (std::string scope; std::getline(scopes, scope, ',');) {
    if (scope == "read") {
      access.may_read = true;
    } else if (scope == "publish") {
      access.may_publish = true;
    } else {
      return false;
    }
  }
  return access.may_read || access.may_publish;
}

}  // namespace

AccessTable::AccessTable() { anonymous_.may_read = true; }

Result<AccessTable> AccessTable::parse(std::string_view text) {
  AccessTable table;
  table.anonymous_.may_read = false;
  std::istringstream lines{std::string(text)};
  int number = 0;
  const auto bad = [&](const std::string& what) {
    return fail(ErrorCode::BadFile, "line " + std::to_string(number) + ": " + what);
  };
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line.substr(0, line.find('#')));
    const std::vector<std::string> word{std::istream_iterator<std::string>(words), {}};
    if (word.empty()) continue;
    Access access;
    access.who = word[0];
    if (word.size() < 2 || !set_scopes(word[1], access)) {
      return bad("the second word is read, publish or read,publish");
    }
    if (access.who == kAnonymous) {
      if (word.size() != 2) return bad("anonymous clients have scopes and no token");
      table.anonymous_ = access;
      continue;
    }
    const auto hash = word.size() == 3 ? hash_from(word[2]) : std::nullopt;
    if (!hash) {
      return bad(
          "the third word is sha256: and 64 hexadecimal digits, as printf %s TOKEN | sha256sum prints them");
    }
    const bool is_known =
        std::ranges::any_of(table.tokens_, [&](const Token& other) { return other.hash == *hash; });
    if (is_known) return bad("this token is in the file already");
    table.tokens_.push_back({*hash, std::move(access)});
  }
  return table;
}

Result<AccessTable> AccessTable::read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(ErrorCode::NotFound, path.string() + ": cannot be read");
  std::ostringstream text;
  text << file.rdbuf();
  auto table = parse(text.str());
  if (!table) return forward_error(table, path.string());
  return table;
}

Result<Access> AccessTable::access_of(std::string_view token) const {
  if (token.empty()) {
    if (anonymous_.may_read || anonymous_.may_publish) return anonymous_;
    return fail(ErrorCode::Unauthorised, "this server wants a token");
  }
  const Sha256 hash = sha256_of(std::as_bytes(std::span(token)));
  const Token* found = nullptr;
  for (const Token& known : tokens_) {
    if (equal_in_constant_time(known.hash, hash)) found = &known;
  }
  if (found == nullptr) return fail(ErrorCode::Unauthorised, "the token is not one of this server's");
  return found->access;
}

void AccessControl::replace(AccessTable table) {
  auto fresh = std::make_shared<const AccessTable>(std::move(table));
  const std::lock_guard lock(mutex_);
  table_ = std::move(fresh);
}

std::shared_ptr<const AccessTable> AccessControl::table() const {
  const std::lock_guard lock(mutex_);
  return table_;
}

}  // namespace selvage
