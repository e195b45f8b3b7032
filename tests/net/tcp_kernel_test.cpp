// SPDX-License-Identifier: MIT
#include "common/net/tcp_kernel.h"

#include <netinet/tcp.h>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <gtest/gtest.h>

namespace selvage {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

std::string congestion_control_of(tcp::socket& socket) {
  char name[16] = {};
  socklen_t size = sizeof name;
  EXPECT_EQ(::getsockopt(socket.native_handle(), IPPROTO_TCP, TCP_CONGESTION, name, &size), 0);
  return name;
}

TEST(TcpKernel, CongestionControlIsThatOfTheConnectionsAccepted) {
  asio::io_context io;
  tcp::acceptor acceptor(io, tcp::endpoint(asio::ip::address_v4::loopback(), 0));
  // The one that every kernel has.
  ASSERT_TRUE(use_congestion_control(acceptor.native_handle(), "reno"));
  tcp::socket near(io);
  near.connect(acceptor.local_endpoint());
  tcp::socket far = acceptor.accept();
  EXPECT_EQ(congestion_control_of(far), "reno");
}

TEST(TcpKernel, SaysWhichCongestionControlThereIsNot) {
  asio::io_context io;
  tcp::acceptor acceptor(io, tcp::endpoint(asio::ip::address_v4::loopback(), 0));
  const auto chosen = use_congestion_control(acceptor.native_handle(), "haste");
  ASSERT_FALSE(chosen);
  EXPECT_EQ(chosen.error().code, ErrorCode::InvalidArgument);
  EXPECT_NE(chosen.error().message.find("'haste'"), std::string::npos);
}

}  // namespace
}  // namespace selvage
