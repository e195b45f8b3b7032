// SPDX-License-Identifier: MIT
//
// Authorities and certificates for tests, made afresh in every run: none that could expire in a repository.
#pragma once

#include <filesystem>
#include <string>

#include "common/net/tls.h"

namespace selvage::testing {

/// An authority of its own; what it signs is written beside its certificate.
class TestAuthority {
 public:
  /// Writes NAME-ca.crt into `folder`, which outlives this.
  TestAuthority(std::filesystem::path folder, const std::string& name);
  ~TestAuthority();
  TestAuthority(const TestAuthority&) = delete;
  TestAuthority& operator=(const TestAuthority&) = delete;

  std::filesystem::path certificate() const { return certificate_; }

  struct Request {
    std::string file = "server";                       ///< FILE.crt and FILE.key
    std::string names = "IP:127.0.0.1,DNS:localhost";  ///< subjectAltName
    int valid_days = 1;                                ///< negative: expired so long ago
  };
  TlsServerFiles issue(const Request& request) const;

 private:
  struct Keys;
  std::filesystem::path folder_, certificate_;
  Keys* keys_;
};

}  // namespace selvage::testing
