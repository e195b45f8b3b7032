// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "client/session/part_source.h"
#include "common/pack/pack.h"

namespace selvage {

/// Parts straight from a pack on disk.
class PackSource final : public PartSource {
 public:
  explicit PackSource(std::filesystem::path path) : path_(std::move(path)) {}

  Result<std::shared_ptr<const Manifest>> open(std::stop_token stop = {}) override;
  Result<GetStats> get(GetRequest request, const OnPart& on_part, std::stop_token stop = {}) override;

 private:
  std::filesystem::path path_;
  std::shared_ptr<const Pack> pack_;  ///< once opened
};

}  // namespace selvage
