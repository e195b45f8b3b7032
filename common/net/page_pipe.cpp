// SPDX-License-Identifier: MIT
#include "common/net/page_pipe.h"

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <memory>
#include <sys/uio.h>
#include <unistd.h>
#include <utility>

namespace selvage {
namespace {

/// What a pipe may hold for users without privileges (fs.pipe-max-size).
constexpr int kPipeSize = 1 << 20;

}  // namespace

PagePipe* PagePipe::of_this_thread() {
  // A thread that can't have one does not try again at every write.
  thread_local const std::unique_ptr<PagePipe> kPipe = [] {
    std::unique_ptr<PagePipe> pipe(new PagePipe);
    return pipe->open() ? std::move(pipe) : nullptr;
  }();
  return kPipe.get();
}

bool PagePipe::open() {
  int ends[2];
  if (::pipe2(ends, O_NONBLOCK | O_CLOEXEC) != 0) return false;
  out_ = ends[0];
  in_ = ends[1];
  nowhere_ = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::fcntl(in_, F_SETPIPE_SZ, kPipeSize);  // with less, a write takes more calls
  sigset_t pipe_signal;
  sigemptyset(&pipe_signal);
  sigaddset(&pipe_signal, SIGPIPE);
  if (nowhere_ < 0 || ::pthread_sigmask(SIG_BLOCK, &pipe_signal, nullptr) != 0) return false;
  const std::byte probe{};  // sandboxes may forbid the calls
  const bool works = add_pages(std::span(&probe, 1)) == 1;
  drop();
  return works && size_ == 0;
}

PagePipe::~PagePipe() {
  for (const int descriptor : {in_, out_, nowhere_}) {
    if (descriptor >= 0) ::close(descriptor);
  }
}

ssize_t PagePipe::add_pages(std::span<const std::byte> bytes) {
  const iovec range{const_cast<std::byte*>(bytes.data()), bytes.size()};
  return count(::vmsplice(in_, &range, 1, SPLICE_F_NONBLOCK));
}

ssize_t PagePipe::add_copies(std::span<const iovec> pieces) {
  return count(::writev(in_, pieces.data(), static_cast<int>(pieces.size())));
}

ssize_t PagePipe::count(ssize_t added) {
  if (added > 0) size_ += static_cast<std::size_t>(added);
  return added;
}

ssize_t PagePipe::send(int socket, bool more) {
  if (empty()) {
    errno = EAGAIN;
    return -1;
  }
  const unsigned flags = SPLICE_F_NONBLOCK | SPLICE_F_MOVE | (more ? SPLICE_F_MORE : 0);
  ssize_t sent = 0, step = 0;
  for (; size_ > 0; size_ -= static_cast<std::size_t>(step), sent += step) {
    step = ::splice(out_, nullptr, socket, nullptr, size_, flags);
    if (step <= 0) break;
  }
  const int error = errno;
  drop();
  errno = error;
  return sent > 0 ? sent : step;
}

void PagePipe::drop() {
  while (size_ > 0) {
    const ssize_t step = ::splice(out_, nullptr, nowhere_, nullptr, size_, SPLICE_F_NONBLOCK);
    if (step <= 0) break;
    size_ -= static_cast<std::size_t>(step);
  }
}

}  // namespace selvage
