// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "server/ingest/repair.h"

namespace selvage {

/// What repair had to do, for whoever brought the mesh: a sentence each, none for a clean one.
std::vector<std::string> notes_of(const RepairReport& report);

}  // namespace selvage
