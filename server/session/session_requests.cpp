// SPDX-License-Identifier: MIT
//
// A session's requests for what the store has: lists, directories and parts. What may take a millisecond is
// looked up on a worker.
#include <algorithm>
#include <utility>

#include "server/session/request_handler.h"
#include "server/session/session.h"

namespace selvage {
namespace {

/// Requests that look at more than so many things (bytes of the request, regions of the model) are answered
/// on the workers: they may take a millisecond or more.
constexpr std::size_t kSmallRequest = 16u << 10;
constexpr std::size_t kSmallModel = 4096;

}  // namespace

asio::awaitable<Result<void>> Session::list(std::uint32_t request_id, ListModels request) {
  note("list", request_id, LogFields());
  auto look = [&store = services_.store] { return store.list(); };
  Result<std::vector<PackStore::Model>> models = co_await on_workers(std::move(look));
  if (models) {
    send(answer_list(request, *models), request_id);
  } else {
    send_error(models.error(), request_id);
  }
  co_return Result<void>();
}

asio::awaitable<Result<void>> Session::open(std::uint32_t request_id, OpenModel request) {
  note_model("open", request_id, request.name);
  Result<std::shared_ptr<const Pack>> pack = co_await open_pack(request.name);
  if (pack) {
    send_answer(answer_open(request_id, request, std::move(*pack)));
  } else {
    send_error(pack.error(), request_id);
  }
  co_return Result<void>();
}

/// A get need not wait for an open's answer, nor even follow one. `payload` lives until the next read.
asio::awaitable<Result<void>> Session::get(std::uint32_t request_id, std::span<const std::byte> payload) {
  const bool is_small = payload.size() <= kSmallRequest;
  auto parse_request = [payload] { return parse<GetParts>(payload); };
  Result<GetParts> request;
  if (is_small) {
    request = parse_request();
  } else {
    request = co_await on_workers(parse_request);
  }
  if (!request) co_return forward_error(request);
  ++services_.counters.gets;
  note_model("get", request_id, request->model);

  Result<std::shared_ptr<const Pack>> pack = opened_pack(request->model);
  if (*pack == nullptr) pack = co_await open_pack(request->model);
  if (!pack) {
    send_error(pack.error(), request_id);
    co_return Result<void>();
  }
  auto look_up = [&] { return answer_get(request_id, *request, *pack, limits_); };
  Result<Answer> answer;
  if (is_small && (*pack)->directory().regions.size() <= kSmallModel) {
    answer = look_up();
  } else {
    answer = co_await on_workers(look_up);
  }
  if (answer) {
    send_answer(std::move(*answer));
  } else {
    send_error(answer.error(), request_id);
  }
  co_return Result<void>();
}

void Session::status(std::uint32_t request_id) { send(answer_status(services_, draining_), request_id); }

std::shared_ptr<const Pack> Session::opened_pack(const std::string& name) const {
  const auto found = std::ranges::find(opened_, name, &OpenedModel::name);
  return found == opened_.end() || found->pack->is_damaged() ? nullptr : found->pack;
}

/// The pack as the store has it now; remembered for the gets to come.
asio::awaitable<Result<std::shared_ptr<const Pack>>> Session::open_pack(std::string name) {
  auto look = [&store = services_.store, &name] { return store.open(name); };
  Result<std::shared_ptr<const Pack>> pack = co_await on_workers(std::move(look));
  if (pack) {
    std::erase_if(opened_, [&](const OpenedModel& model) { return model.name == name; });
    opened_.push_back({std::move(name), *pack});
    if (opened_.size() > limits_.opened_models) opened_.erase(opened_.begin());
  }
  co_return pack;
}

}  // namespace selvage
