// SPDX-License-Identifier: MIT
//
// TCP over loopback: what is copied and what is handed over page by page arrive as one stream.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "common/net/tcp_stream.h"
#include "common/pack/mapped_file.h"
#include "tests/support/temp_folder.h"

namespace selvage {
namespace {

using asio::ip::tcp;
/// Both ends of a connection over loopback.
struct Ends {
  std::unique_ptr<ByteStream> here, there;
};

Ends connected(asio::io_context& io) {
  tcp::acceptor acceptor(io, tcp::endpoint(asio::ip::address_v4::loopback(), 0));
  tcp::socket near(io);
  near.connect(acceptor.local_endpoint());
  Ends ends;
  ends.here = make_tcp_stream(std::move(near));
  ends.there = make_tcp_stream(acceptor.accept());
  return ends;
}

std::vector<std::byte> random_bytes(std::size_t size) {
  std::mt19937_64 random(size);
  std::vector<std::byte> bytes(size);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
  return bytes;
}

std::unique_ptr<MappedFile> mapped(const TempFolder& folder, std::span<const std::byte> bytes) {
  folder.put("file", bytes);
  return std::move(*MappedFile::open(folder.path() / "file"));
}

/// Until the other side ends; a few bytes at a time first, so that the writer must wait.
asio::awaitable<void> read_all(ByteStream& stream, std::vector<std::byte>& into) {
  std::vector<std::byte> room(100);
  for (;;) {
    const Result<std::size_t> got = co_await stream.read_some(room);
    if (!got || *got == 0) co_return;
    into.insert(into.end(), room.begin(), room.begin() + static_cast<std::ptrdiff_t>(*got));
    if (into.size() > 100'000) room.resize(70'000);
  }
}

asio::awaitable<void> write_all(ByteStream& stream, const Pieces& pieces, Result<void>& written) {
  written = co_await stream.write(pieces);
  stream.close();
}

/// What the other end gets.
std::vector<std::byte> carry(const Pieces& pieces) {
  asio::io_context io;
  const Ends ends = connected(io);
  std::vector<std::byte> received;
  Result<void> written = fail(ErrorCode::Cancelled, "not written");
  asio::co_spawn(io, read_all(*ends.there, received), asio::detached);
  asio::co_spawn(io, write_all(*ends.here, pieces, written), asio::detached);
  io.run();
  EXPECT_TRUE(written) << written.error().message;
  return received;
}

TEST(TcpStream, SendsPiecesInOrderWhereverTheyLie) {
  const TempFolder folder;
  const std::vector<std::byte> small = random_bytes(77);
  const auto file = mapped(folder, random_bytes((5u << 20) + 4321));
  Pieces pieces;
  pieces.emplace_back(small);
  pieces.emplace_back(file->bytes().subspan(3, 3u << 20), true);
  pieces.emplace_back(small);
  pieces.emplace_back(file->bytes().subspan(100, 900), true);  // too little to be worth handing over
  pieces.emplace_back(file->bytes().subspan(5000, 0), true);
  pieces.emplace_back(file->bytes().last(1'000'001), true);
  pieces.emplace_back(file->bytes().first(40'000), true);
  std::vector<std::byte> expected;
  for (const Piece& piece : pieces) expected.insert(expected.end(), piece.bytes.begin(), piece.bytes.end());
  const std::vector<std::byte> received = carry(pieces);
  EXPECT_TRUE(received == expected) << received.size() << " bytes for " << expected.size();
}

TEST(TcpStream, FailsWhenThePeerHasLeft) {
  const TempFolder folder;
  const auto file = mapped(folder, random_bytes(16u << 20));
  asio::io_context io;
  const Ends ends = connected(io);
  ends.there->close();
  Result<void> written;
  const Pieces pieces(4, Piece(file->bytes(), true));
  asio::co_spawn(io, write_all(*ends.here, pieces, written), asio::detached);
  io.run();
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::Io);
}

TEST(TcpStream, SendsZerosForWhatAFileHasNoMore) {
  survive_truncated_files();
  const TempFolder folder;
  const std::vector<std::byte> bytes = random_bytes(1u << 20);
  const auto file = mapped(folder, bytes);
  constexpr std::size_t kKept = 73 * 4096;
  std::filesystem::resize_file(folder.path() / "file", kKept);
  // Some of it is copied, before and between what is handed over.
  Pieces pieces(1, Piece(file->bytes().last(5000), true));
  pieces.emplace_back(file->bytes(), true);
  pieces.emplace_back(file->bytes().last(1000), true);
  const std::vector<std::byte> received = carry(pieces);
  EXPECT_TRUE(file->is_damaged());
  std::vector<std::byte> expected(5000);
  expected.insert(expected.end(), bytes.begin(), bytes.begin() + kKept);
  expected.resize(5000 + bytes.size() + 1000);
  EXPECT_TRUE(received == expected) << received.size() << " bytes";
}

TEST(TcpStream, WritesAtOnceWhatGoesWithoutWaiting) {
  asio::io_context io;
  const Ends ends = connected(io);
  const std::vector<std::byte> bytes = random_bytes(20u << 20);  // more than the kernel takes
  ASSERT_TRUE(ends.here->may_write_at_once());
  const std::size_t written = ends.here->write_at_once(Pieces(1, bytes));
  EXPECT_GT(written, 0u);
  ASSERT_LT(written, bytes.size());
  EXPECT_EQ(ends.here->write_at_once(Pieces(1, bytes)), 0u);

  std::vector<std::byte> received;
  Result<void> rest_written;
  const Pieces rest(1, Piece(std::span(bytes).subspan(written)));
  asio::co_spawn(io, read_all(*ends.there, received), asio::detached);
  asio::co_spawn(io, write_all(*ends.here, rest, rest_written), asio::detached);
  io.run();
  EXPECT_TRUE(received == bytes) << received.size() << " bytes";
}

TEST(TcpStream, WritesNothingAtOnceWhereThePeerHasLeft) {
  asio::io_context io;
  const Ends ends = connected(io);
  ends.here->close();
  EXPECT_FALSE(ends.here->may_write_at_once());
}

}  // namespace
}  // namespace selvage
