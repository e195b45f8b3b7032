// SPDX-License-Identifier: MIT
#pragma once

#include <boost/asio/any_io_executor.hpp>

#include "server/session/access.h"
#include "server/session/counters.h"
#include "server/session/publishing.h"
#include "server/store/pack_store.h"

namespace selvage {

/// What all sessions of a server share. All of it is thread-safe and outlives them.
struct SessionServices {
  PackStore& store;
  boost::asio::any_io_executor workers;  ///< for what touches the disk
  const AccessControl& access;
  ServerCounters& counters;
  Publishing* publishing = nullptr;   ///< absent: models come only from the folder
  std::uint32_t max_connections = 0;  ///< for status
  bool is_encrypted = false;          ///< for status
};

}  // namespace selvage
