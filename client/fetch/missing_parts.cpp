// SPDX-License-Identifier: MIT
#include "client/fetch/missing_parts.h"

namespace selvage {

Result<MissingParts> MissingParts::of(const Directory& directory, const Selection& selection) {
  auto ids = select_parts(directory, selection);
  if (!ids) return forward_error(ids);
  MissingParts missing(directory);
  missing.ids_.insert(ids->begin(), ids->end());
  for (const PartId& id : missing.ids_) ++missing.missing_of_hash_[directory.find(id)->hash];
  return missing;
}

bool MissingParts::take(const PartId& id) {
  if (ids_.erase(id) == 0) return false;
  --missing_of_hash_[directory_->find(id)->hash];
  return true;
}

std::vector<Hash> MissingParts::held() const {
  std::vector<Hash> hashes;
  for (const auto& [hash, missing] : missing_of_hash_) {
    if (missing == 0) hashes.push_back(hash);
  }
  return hashes;
}

}  // namespace selvage
