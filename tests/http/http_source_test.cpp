// SPDX-License-Identifier: MIT
//
// The client against web servers in good order and in none.
#include "client/http/http_source.h"

#include <atomic>
#include <map>

#include <gtest/gtest.h>

#include "client/fetch/fetch_parts.h"
#include "tests/http/fake_web_server.h"
#include "tests/support/fake_pack.h"

namespace selvage {
namespace {

using testing::FakeWebServer;
using testing::partial_content;
using testing::WebRequest;

constexpr auto ignore_part = [](ReceivedPart) { return Result<void>(); };

GetRequest request(std::shared_ptr<const Manifest> manifest, std::vector<RegionId> ids = {}) {
  GetRequest made{std::move(manifest), {}};
  if (!ids.empty()) made.selection.kind = Selection::Kind::Ids;
  made.selection.ids = std::move(ids);
  return made;
}

TEST(HttpSource, FetchesTheBytesOfThePack) {
  const Bytes file = fake_pack_bytes(400, 3000);
  const FakeWebServer server([&](const WebRequest& asked) { return partial_content(file, asked); });
  HttpSource source(server.url());
  const auto manifest = source.open();
  ASSERT_TRUE(manifest) << manifest.error().message;
  EXPECT_EQ((*manifest)->name, "row");
  const auto pack = Pack::from_bytes(file).value();
  std::map<PartId, std::vector<std::byte>> parts;
  const auto stats = source.get(request(*manifest), [&](ReceivedPart part) -> Result<void> {
    parts[part.id] = std::move(part.bytes);
    return {};
  });
  ASSERT_TRUE(stats) << stats.error().message;
  EXPECT_EQ(stats->parts, 799u);
  EXPECT_EQ(parts.size(), 799u);
  for (const auto& [id, bytes] : parts)
    EXPECT_TRUE(std::ranges::equal(bytes, pack->part(*pack->directory().find(id))));
  EXPECT_LT(server.requests(), 8) << "neighbours are to come together";
  EXPECT_LT(server.bytes_sent(), file.size() + (80u << 10));
}

TEST(HttpSource, FetchesLittleMoreThanWhatWasAskedFor) {
  const Bytes file = fake_pack_bytes(100, 50'000);
  const FakeWebServer server([&](const WebRequest& asked) { return partial_content(file, asked); });
  HttpSource source(server.url());
  const auto manifest = source.open();
  ASSERT_TRUE(manifest);
  const auto stats = source.get(request(*manifest, {3, 50, 51, 99}), ignore_part);
  ASSERT_TRUE(stats) << stats.error().message;
  EXPECT_EQ(stats->parts, 5u);  // and the bundle between 50 and 51
  EXPECT_LT(server.bytes_sent(), (64u << 10) + 4 * 50'000 + 20'000);
  EXPECT_EQ(server.requests(), 1 + 3);
}

TEST(HttpSource, ADirectoryLargerThanTheFirstRead) {
  const Bytes file = fake_pack_bytes(5000, 10);
  const FakeWebServer server([&](const WebRequest& asked) { return partial_content(file, asked); });
  HttpSource source(server.url());
  const auto manifest = source.open();
  ASSERT_TRUE(manifest) << manifest.error().message;
  EXPECT_EQ((*manifest)->directory.real_region_count(), 5000u);
  EXPECT_EQ(server.requests(), 2);
}

TEST(HttpSource, DoesNotReadOnWhileNobodyDecodes) {
  const Bytes file = fake_pack_bytes(100, 50'000);
  const FakeWebServer server([&](const WebRequest& asked) { return partial_content(file, asked); });
  HttpOptions options;
  options.window_bytes = 100'000;
  HttpSource source(server.url(), options);
  const auto manifest = source.open();
  ASSERT_TRUE(manifest);
  std::vector<ReceivedPart> kept;
  std::atomic<std::uint64_t> held = 0;
  std::stop_source stop;
  const std::jthread watcher([&] {
    while (held <= options.window_bytes) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));  // in which nothing more is to come
    stop.request_stop();
  });
  const auto stats = source.get(
      request(*manifest),
      [&](ReceivedPart part) -> Result<void> {
        held += part.bytes.size();
        kept.push_back(std::move(part));
        return {};
      },
      stop.get_token());
  EXPECT_EQ(stats.error().code, ErrorCode::Cancelled);
  EXPECT_LE(held, 200'000u);
}

TEST(HttpSource, TakesUpABrokenAnswerWhereItEnded) {
  const Bytes file = fake_pack_bytes(3, 400'000);
  const FakeWebServer server([&](const WebRequest& asked) {
    const std::string whole = partial_content(file, asked);
    return asked.number == 0 ? whole : whole.substr(0, 150'000);
  });
  HttpSource source(server.url());
  const auto manifest = source.open();
  ASSERT_TRUE(manifest);
  FetchPartsOptions options;
  options.retry.first_delay = options.retry.longest_delay = std::chrono::milliseconds(1);
  const auto stats = fetch_parts(source, request(*manifest), ignore_part, options);
  ASSERT_TRUE(stats) << stats.error().message;
  EXPECT_EQ(stats->parts, 5u);
  EXPECT_GT(stats->retries, 4u);
  // A part never fits into one answer: without taking up it would never come.
}

// ---- web servers that cannot be used
// -------------------------------------------------------------------------

struct Refused {
  ErrorCode code;
  std::string message;
  std::uint64_t bytes_sent;
};

/// What comes of opening, and getting everything, when the server answers `second` to all but the first
/// request.
Refused refused(const std::function<std::string(const WebRequest&, const Bytes&)>& second,
                bool from_the_first = false) {
  static const Bytes file = fake_pack_bytes(20, 100'000);
  const FakeWebServer server([&](const WebRequest& asked) {
    return asked.number == 0 && !from_the_first ? partial_content(file, asked) : second(asked, file);
  });
  HttpOptions options;
  options.silence_timeout = std::chrono::milliseconds(1000);
  HttpSource source(server.url(), options);
  const auto manifest = source.open();
  if (!manifest) return {manifest.error().code, manifest.error().message, server.bytes_sent()};
  EXPECT_FALSE(from_the_first) << "opened";
  const auto stats = source.get(request(*manifest), ignore_part);
  if (stats) return {};
  return {stats.error().code, stats.error().message, server.bytes_sent()};
}

std::string text_of(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(BadWebServer, SendsTheWholeFileInstead) {
  const auto whole = [](const WebRequest&, const Bytes& file) {
    return "HTTP/1.1 200 OK\r\nContent-Length: 100000000\r\n\r\n" + text_of(file) +
           std::string(50 << 20, 'x');
  };
  const Refused outcome = refused(whole, true);
  EXPECT_EQ(outcome.code, ErrorCode::Unsupported);
  EXPECT_NE(outcome.message.find("200"), std::string::npos);
  EXPECT_LT(outcome.bytes_sent, 20u << 20) << "the client reads on";
}

TEST(BadWebServer, HasAnotherFileByNow) {
  // As a server in good order does it: If-Range does not match, so all of the new file.
  EXPECT_EQ(refused([](const WebRequest& asked, const Bytes& file) {
              EXPECT_EQ(asked.header("If-Range"), "\"one\"");
              return "HTTP/1.1 200 OK\r\nETag: \"two\"\r\n\r\n" + text_of(file);
            }).code,
            ErrorCode::ModelChanged);
  // As one does it that ignores If-Range.
  EXPECT_EQ(refused([](const WebRequest& asked, const Bytes& file) {
              return partial_content(file, asked, "ETag: \"two\"\r\n");
            }).code,
            ErrorCode::ModelChanged);
  EXPECT_EQ(refused([](const WebRequest& asked, const Bytes& file) {
              Bytes longer = file;
              longer.resize(file.size() + 1);
              return partial_content(longer, asked);
            }).code,
            ErrorCode::ModelChanged);
}

TEST(BadWebServer, SendsOtherBytes) {
  EXPECT_EQ(refused([](const WebRequest& asked, Bytes file) {
              for (std::byte& byte : file) byte ^= std::byte{1};
              return partial_content(file, asked);
            }).code,
            ErrorCode::BadStream);
}

TEST(BadWebServer, SendsAnotherRange) {
  const auto with_range = [](const std::string& range) {
    return [range](const WebRequest& asked, const Bytes& file) {
      std::string answer = partial_content(file, asked);
      const std::size_t at = answer.find("bytes "), end = answer.find("\r\n", at);
      return answer.replace(at, end - at, range);
    };
  };
  for (const char* range :
       {"bytes 0-5/2000000", "bytes */2000000", "bytes 18446744073709551615-0/1", "bytes", "bytes 5-4/10",
        "bytes 0-99999999999999999999/5", "bytes 0-5/*", "octets 1-2/3"}) {
    EXPECT_EQ(refused(with_range(range), true).code, ErrorCode::BadStream) << range;
    EXPECT_EQ(refused(with_range(range)).code, ErrorCode::BadStream) << range;
  }
}

TEST(BadWebServer, SendsMoreThanTheRange) {
  const Refused outcome = refused(
      [](const WebRequest& asked, const Bytes& file) {
        std::string answer = partial_content(file, asked);
        const std::size_t at = answer.find("Content-Length"), end = answer.find("\r\n", at);
        return answer.erase(at, end + 2 - at) + std::string(50 << 20, 'x');
      },
      true);
  EXPECT_EQ(outcome.code, ErrorCode::BadStream);
  EXPECT_LT(outcome.bytes_sent, 20u << 20);
}

TEST(BadWebServer, SendsHeadersWithoutEnd) {
  const Refused outcome = refused(
      [](const WebRequest&, const Bytes&) {
        std::string answer = "HTTP/1.1 206 Partial Content\r\n";
        for (int i = 0; i < 100'000; ++i)
          answer += "X-" + std::to_string(i) + ": " + std::string(200, 'y') + "\r\n";
        return answer;
      },
      true);
  EXPECT_EQ(outcome.code, ErrorCode::BadStream);
  EXPECT_LT(outcome.bytes_sent, 10u << 20);
}

TEST(BadWebServer, EncodesTheFile) {
  EXPECT_EQ(
      refused([](const WebRequest& asked,
                 const Bytes& file) { return partial_content(file, asked, "Content-Encoding: gzip\r\n"); },
              true)
          .code,
      ErrorCode::Unsupported);
}

TEST(BadWebServer, SaysNo) {
  const auto status = [](const char* line) {
    return [line](const WebRequest&, const Bytes&) {
      return "HTTP/1.1 " + std::string(line) + "\r\nContent-Length: 3\r\n\r\nno\n";
    };
  };
  EXPECT_EQ(refused(status("404 Not Found"), true).code, ErrorCode::NotFound);
  EXPECT_EQ(refused(status("403 Forbidden"), true).code, ErrorCode::Unauthorised);
  EXPECT_EQ(refused(status("503 Service Unavailable")).code, ErrorCode::Unavailable);
  EXPECT_EQ(refused(status("416 Range Not Satisfiable")).code, ErrorCode::BadStream);
  EXPECT_EQ(refused(status("304 Not Modified")).code, ErrorCode::Unsupported);
  EXPECT_EQ(refused(status("999 Whatever"), true).code, ErrorCode::Unavailable);
}

TEST(BadWebServer, IsNone) {
  for (const char* babble :
       {"", "SSH-2.0-OpenSSH_9.2\r\n", "HTTP/1.1 \r\n\r\n", "\r\n\r\n", "HTTP/1.1 206"}) {
    const Refused outcome =
        refused([&](const WebRequest&, const Bytes&) { return std::string(babble); }, true);
    EXPECT_NE(outcome.code, ErrorCode{}) << babble;
    EXPECT_FALSE(outcome.message.empty());
  }
}

TEST(BadWebServer, ServesSomethingElse) {
  const Refused outcome =
      refused([](const WebRequest& asked,
                 const Bytes&) { return partial_content(Bytes(1000, std::byte{'<'}), asked); },
              true);
  EXPECT_EQ(outcome.code, ErrorCode::BadStream);
  EXPECT_NE(outcome.message.find("not a selvage pack"), std::string::npos);
}

TEST(BadWebServer, RedirectsInCircles) {
  const auto circle = [](const WebRequest&, const Bytes&) {
    return std::string("HTTP/1.1 302 Found\r\nLocation: /again\r\nContent-Length: 0\r\n\r\n");
  };
  EXPECT_EQ(refused(circle, true).code, ErrorCode::Unsupported);
}

TEST(BadWebServer, RedirectsToAFile) {
  const auto leak = [](const WebRequest&, const Bytes&) {
    return std::string("HTTP/1.1 302 Found\r\nLocation: file:///etc/passwd\r\nContent-Length: 0\r\n\r\n");
  };
  EXPECT_EQ(refused(leak, true).code, ErrorCode::InvalidArgument);
}

TEST(BadWebServer, ClaimsAnEndlessDirectory) {
  const Refused outcome = refused(
      [](const WebRequest& asked, Bytes file) {
        for (std::size_t i = 16; i < 23; ++i) file[i] = std::byte{0xFF};
        for (std::size_t i = 24; i < 31; ++i) file[i] = std::byte{0xFF};
        std::string answer = partial_content(file, asked);
        const std::size_t slash = answer.find('/', answer.find("bytes ")), end = answer.find("\r\n", slash);
        return answer.replace(slash, end - slash, "/72057594037927935");
      },
      true);
  EXPECT_TRUE(outcome.code == ErrorCode::LimitExceeded || outcome.code == ErrorCode::BadStream);
  EXPECT_LT(outcome.bytes_sent, 1u << 20);
}

TEST(HttpSource, FollowsARedirection) {
  const Bytes file = fake_pack_bytes(5, 1000);
  const FakeWebServer server([&](const WebRequest& asked) {
    const bool is_there = asked.text.starts_with("GET /there");
    return is_there ? partial_content(file, asked)
                    : std::string("HTTP/1.1 301 Moved\r\nLocation: /there\r\nContent-Length: 0\r\n\r\n");
  });
  HttpSource source(server.url());
  const auto manifest = source.open();
  ASSERT_TRUE(manifest) << manifest.error().message;
  EXPECT_TRUE(source.get(request(*manifest), ignore_part));
}

TEST(HttpSource, NobodyListening) {
  std::string url;
  {
    const FakeWebServer server([](const WebRequest&) { return std::string(); });
    url = server.url();
  }
  HttpSource source(url);
  const auto manifest = source.open();
  ASSERT_FALSE(manifest);
  EXPECT_EQ(manifest.error().code, ErrorCode::Unavailable);
}

}  // namespace
}  // namespace selvage
