// SPDX-License-Identifier: MIT
#include "client/fetch/list_models.h"

#include "client/session/blocking_client.h"

namespace selvage {

Result<std::vector<ModelInfo>> list_models(const std::string& server, const ClientOptions& options) {
  ClientOptions at_once = options;
  at_once.await_greeting = false;
  auto client = connect_to(server, std::move(at_once));
  if (!client) return forward_error(client);
  auto models = client->list();
  if (!models) return forward_error(models, server);
  return models;
}

}  // namespace selvage
