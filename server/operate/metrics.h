// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "server/session/services.h"

namespace selvage {

/// Everything that is counted, in Prometheus's text format. docs/OPERATIONS.md lists the names.
std::string metrics_text(const SessionServices& services);

}  // namespace selvage
