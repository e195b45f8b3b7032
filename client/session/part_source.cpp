// SPDX-License-Identifier: MIT
#include "client/session/part_source.h"

namespace selvage {

Result<GetStats> PartSource::open_and_get(FirstRequest request, const OnManifest& on_manifest,
                                          const OnPart& on_part, std::stop_token stop) {
  auto manifest = open(stop);
  if (!manifest) return forward_error(manifest);
  if (auto ok = on_manifest(**manifest); !ok) return forward_error(ok);
  GetRequest get{*manifest, std::move(request.selection)};
  get.urgency = request.urgency;
  get.unfinished = std::move(request.unfinished);
  get.dial = std::move(request.dial);
  return this->get(std::move(get), on_part, std::move(stop));
}

}  // namespace selvage
