// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <boost/asio/io_context.hpp>
#include <boost/asio/thread_pool.hpp>

#include "client/session/get_request.h"
#include "client/stitch/part_collector.h"
#include "common/net/signal.h"

namespace selvage {

/// Decodes the parts of one get on worker threads, and checks what they stitch to. Used on the thread of
/// `io`, which the workers report to.
class DecodeCheck : public std::enable_shared_from_this<DecodeCheck> {
 public:
  DecodeCheck(boost::asio::io_context& io, boost::asio::thread_pool& workers,
              std::shared_ptr<const Manifest> manifest)
      : io_(io), workers_(workers), manifest_(std::move(manifest)), collector_(manifest_->directory) {}

  /// `on_region` is called on the thread of `io` when the part was a region.
  void add(ReceivedPart part, std::function<void()> on_region);

  /// Waits for all that was added. With a selection, its mesh is stitched, and BadStream if it is not what
  /// the directory promises.
  boost::asio::awaitable<Result<void>> finish(std::optional<Selection> verified);

 private:
  void work(std::function<Result<void>()> task, std::function<void()> then);
  Result<void> check_mesh(const Selection& selection);

  boost::asio::io_context& io_;
  boost::asio::thread_pool& workers_;
  std::shared_ptr<const Manifest> manifest_;
  PartCollector collector_;
  Signal done_;
  std::size_t outstanding_ = 0;
  Result<void> outcome_;
};

}  // namespace selvage
