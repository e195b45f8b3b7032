// SPDX-License-Identifier: MIT
#include "client/fetch/pack_source.h"

#include "client/fetch/missing_parts.h"

namespace selvage {

Result<std::shared_ptr<const Manifest>> PackSource::open(std::stop_token) {
  auto pack = Pack::open(path_);
  if (!pack) return forward_error(pack);
  pack_ = std::move(*pack);
  return std::make_shared<const Manifest>(
      Manifest{path_.stem().string(), pack_->id(), pack_->directory(), pack_->directory_bytes().size()});
}

Result<GetStats> PackSource::get(GetRequest request, const OnPart& on_part, std::stop_token stop) {
  auto missing = MissingParts::of(pack_->directory(), request.selection);
  if (!missing) return forward_error(missing);
  const std::set<Hash> have(request.have.begin(), request.have.end());
  GetStats stats;
  for (const PartId& id : missing->ids()) {
    if (stop.stop_requested()) return fail(ErrorCode::Cancelled, "cancelled");
    const PartRef& ref = *pack_->directory().find(id);
    if (have.contains(ref.hash)) {
      ++stats.held;
      continue;
    }
    const auto bytes = pack_->part(ref);
    auto ok = check_part(ref, bytes);
    if (!ok) return forward_error(ok);
    ++stats.parts;
    stats.bytes += bytes.size();
    ok = on_part({id, {bytes.begin(), bytes.end()}, {}});
    if (!ok) return forward_error(ok);
  }
  return stats;
}

}  // namespace selvage
