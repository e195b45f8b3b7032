// SPDX-License-Identifier: MIT
//
// Who may do what: bearer tokens, which clients send in their Hello, and the scopes that go with them.
//
// A token file has a line for each token: a name for logs, scopes, and the SHA-256 of the token, so that the
// file holds no secret that would open a door. A line for `anonymous` says what clients without a token may
// do.
//
//     # name     scopes         token
//     viewer     read           sha256:9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08
//     modeller   read,publish   sha256:60303ae22b998861bce3b28f33eec1be758a213c86c93c076dbe9f558c11c752
//     anonymous  read
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/secret.h"
#include "common/base/result.h"

namespace selvage {

/// What one connection may do, from its Hello to its end.
struct Access {
  std::string who = "anonymous";
  bool may_read = false;
  bool may_publish = false;
};

/// Immutable.
class AccessTable {
 public:
  /// Without tokens: everybody reads, nobody publishes.
  AccessTable();

  /// BadFile names the line.
  static Result<AccessTable> parse(std::string_view text);
  /// Errors name the file.
  static Result<AccessTable> read(const std::filesystem::path& path);

  /// Unauthorised for a token that is not in the table, and for none where anonymous clients may do nothing.
  /// Compares hashes, and all of them, so that the time taken says nothing about any token.
  Result<Access> access_of(std::string_view token) const;

  std::size_t token_count() const { return tokens_.size(); }

 private:
  struct Token {
    Sha256 hash;
    Access access;
  };
  std::vector<Token> tokens_;
  Access anonymous_;
};

/// The table in force. Thread-safe; connections keep what they were granted when another is put in its place.
class AccessControl {
 public:
  explicit AccessControl(AccessTable table = {}) { replace(std::move(table)); }

  void replace(AccessTable table);
  std::shared_ptr<const AccessTable> table() const;

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const AccessTable> table_;
};

}  // namespace selvage
