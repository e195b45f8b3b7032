// SPDX-License-Identifier: MIT
#include "bench/serve/bulk_pings.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <poll.h>
#include <stdexcept>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

#include "common/net/frame.h"
#include "common/net/messages.h"

namespace selvage::bench {
namespace {

using Clock = std::chrono::steady_clock;

void send_all(int socket, const std::string& text) {
  if (::send(socket, text.data(), text.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(text.size()))
    throw std::runtime_error("the server does not take a frame");
}

template <class Message>
std::string frame_text(const Message& message, std::uint32_t id) {
  const auto bytes = to_frame(message, id);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Reads frames until one of `type`; counts Data bytes.
void read_until(int socket, FrameBuffer& buffer, FrameType type, std::uint64_t& data) {
  for (;;) {
    const auto frame = buffer.take();
    if (!frame) throw std::runtime_error(frame.error().message);
    if (frame->has_value()) {
      if ((*frame)->is(FrameType::Data)) data += (*frame)->payload.size();
      if ((*frame)->is(type)) return;
      continue;
    }
    const auto room = buffer.writable();
    const ssize_t got = ::recv(socket, room.data(), room.size(), 0);
    if (got <= 0) throw std::runtime_error("the server hung up");
    buffer.commit(static_cast<std::size_t>(got));
  }
}

std::string get_all(const std::string& model, std::uint32_t id) {
  GetParts get;
  get.model = model;
  get.selection.joins = Joins::None;
  return frame_text(get, id);
}

}  // namespace

PingTimes ping_under_bulk(const Peer& selvage, const std::string& model, unsigned others, double seconds) {
  std::atomic<bool> stop = false;
  const auto saturate = [&] {
    const int socket = connect_to(selvage.port);
    FrameBuffer buffer(kMaxPayload, 256 << 10);
    std::uint64_t data = 0;
    send_all(socket, hello_bytes() + get_all(model, 1) + get_all(model, 2));
    for (std::uint32_t id = 3; !stop; ++id) {
      read_until(socket, buffer, FrameType::RequestEnd, data);
      send_all(socket, get_all(model, id));
    }
    ::close(socket);
  };
  std::vector<std::jthread> threads;
  for (unsigned i = 0; i < others; ++i) threads.emplace_back(saturate);

  const int socket = connect_to(selvage.port);
  FrameBuffer buffer(kMaxPayload, 256 << 10);
  send_all(socket, hello_bytes() + get_all(model, 1) + get_all(model, 2));
  std::vector<double> times;
  std::uint64_t data = 0;
  std::uint32_t id = 3;
  const auto start = Clock::now();
  auto asked = start;
  send_all(socket, frame_text(Ping{}, 999));
  while (Clock::now() - start < std::chrono::duration<double>(seconds)) {
    const auto frame = buffer.take();
    if (!frame) throw std::runtime_error(frame.error().message);
    if (!frame->has_value()) {
      const auto room = buffer.writable();
      const ssize_t got = ::recv(socket, room.data(), room.size(), 0);
      if (got <= 0) throw std::runtime_error("the server hung up");
      buffer.commit(static_cast<std::size_t>(got));
    } else if ((*frame)->is(FrameType::Data)) {
      data += (*frame)->payload.size();
    } else if ((*frame)->is(FrameType::RequestEnd)) {
      send_all(socket, get_all(model, id++));
    } else if ((*frame)->is(FrameType::Pong)) {
      times.push_back(std::chrono::duration<double>(Clock::now() - asked).count());
      asked = Clock::now();
      send_all(socket, frame_text(Ping{}, 999));
    }
  }
  stop = true;
  threads.clear();
  ::close(socket);

  PingTimes result;
  std::ranges::sort(times);
  result.pings = times.size();
  if (times.empty()) return result;
  result.median = times[times.size() / 2];
  result.p99 = times[times.size() * 99 / 100];
  result.worst = times.back();
  result.bulk_bytes_per_second = static_cast<double>(data) / seconds;
  return result;
}

}  // namespace selvage::bench
