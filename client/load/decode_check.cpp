// SPDX-License-Identifier: MIT
#include "client/load/decode_check.h"

#include <boost/asio/post.hpp>

#include "common/pack/selection.h"

namespace selvage {

namespace asio = boost::asio;

void DecodeCheck::work(std::function<Result<void>()> task, std::function<void()> then) {
  ++outstanding_;
  asio::post(workers_, [self = shared_from_this(), task = std::move(task), then = std::move(then)] {
    Result<void> outcome = task();
    asio::post(self->io_, [self, outcome = std::move(outcome), then] {
      --self->outstanding_;
      if (!outcome && self->outcome_) self->outcome_ = outcome;
      if (outcome && then) then();
      self->done_.notify();
    });
  });
}

void DecodeCheck::add(ReceivedPart part, std::function<void()> on_region) {
  const bool is_region = part.id.kind == PartKind::Region;
  const auto held = std::make_shared<ReceivedPart>(std::move(part));
  work([this, held] { return collector_.add(held->id, held->bytes); },
       is_region ? std::move(on_region) : nullptr);
}

asio::awaitable<Result<void>> DecodeCheck::finish(std::optional<Selection> verified) {
  while (outstanding_ > 0) co_await done_.wait();
  if (outcome_ && verified) {
    std::function<Result<void>()> check = [this, verified] { return check_mesh(*verified); };
    work(std::move(check), nullptr);
    while (outstanding_ > 0) co_await done_.wait();
  }
  co_return outcome_;
}

Result<void> DecodeCheck::check_mesh(const Selection& selection) {
  const Directory& directory = manifest_->directory;
  auto regions = select_regions(directory, selection);
  if (!regions) return forward_error(regions);
  std::uint64_t least = 0;
  for (const RegionId region : *regions) {
    const auto& levels = directory.regions[region].levels;
    const std::size_t level = std::min<std::size_t>(selection.level, levels.size() - 1);
    least += levels[level].triangles;
  }
  const StitchedMesh mesh = collector_.mesh();
  const std::uint64_t vertices = mesh.soup.positions.size(), triangles = mesh.soup.triangles.size();
  const bool is_all = regions->size() == directory.real_region_count() && selection.level == 0 &&
                      selection.joins != Joins::None;
  const bool is_right = is_all ? vertices == directory.vertices && triangles == directory.triangles
                               : collector_.regions().size() >= regions->size() && triangles >= least;
  if (is_right) return {};
  return fail(ErrorCode::BadStream,
              "stitched to " + std::to_string(triangles) + " triangles, which is wrong");
}

}  // namespace selvage
