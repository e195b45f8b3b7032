// SPDX-License-Identifier: MIT
#include "bench/serve/steering.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <memory>
#include <stdexcept>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>

#include "bench/serve/counted_stream.h"
#include "common/net/messages.h"
#include "tests/support/raw_peer.h"

namespace selvage::bench {
namespace {

using Clock = std::chrono::steady_clock;
using testing::RawPeer;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A connection, its frames, and what has come over it.
struct Line {
  std::uint64_t received = 0;
  Clock::time_point connected;
  std::unique_ptr<RawPeer> peer;

  asio::awaitable<RawPeer::Received> receive() {
    std::optional<RawPeer::Received> frame = co_await peer->receive();
    if (!frame) throw std::runtime_error("the server hung up");
    if (frame->is(FrameType::Error)) {
      const Error error = frame->as<ErrorMessage>().error;
      if (error.code != ErrorCode::Cancelled) throw std::runtime_error(error.message);
    }
    co_return std::move(*frame);
  }
};

asio::awaitable<void> connect(Line& line, Destination to) {
  std::unique_ptr<ByteStream> stream = co_await connect(std::move(to));
  line.connected = Clock::now();
  const Result<void> ready = co_await stream->handshake();
  if (!ready) throw std::runtime_error(ready.error().message);
  line.peer = std::make_unique<RawPeer>(std::make_unique<CountedStream>(std::move(stream), line.received));
}

GetParts get_all(const std::string& model) {
  GetParts get;
  get.model = model;
  get.selection.joins = Joins::None;
  return get;
}

template <class Message>
void append(std::vector<std::byte>& flight, const Message& message, std::uint32_t id) {
  const std::vector<std::byte> frame = to_frame(message, id);
  flight.insert(flight.end(), frame.begin(), frame.end());
}

std::vector<std::byte> hello_flight() {
  Hello hello;
  hello.software = "slow_link_bench";
  hello.initial_credit = kMaxCredit;
  return to_frame(hello, 0);
}

/// Hello, and a get of everything.
std::vector<std::byte> bulk_flight(const std::string& model) {
  std::vector<std::byte> flight = hello_flight();
  append(flight, get_all(model), 1);
  return flight;
}

asio::awaitable<double> time_first_region(Destination to, std::string model) {
  Line line;
  co_await connect(line, to);
  std::vector<std::byte> flight = hello_flight();
  OpenModel open{model, true};
  append(flight, open, 1);
  GetParts get = get_all(model);
  get.selection.kind = Selection::Kind::Ids;
  get.selection.ids.push_back(7);
  get.pages = Pages::Needed;
  append(flight, get, 2);
  co_await line.peer->send_bytes(std::move(flight));
  for (bool is_region = false;;) {
    RawPeer::Received frame = co_await line.receive();
    if (frame.is(FrameType::PartBegin)) is_region = frame.as<PartBegin>().id.kind == PartKind::Region;
    if (is_region && frame.is(FrameType::Data)) break;
  }
  const double took = seconds_since(line.connected);
  line.peer->close();
  co_return took;
}

asio::awaitable<CancelCost> time_cancel(Destination to, std::string model, double after) {
  Line line;
  co_await connect(line, to);
  co_await line.peer->send_bytes(bulk_flight(model));
  while (seconds_since(line.connected) < after) (void)co_await line.receive();
  const std::uint64_t before = line.received;
  const auto cancelled = Clock::now();
  co_await line.peer->send(Cancel{}, 1);
  for (;;) {
    RawPeer::Received frame = co_await line.receive();
    if (frame.is(FrameType::Error)) break;
    if (frame.is(FrameType::RequestEnd)) throw std::runtime_error("the model is too small to cancel");
  }
  const CancelCost cost{line.received - before, seconds_since(cancelled)};
  line.peer->close();
  co_return cost;
}

asio::awaitable<LinkPings> time_pings(Destination to, std::string model, double seconds) {
  Line line;
  co_await connect(line, to);
  std::vector<std::byte> flight = bulk_flight(model);
  append(flight, Ping{}, 999);
  co_await line.peer->send_bytes(std::move(flight));
  LinkPings pings;
  auto asked = Clock::now();
  const double warm_up = seconds / 5;
  std::uint64_t before = 0;
  while (seconds_since(line.connected) < seconds) {
    RawPeer::Received frame = co_await line.receive();
    if (frame.is(FrameType::RequestEnd)) throw std::runtime_error("the model is too small to saturate");
    if (!frame.is(FrameType::Pong)) continue;
    if (seconds_since(line.connected) > warm_up) {
      if (before == 0) before = line.received;
      pings.seconds.push_back(seconds_since(asked));
    }
    asked = Clock::now();
    co_await line.peer->send(Ping{}, 999);
  }
  pings.bytes_per_second = static_cast<double>(line.received - before) / (seconds - warm_up);
  std::ranges::sort(pings.seconds);
  line.peer->close();
  co_return pings;
}

template <class Value>
Value run(asio::awaitable<Value> work) {
  asio::io_context io(1);
  std::exception_ptr thrown;
  Value result{};
  asio::co_spawn(io, std::move(work), [&](std::exception_ptr exception, Value value) {
    thrown = exception;
    result = std::move(value);
  });
  io.run();
  if (thrown) std::rethrow_exception(thrown);
  return result;
}

}  // namespace

double first_region_seconds(const Destination& to, const std::string& model) {
  return run(time_first_region(to, model));
}

CancelCost cancel_cost(const Destination& to, const std::string& model, double after) {
  return run(time_cancel(to, model, after));
}

LinkPings pings_beside_bulk(const Destination& to, const std::string& model, double seconds) {
  return run(time_pings(to, model, seconds));
}

}  // namespace selvage::bench
