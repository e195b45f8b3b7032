// SPDX-License-Identifier: MIT
#include "bench/serve/slow_link.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fcntl.h>
#include <fstream>
#include <linux/if_tun.h>
#include <net/if.h>
#include <poll.h>
#include <sched.h>
#include <stdexcept>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <unistd.h>
#include <vector>

#include "bench/serve/private_network.h"

namespace selvage::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr const char* kDevice = "slow0";

[[noreturn]] void give_up(const std::string& what) {
  throw std::runtime_error("no slow link: " + what + ": " + std::strerror(errno));
}

/// In a new network, the only way out of it.
int make_device(const std::string& address, const std::string& congestion_control) {
  enter_private_network();
  const int device = ::open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC);
  ifreq request{};
  request.ifr_flags = IFF_TUN | IFF_NO_PI;
  std::strcpy(request.ifr_name, kDevice);
  if (device < 0 || ::ioctl(device, TUNSETIFF, &request) != 0) give_up("/dev/net/tun");
  const std::string name = kDevice;
  const std::string commands = "ip address add " + address + "/24 dev " + name + " && ip link set " + name +
                               " mtu 1500 up && ip route change 10.77.0.0/24 dev " + name + " congctl " +
                               congestion_control;
  if (std::system(commands.c_str()) != 0) give_up(commands);
  return device;
}

/// One direction.
class Lane {
 public:
  Lane(int from, int to, const LinkShape& shape)
      : from_(from),
        to_(to),
        bytes_per_second_(shape.bits_per_second / 8),
        delay_(Seconds(shape.round_trip) / 2),
        queue_(shape.queue) {}

  int from() const { return from_; }

  void take_in() {
    std::array<char, 2048> packet;
    for (ssize_t size; (size = ::read(from_, packet.data(), packet.size())) > 0;) {
      const auto now = Clock::now();
      const auto begin = std::max(now, free_at_);
      if (begin - now > queue_) continue;  // the queue is full
      free_at_ = begin + std::chrono::duration_cast<Clock::duration>(
                             Seconds(static_cast<double>(size) / bytes_per_second_));
      const auto due = free_at_ + std::chrono::duration_cast<Clock::duration>(delay_);
      under_way_.push_back({due, {packet.data(), packet.data() + size}});
    }
  }

  /// When there is something to deliver again.
  Clock::time_point deliver() {
    for (; !under_way_.empty() && under_way_.front().due <= Clock::now(); under_way_.pop_front()) {
      const auto& bytes = under_way_.front().bytes;
      [[maybe_unused]] const ssize_t lost_if_short = ::write(to_, bytes.data(), bytes.size());
    }
    return under_way_.empty() ? Clock::time_point::max() : under_way_.front().due;
  }

 private:
  struct Packet {
    Clock::time_point due;
    std::vector<char> bytes;
  };
  const int from_, to_;
  const double bytes_per_second_;
  const Seconds delay_, queue_;
  std::deque<Packet> under_way_;
  Clock::time_point free_at_{};  ///< the bottleneck has sent what it has
};

}  // namespace

SlowLink::SlowLink(const LinkShape& shape) : shape_(shape) {
  client_device_ = make_device("10.77.0.2", shape.congestion_control);
  clients_side_ = ::open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
  server_device_ = make_device(kServerAddress, shape.congestion_control);
  carrier_ = std::thread([this] { carry(); });
}

SlowLink::~SlowLink() {
  stopping_ = true;
  carrier_.join();
  for (int file : {clients_side_, server_device_, client_device_}) ::close(file);
}

void SlowLink::enter_clients_side() const {
  if (::setns(clients_side_, CLONE_NEWNET) != 0) give_up("setns");
}

double SlowLink::bytes_per_round_trip() const {
  return shape_.bits_per_second / 8 * Seconds(shape_.round_trip).count();
}

void SlowLink::carry() {
  // A busy machine must not make the link slower than it says: ahead of others where that is allowed.
  const sched_param urgent{.sched_priority = 1};
  ::sched_setscheduler(0, SCHED_FIFO, &urgent);
  ::prctl(PR_SET_TIMERSLACK, 1);
  Lane lanes[] = {{server_device_, client_device_, shape_}, {client_device_, server_device_, shape_}};
  while (!stopping_) {
    auto next = Clock::now() + std::chrono::milliseconds(100);
    for (Lane& lane : lanes) {
      lane.take_in();
      next = std::min(next, lane.deliver());
    }
    pollfd ready[] = {{lanes[0].from(), POLLIN, 0}, {lanes[1].from(), POLLIN, 0}};
    const auto pause = std::max(next - Clock::now(), Clock::duration::zero());
    const auto nanoseconds = std::chrono::duration_cast<std::chrono::nanoseconds>(pause).count();
    const timespec timeout{nanoseconds / 1'000'000'000, nanoseconds % 1'000'000'000};
    ::ppoll(ready, 2, &timeout, nullptr);
  }
}

}  // namespace selvage::bench
