// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <stop_token>

#include "client/session/get_request.h"
#include "common/base/result.h"

namespace selvage {

/// Where the parts of one model come from: a selvage server, a static web server, a file. Blocking; one
/// thread at a time. Errors that may pass (Io, Unavailable, Timeout) leave the source fit for another try.
class PartSource {
 public:
  virtual ~PartSource() = default;

  /// The model's directory, checked against its own hashes.
  virtual Result<std::shared_ptr<const Manifest>> open(std::stop_token stop = {}) = 0;

  /// Called on the thread that called get(), with each part, whose hash was checked. An error ends the get.
  using OnPart = std::function<Result<void>(ReceivedPart)>;

  /// The parts that the request's selection gives (common/pack/selection.h) but for those it holds, in any
  /// order, each once. ModelChanged if the model is not the one that was opened any more; Cancelled soon
  /// after `stop`.
  virtual Result<GetStats> get(GetRequest request, const OnPart& on_part, std::stop_token stop = {}) = 0;

  /// Called like OnPart, once, before any part, with what is known of the directory then.
  using OnManifest = std::function<Result<void>(Manifest)>;

  /// open() and get() at once, for sources where that saves a round trip. Pages that the manifest's directory
  /// lacks come among the parts, each before what it lists; those that nothing needed may be missing in the
  /// end.
  virtual Result<GetStats> open_and_get(FirstRequest request, const OnManifest& on_manifest,
                                        const OnPart& on_part, std::stop_token stop = {});
};

}  // namespace selvage
