// SPDX-License-Identifier: MIT
//
// Networks of a benchmark's own, where it may choose what TCP does, whatever the machine's network is set to.
#pragma once

#include <string>

namespace selvage::bench {

/// This thread and what it starts from now on see a network of their own, in which loopback is up. Needs root
/// or user namespaces; std::runtime_error says what is missing.
void enter_private_network();

/// For all connections of this thread's network that are made from now on. With std::runtime_error where the
/// kernel has none of that name.
void use_congestion_control(const std::string& name);

}  // namespace selvage::bench
