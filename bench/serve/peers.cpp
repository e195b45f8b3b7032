// SPDX-License-Identifier: MIT
#include "bench/serve/peers.h"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <unistd.h>

#include "common/net/messages.h"
#include "tests/support/fake_pack.h"

namespace selvage::bench {
namespace {

/// Until `ready` or ten seconds have gone.
template <class Ready>
void wait_for(const Process& process, const char* what, Ready ready) {
  for (int i = 0; i < 1000; ++i) {
    if (ready()) return;
    if (!process.is_running()) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  throw std::runtime_error(std::string(what) + " does not come up");
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

std::string as_text(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

Peer start_selvage(const std::string& binary, const std::filesystem::path& folder,
                   const std::vector<std::string>& options, const std::string& host) {
  const std::string port_file = folder / "port.txt";
  std::filesystem::remove(port_file);
  std::vector<std::string> command{binary,        "--store", folder.string(), "--listen", host + ":0",
                                   "--port-file", port_file, "--threads",     "1"};
  command.insert(command.end(), options.begin(), options.end());
  Peer peer;
  peer.process = std::make_unique<Process>(command, folder / "selvage-server.out");
  wait_for(*peer.process, "selvage-server",
           [&] { return static_cast<bool>(std::ifstream(port_file) >> peer.port); });
  return peer;
}

Peer start_nginx(const std::filesystem::path& folder, const std::string& host) {
  std::stringstream text;
  text << std::ifstream(SELVAGE_NGINX_CONF).rdbuf();
  Peer peer;
  peer.port = static_cast<std::uint16_t>(20'000 + ::getpid() % 20'000);
  const std::string conf = folder / "nginx.conf";
  std::string filled = replaced(text.str(), "@ROOT@", folder);
  filled = replaced(std::move(filled), "@ADDRESS@", host);
  std::ofstream(conf) << replaced(std::move(filled), "@PORT@", std::to_string(peer.port));
  const std::vector<std::string> command{"nginx", "-c", conf, "-e", folder / "nginx-error.log"};
  peer.process = std::make_unique<Process>(command, folder / "nginx.out");
  wait_for(*peer.process, "nginx", [&] {
    try {
      ::close(connect_to(peer.port, host));
      return true;
    } catch (const std::runtime_error&) {
      return false;
    }
  });
  return peer;
}

BenchFolder::BenchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "selvage-serve-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

BenchFolder::~BenchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::shared_ptr<const Pack> BenchFolder::add_pack(const std::string& name, std::uint32_t regions,
                                                  std::uint32_t part_size) {
  const auto file = path_ / (name + ".selvage");
  const std::string bytes = as_text(fake_pack_bytes(regions, part_size, name));
  std::ofstream(file, std::ios::binary) << bytes;
  return Pack::open(file).value();
}

std::string hello_bytes() {
  Hello hello;
  hello.software = "serve_bench";
  hello.initial_credit = kMaxCredit;
  return as_text(to_frame(hello, 0));
}

std::string selvage_request(const std::string& name, const std::vector<RegionId>& ids) {
  GetParts get;
  get.model = name;
  get.selection.kind = Selection::Kind::Ids;
  get.selection.ids = ids;
  get.selection.joins = Joins::None;
  return as_text(to_frame(get, 1));
}

std::string http_request(const std::string& name, const Pack& pack, const std::vector<RegionId>& ids) {
  std::string ranges;
  for (RegionId id : ids) {
    const PartRef& part = pack.directory().regions[id].levels[0].part;
    ranges += (ranges.empty() ? "" : ",") + std::to_string(part.offset) + "-" +
              std::to_string(part.offset + part.size - 1);
  }
  return "GET /" + name + ".selvage HTTP/1.1\r\nHost: bench\r\nRange: bytes=" + ranges + "\r\n\r\n";
}

}  // namespace selvage::bench
