// SPDX-License-Identifier: MIT
//
// What a request means: from a message and a model to the answer, by looking up directories and nothing else.
// Pure; the session fetches the pack before and sends the answer after.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/net/messages.h"
#include "server/session/limits.h"
#include "server/session/outbox.h"
#include "server/session/services.h"
#include "server/store/pack_store.h"

namespace selvage {

/// One page of the models after `request.after`; small enough for a frame.
Models answer_list(const ListModels& request, const std::vector<PackStore::Model>& models);

/// The model's directory, or as much of it as is asked for.
Answer answer_open(std::uint32_t request_id, const OpenModel& request, std::shared_ptr<const Pack> pack);

/// The parts that a selection means, without those that the client has, in the order of select_parts and
/// with_pages.
/// ModelChanged if the request names another pack; NotFound names a region that is not there; LimitExceeded.
Result<Answer> answer_get(std::uint32_t request_id, const GetParts& request, std::shared_ptr<const Pack> pack,
                          const SessionLimits& limits);

/// From counters and what is known of the store: touches no disk.
StatusReport answer_status(const SessionServices& services, bool is_draining);

}  // namespace selvage
