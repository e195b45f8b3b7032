// SPDX-License-Identifier: MIT
#include "bench/serve/private_network.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sched.h>
#include <stdexcept>
#include <unistd.h>

namespace selvage::bench {
namespace {

[[noreturn]] void give_up(const std::string& what) {
  throw std::runtime_error("no network of our own: " + what + ": " + std::strerror(errno));
}

/// Whoever is not root becomes it in a user namespace, which may then have networks of its own.
void become_root_somewhere() {
  if (::geteuid() == 0) return;
  const auto user = std::to_string(::geteuid()), group = std::to_string(::getegid());
  if (::unshare(CLONE_NEWUSER) != 0) give_up("user namespaces");
  std::ofstream("/proc/self/setgroups") << "deny";
  std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
  std::ofstream("/proc/self/gid_map") << "0 " << group << " 1";
}

}  // namespace

void enter_private_network() {
  become_root_somewhere();
  if (::unshare(CLONE_NEWNET) != 0) give_up("network namespaces (root?)");
  if (std::system("ip link set lo up") != 0) give_up("ip link set lo up (iproute2?)");
}

void use_congestion_control(const std::string& name) {
  std::ofstream setting("/proc/sys/net/ipv4/tcp_congestion_control");
  setting << name << std::flush;
  if (!setting) throw std::runtime_error("this kernel has no congestion control '" + name + "' for us");
}

}  // namespace selvage::bench
