// SPDX-License-Identifier: MIT
//
// The same against nginx, which tests/packages.txt lists: a server of our own, on a free port, with its
// configuration and everything that it writes in a temporary folder.
#include <csignal>
#include <cstring>
#include <fstream>
#include <thread>

#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "client/fetch/fetch_parts.h"
#include "client/http/http_source.h"
#include "tests/support/fake_pack.h"
#include "tests/support/temp_folder.h"

namespace selvage {
namespace {

/// A port that nobody listened on a moment ago.
int free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ::bind(socket, reinterpret_cast<sockaddr*>(&address), size);
  ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  ::close(socket);
  return ntohs(address.sin_port);
}

class Nginx {
 public:
  Nginx() {
    for (int attempt = 0; attempt < 20 && !is_up(); ++attempt) start();
  }
  ~Nginx() { stop(); }

  bool is_up() const {
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port_));
    const bool ok = pid_ > 0 && ::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    ::close(socket);
    return ok && ::waitpid(pid_, nullptr, WNOHANG) == 0;
  }

  const TempFolder& folder() const { return folder_; }
  std::string url(const std::string& file) const {
    return "http://127.0.0.1:" + std::to_string(port_) + "/" + file;
  }
  std::string log() const {
    std::ifstream file(folder_.path() / "error.log");
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  void start() {
    stop();
    port_ = free_port();
    const std::string at = folder_.path().string();
    std::ofstream(folder_.path() / "nginx.conf")
        << "daemon off; master_process off; pid " << at << "/pid; error_log " << at << "/error.log;\n"
        << "events {}\nhttp { access_log off; client_body_temp_path " << at << "/a; proxy_temp_path " << at
        << "/b; fastcgi_temp_path " << at << "/c; uwsgi_temp_path " << at << "/d; scgi_temp_path " << at
        << "/e;\nserver { listen 127.0.0.1:" << port_ << "; root " << at << ";\n"
        << "location /whole/ { alias " << at << "/; max_ranges 0; } } }\n";
    pid_ = ::fork();
    if (pid_ == 0) {
      const int null = ::open("/dev/null", O_RDWR);
      ::dup2(null, 1);
      ::dup2(null, 2);
      const std::string config = at + "/nginx.conf";
      for (const char* program : {"nginx", "/usr/sbin/nginx"})
        ::execlp(program, "nginx", "-p", at.c_str(), "-c", config.c_str(), "-e", (at + "/error.log").c_str(),
                 nullptr);
      ::_exit(127);
    }
    for (int i = 0; i < 250 && !is_up(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }

  void stop() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
    pid_ = 0;
  }

  TempFolder folder_;
  int port_ = 0;
  pid_t pid_ = 0;
};

class NginxTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ::setenv("no_proxy", "*", 1);
    ASSERT_TRUE(nginx_.is_up()) << "nginx does not run (./run setup installs it): " << nginx_.log();
    nginx_.folder().put("row.selvage", bytes_);
  }

  Nginx nginx_;
  const Bytes bytes_ = fake_pack_bytes(300, 20'000);
};

TEST_F(NginxTest, FetchesEverythingAndSomeRegions) {
  HttpSource source(nginx_.url("row.selvage"));
  const auto manifest = source.open();
  ASSERT_TRUE(manifest) << manifest.error().message;
  const auto pack = Pack::from_bytes(bytes_).value();
  EXPECT_EQ((*manifest)->pack_id, pack->id());
  for (const Selection& selection :
       {Selection{}, Selection{.kind = Selection::Kind::Ids, .ids = {3, 4, 150, 300}}}) {
    std::size_t right = 0;
    const auto stats = source.get({*manifest, selection}, [&](ReceivedPart part) -> Result<void> {
      right += std::ranges::equal(part.bytes, pack->part(*pack->directory().find(part.id)));
      return {};
    });
    ASSERT_TRUE(stats) << stats.error().message;
    EXPECT_EQ(right, select_parts(pack->directory(), selection)->size());
  }
}

TEST_F(NginxTest, NoticesThatTheFileWasReplaced) {
  HttpSource source(nginx_.url("row.selvage"));
  const auto manifest = source.open();
  ASSERT_TRUE(manifest);
  nginx_.folder().put("row.selvage", fake_pack_bytes(300, 20'001));
  const auto stats = source.get({*manifest, {}}, [](ReceivedPart) { return Result<void>(); });
  ASSERT_FALSE(stats);
  EXPECT_EQ(stats.error().code, ErrorCode::ModelChanged) << stats.error().message;
}

TEST_F(NginxTest, IsRefusedWhereItServesNoRanges) {
  const auto manifest = HttpSource(nginx_.url("whole/row.selvage")).open();
  ASSERT_FALSE(manifest);
  EXPECT_EQ(manifest.error().code, ErrorCode::Unsupported) << manifest.error().message;
}

TEST_F(NginxTest, SaysWhenThereIsNoSuchFile) {
  EXPECT_EQ(HttpSource(nginx_.url("other.selvage")).open().error().code, ErrorCode::NotFound);
}

}  // namespace
}  // namespace selvage
