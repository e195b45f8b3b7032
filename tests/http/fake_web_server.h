// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/coding/byte_io.h"

namespace selvage::testing {

/// What a test's web server is asked for.
struct WebRequest {
  int number = 0;  ///< of the request, over all connections, from 0
  std::string text;
  std::uint64_t first = 0, last = 0;  ///< of its Range

  std::optional<std::string> header(const std::string& name) const {
    const std::size_t at = text.find("\r\n" + name + ": ");
    if (at == std::string::npos) return std::nullopt;
    const std::size_t begin = at + name.size() + 4;
    return text.substr(begin, text.find("\r\n", begin) - begin);
  }
};

/// Says on loopback whatever the test wants it to: the answer's bytes, headers and all. The connection is
/// closed after an answer, and when it is empty.
class FakeWebServer {
 public:
  using Answer = std::function<std::string(const WebRequest&)>;

  explicit FakeWebServer(Answer answer) : answer_(std::move(answer)) {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ::bind(listener_, reinterpret_cast<sockaddr*>(&address), size);
    ::listen(listener_, 64);
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::jthread([this](const std::stop_token& stop) { accept_all(stop); });
  }
  ~FakeWebServer() {
    thread_.request_stop();
    thread_.join();
    ::close(listener_);
  }

  std::string url(const std::string& path = "/models/row.selvage") const {
    return "http://127.0.0.1:" + std::to_string(port_) + path;
  }
  int requests() const { return requests_; }
  /// Bytes that clients took before they hung up, or that the answers held.
  std::uint64_t bytes_sent() const { return bytes_sent_; }

 private:
  void accept_all(const std::stop_token& stop) {
    std::vector<std::jthread> connections;
    while (!stop.stop_requested()) {
      pollfd ready{listener_, POLLIN, 0};
      if (::poll(&ready, 1, 20) <= 0) continue;
      const int socket = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
      if (socket >= 0) connections.emplace_back([this, socket] { serve(socket); });
    }
  }

  void serve(int socket) {
    WebRequest request;
    char buffer[4096];
    while (request.text.find("\r\n\r\n") == std::string::npos) {
      const ssize_t count = ::recv(socket, buffer, sizeof buffer, 0);
      if (count <= 0) break;
      request.text.append(buffer, static_cast<std::size_t>(count));
    }
    request.number = requests_++;
    if (const auto range = request.header("Range"))
      std::sscanf(range->c_str(), "bytes=%lu-%lu", &request.first, &request.last);
    const std::string answer = answer_(request);
    for (std::size_t at = 0; at < answer.size();) {
      const ssize_t count = ::send(socket, answer.data() + at, answer.size() - at, MSG_NOSIGNAL);
      if (count <= 0) break;
      at += static_cast<std::size_t>(count);
      bytes_sent_ += static_cast<std::uint64_t>(count);
    }
    ::shutdown(socket, SHUT_RDWR);
    ::close(socket);
  }

  Answer answer_;
  int listener_ = -1;
  int port_ = 0;
  std::atomic<int> requests_ = 0;
  std::atomic<std::uint64_t> bytes_sent_ = 0;
  std::jthread thread_;
};

/// The answer of a web server in good order.
inline std::string partial_content(const Bytes& file, const WebRequest& request,
                                   const std::string& headers = "ETag: \"one\"\r\n") {
  const std::uint64_t last = std::min<std::uint64_t>(request.last, file.size() - 1);
  const std::uint64_t size = last - request.first + 1;
  return "HTTP/1.1 206 Partial Content\r\nConnection: close\r\nContent-Length: " + std::to_string(size) +
         "\r\nContent-Range: bytes " + std::to_string(request.first) + "-" + std::to_string(last) + "/" +
         std::to_string(file.size()) + "\r\n" + headers + "\r\n" +
         std::string(reinterpret_cast<const char*>(file.data()) + request.first, size);
}

}  // namespace selvage::testing
