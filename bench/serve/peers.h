// SPDX-License-Identifier: MIT
//
// The two servers that are compared, on the same folder of packs, each with one thread for its clients; and
// how to ask either for the same parts.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/serve/closed_loop.h"
#include "bench/serve/process.h"
#include "common/pack/pack.h"

namespace selvage::bench {

struct Peer {
  std::unique_ptr<Process> process;
  std::uint16_t port = 0;
};

/// `binary`: selvage-server. `host`: the address to listen on. Throws if it does not come up.
Peer start_selvage(const std::string& binary, const std::filesystem::path& folder,
                   const std::vector<std::string>& options = {}, const std::string& host = "127.0.0.1");
Peer start_nginx(const std::filesystem::path& folder, const std::string& host = "127.0.0.1");

/// A folder of its own, removed with what is in it.
class BenchFolder {
 public:
  BenchFolder();
  ~BenchFolder();
  const std::filesystem::path& path() const { return path_; }
  /// NAME.selvage with `regions` regions of `part_size` bytes each.
  std::shared_ptr<const Pack> add_pack(const std::string& name, std::uint32_t regions,
                                       std::uint32_t part_size);

 private:
  std::filesystem::path path_;
};

std::string hello_bytes();
/// For the region parts `ids` of a pack; one request id will do, since nothing overlaps.
std::string selvage_request(const std::string& name, const std::vector<RegionId>& ids);
std::string http_request(const std::string& name, const Pack& pack, const std::vector<RegionId>& ids);

}  // namespace selvage::bench
