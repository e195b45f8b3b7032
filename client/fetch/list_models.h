// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "client/session/client_options.h"
#include "common/net/messages.h"

namespace selvage {

/// The models of a selvage server, ascending by name. `server` is HOST:PORT. Errors name it.
Result<std::vector<ModelInfo>> list_models(const std::string& server, const ClientOptions& options = {});

}  // namespace selvage
