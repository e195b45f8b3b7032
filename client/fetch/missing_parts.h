// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <set>
#include <vector>

#include "common/base/result.h"
#include "common/pack/directory.h"
#include "common/pack/selection.h"

namespace selvage {

/// The parts of a selection, and which of them have not come yet.
class MissingParts {
 public:
  /// `directory` is borrowed. Fails like select_parts.
  static Result<MissingParts> of(const Directory& directory, const Selection& selection);

  const std::set<PartId>& ids() const { return ids_; }
  bool empty() const { return ids_.empty(); }

  /// The part has come. False if it was not missing.
  bool take(const PartId& id);

  /// What a request for the rest need not bring. Parts with the same bytes have one hash, which a request can
  /// only name once all of them are there.
  std::vector<Hash> held() const;

 private:
  explicit MissingParts(const Directory& directory) : directory_(&directory) {}

  const Directory* directory_;
  std::set<PartId> ids_;
  std::map<Hash, std::uint32_t> missing_of_hash_;  ///< 0 of a hash: all are there
};

}  // namespace selvage
