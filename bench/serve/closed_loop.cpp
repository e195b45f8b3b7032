// SPDX-License-Identifier: MIT
#include "bench/serve/closed_loop.h"

#include <algorithm>
#include <arpa/inet.h>
#include <chrono>
#include <cstring>
#include <netinet/tcp.h>
#include <stdexcept>
#include <sys/epoll.h>
#include <unistd.h>

#include "common/net/frame.h"

namespace selvage::bench {
namespace {

using Clock = std::chrono::steady_clock;

/// Finds where an answer ends in what is received.
class AnswerEnd {
 public:
  explicit AnswerEnd(Speech speech) : speech_(speech) {}

  /// True when `bytes` ends an answer; there is never more than one under way.
  bool feed(const char* bytes, std::size_t size) {
    return speech_ == Speech::Http ? feed_http(bytes, size) : feed_frames(bytes, size);
  }

 private:
  bool feed_http(const char* bytes, std::size_t size) {
    if (left_ == 0) {
      head_.append(bytes, size);
      const std::size_t end = head_.find("\r\n\r\n");
      if (end == std::string::npos) return false;
      if (!head_.starts_with("HTTP/1.1 206")) throw std::runtime_error("nginx says " + head_.substr(0, 60));
      const std::size_t length = head_.find("Content-Length: ");
      if (length == std::string::npos || length > end) throw std::runtime_error("no Content-Length");
      left_ = std::stoull(head_.substr(length + 16));
      size = head_.size() - end - 4;
      head_.clear();
    }
    left_ -= std::min<std::uint64_t>(left_, size);
    return left_ == 0;
  }

  bool feed_frames(const char* bytes, std::size_t size) {
    bool ended = false;
    while (size > 0) {
      const std::size_t skipped = std::min<std::uint64_t>(left_, size);
      left_ -= skipped;
      bytes += skipped;
      size -= skipped;
      const std::size_t taken = std::min(size, kFrameHeaderSize - head_.size());
      head_.append(bytes, taken);
      bytes += taken;
      size -= taken;
      if (head_.size() < kFrameHeaderSize) break;
      const auto raw = std::as_bytes(std::span(head_));
      const auto header = parse_header(ConstHeaderBytes(raw.data(), kFrameHeaderSize));
      if (!header || header->type == FrameType::Error) throw std::runtime_error("the server refuses");
      ended |= header->type == FrameType::RequestEnd;
      left_ = header->length;
      head_.clear();
    }
    return ended && left_ == 0 && head_.empty();
  }

  Speech speech_;
  std::string head_;
  std::uint64_t left_ = 0;
};

struct Connection {
  int socket = -1;
  AnswerEnd end;
  Clock::time_point asked;
};

void say(int socket, const std::string& text) {
  if (::send(socket, text.data(), text.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(text.size()))
    throw std::runtime_error("the server does not take a request");
}

}  // namespace

int connect_to(std::uint16_t port, const std::string& host) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  if (socket < 0 || ::inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1 ||
      ::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error(std::string("cannot connect: ") + std::strerror(errno));
  const int one = 1;
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
  return socket;
}

double LoopResult::quantile(double share) const {
  if (latencies.empty()) return 0;
  return latencies[static_cast<std::size_t>(share * static_cast<double>(latencies.size() - 1))];
}

LoopResult run_closed_loop(const LoopPlan& plan) {
  std::mt19937 random(1);
  const int poll = ::epoll_create1(0);
  std::vector<Connection> all;
  for (unsigned i = 0; i < plan.connections; ++i)
    all.push_back({connect_to(plan.port), AnswerEnd(plan.speech), {}});
  const auto ask = [&](Connection& connection) {
    connection.asked = Clock::now();
    say(connection.socket, plan.request(random));
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    epoll_event event{EPOLLIN, {.u64 = i}};
    ::epoll_ctl(poll, EPOLL_CTL_ADD, all[i].socket, &event);
    if (!plan.greeting.empty()) say(all[i].socket, plan.greeting);
    ask(all[i]);
  }

  LoopResult result;
  std::vector<char> buffer(256 << 10);
  const auto start = Clock::now();
  const auto stop = start + std::chrono::duration<double>(plan.seconds);
  while (Clock::now() < stop) {
    epoll_event ready[64];
    const int count = ::epoll_wait(poll, ready, 64, 1000);
    for (int i = 0; i < count; ++i) {
      Connection& connection = all[ready[i].data.u64];
      const ssize_t got = ::recv(connection.socket, buffer.data(), buffer.size(), MSG_DONTWAIT);
      if (got < 0 && errno == EAGAIN) continue;
      if (got <= 0) throw std::runtime_error("the server hung up");
      result.bytes += static_cast<std::uint64_t>(got);
      if (!connection.end.feed(buffer.data(), static_cast<std::size_t>(got))) continue;
      ++result.answers;
      result.latencies.push_back(std::chrono::duration<double>(Clock::now() - connection.asked).count());
      ask(connection);
    }
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  for (Connection& connection : all) ::close(connection.socket);
  ::close(poll);
  std::ranges::sort(result.latencies);
  return result;
}

}  // namespace selvage::bench
