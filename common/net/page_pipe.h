// SPDX-License-Identifier: MIT
//
// Sends pages of mapped files without copying them: they go through a pipe into the socket, as sendfile's do,
// but together with the headers between them, and without the file being open. The kernel holds the pages
// until the peer has acknowledged them.
#pragma once

#include <cstddef>
#include <span>
#include <sys/types.h>
#include <sys/uio.h>

namespace selvage {

/// A pipe that is empty between calls, so one serves all connections of a thread.
class PagePipe {
 public:
  /// Null where there is none to be had: descriptors may have run out, a sandbox may forbid it. Blocks
  /// SIGPIPE on this thread, as splice can't be told not to raise it.
  static PagePipe* of_this_thread();

  ~PagePipe();
  PagePipe(const PagePipe&) = delete;
  PagePipe& operator=(const PagePipe&) = delete;

  /// Puts bytes of a mapped file, which nobody changes, into the pipe, or copies of any others. How much of
  /// it went in, as in write(2); less than all when the pipe is full; EFAULT if the file has been cut short.
  ssize_t add_pages(std::span<const std::byte> bytes);
  ssize_t add_copies(std::span<const iovec> pieces);

  bool empty() const { return size_ == 0; }

  /// Empties the pipe into a socket that does not block. As send(2): how much the kernel took, or -1 and
  /// errno. What it did not take is dropped. `more` says that the caller has more to send at once.
  ssize_t send(int socket, bool more);

 private:
  PagePipe() = default;
  bool open();
  ssize_t count(ssize_t added);
  void drop();

  std::size_t size_ = 0;  ///< what is in the pipe
  int in_ = -1, out_ = -1, nowhere_ = -1;
};

}  // namespace selvage
