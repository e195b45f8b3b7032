// SPDX-License-Identifier: MIT
#include "common/net/tcp_kernel.h"

#include <cerrno>
#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <system_error>

namespace selvage {

std::optional<TcpFigures> tcp_figures(int socket) {
  tcp_info info{};  // an older kernel fills less of it
  socklen_t size = sizeof info;
  if (::getsockopt(socket, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return std::nullopt;
  return TcpFigures{info.tcpi_rtt, info.tcpi_delivery_rate};
}

void limit_unsent(int socket, std::uint32_t bytes) {
  const int value = static_cast<int>(bytes);
  ::setsockopt(socket, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &value, sizeof value);
}

Result<void> use_congestion_control(int socket, const std::string& name) {
  const auto size = static_cast<socklen_t>(name.size());
  if (::setsockopt(socket, IPPROTO_TCP, TCP_CONGESTION, name.c_str(), size) == 0) return {};
  const std::string why = std::generic_category().message(errno);
  return fail(ErrorCode::InvalidArgument,
              "no congestion control '" + name + "': " + why +
                  "; net.ipv4.tcp_allowed_congestion_control lists those that all may use");
}

}  // namespace selvage
