// SPDX-License-Identifier: MIT
#include "client/fetch/server_source.h"

namespace selvage {

Result<void> ServerSource::connect(const std::stop_token& stop) {
  if (client_) return {};
  auto client = BlockingClient::connect(server_, options_, stop);
  if (!client) return forward_error(client);
  client_.emplace(std::move(*client));
  return {};
}

/// After a failure that may be the connection's, the next use makes a new one.
template <class T>
Result<T> ServerSource::settled(Result<T> outcome) {
  if (outcome) return outcome;
  const ErrorCode code = outcome.error().code;
  const bool is_alive = code == ErrorCode::NotFound || code == ErrorCode::ModelChanged ||
                        code == ErrorCode::Cancelled || code == ErrorCode::LimitExceeded;
  if (!is_alive) client_.reset();
  return outcome;
}

Result<std::shared_ptr<const Manifest>> ServerSource::open(std::stop_token stop) {
  auto connected = connect(stop);
  if (!connected) return forward_error(connected);
  return settled(client_->open(model_, stop));
}

Result<GetStats> ServerSource::get(GetRequest request, const OnPart& on_part, std::stop_token stop) {
  auto connected = connect(stop);
  if (!connected) return forward_error(connected);
  return settled(client_->get(std::move(request), on_part, stop));
}

Result<GetStats> ServerSource::open_and_get(FirstRequest request, const OnManifest& on_manifest,
                                            const OnPart& on_part, std::stop_token stop) {
  auto connected = connect(stop);
  if (!connected) return forward_error(connected);
  return settled(client_->open_and_get(model_, std::move(request), on_manifest, on_part, stop));
}

}  // namespace selvage
