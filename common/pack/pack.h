// SPDX-License-Identifier: MIT
//
// One encoded model as an immutable file: header, directory, parts (docs/FORMAT.md). Bytes only: nothing here
// knows what a part means. Offsets are those of the file, so any static web server can serve parts by Range.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "common/pack/directory.h"
#include "common/pack/mapped_file.h"

namespace selvage {

inline constexpr std::size_t kPackHeaderSize = 64;
inline constexpr std::uint16_t kPackMajorVersion = 1;
inline constexpr std::uint16_t kPackMinorVersion = 0;

/// What the fixed header at the front of every pack says.
struct PackHeader {
  std::uint16_t major = kPackMajorVersion, minor = kPackMinorVersion;
  std::uint32_t summary_size = 0;
  std::uint64_t directory_size = 0;
  std::uint64_t file_size = 0;
  Hash id;
};

/// Reads the header from the first bytes of a file of `file_size` bytes. Unsupported (newer major version),
/// BadStream.
Result<PackHeader> parse_pack_header(std::span<const std::byte> front, std::uint64_t file_size);

/// A mapped pack. Thread-safe: everything is const. Shared, so that a pack replaced in the store keeps
/// serving the sessions that already opened it.
class Pack {
 public:
  /// Maps the file and parses header and directory; parts are not touched. Errors name the file: NotFound,
  /// Io, Unsupported (newer major version), BadStream (anything malformed or truncated).
  static Result<std::shared_ptr<const Pack>> open(const std::filesystem::path& path);
  /// The same over bytes in memory, which it keeps.
  static Result<std::shared_ptr<const Pack>> from_bytes(std::vector<std::byte> bytes);
  ~Pack();
  Pack(const Pack&) = delete;
  Pack& operator=(const Pack&) = delete;

  const Hash& id() const { return header_.id; }
  const PackHeader& header() const { return header_; }
  const Directory& directory() const { return directory_; }
  std::span<const std::byte> directory_bytes() const;  ///< what the wire sends as the manifest
  std::span<const std::byte> bytes() const { return bytes_; }
  /// bytes() are a mapped file's, not memory that is freed one day.
  bool is_mapped() const { return mapped_ != nullptr; }
  /// Somebody wrote into the file, or cut it short: what bytes() gives is not the pack that was opened. Seen
  /// at the latest when a missing byte was read (survive_truncated_files), or by whoever says so.
  bool is_damaged() const { return mapped_ && mapped_->is_damaged(); }
  void mark_damaged() const {
    if (mapped_) mapped_->mark_damaged();
  }
  /// `ref` must come from this pack's directory. Not checked against its hash: see check_part.
  std::span<const std::byte> part(const PartRef& ref) const;

 private:
  Pack();
  Result<void> parse();

  std::unique_ptr<MappedFile> mapped_;
  std::vector<std::byte> owned_;
  std::span<const std::byte> bytes_;
  PackHeader header_;
  Directory directory_;
};

/// BadStream if the bytes are not the part that `ref` promises (size or hash).
Result<void> check_part(const PartRef& ref, std::span<const std::byte> bytes);

/// Lays out a whole pack. `parts` are in the order of write_directory: for every region its levels coarsest
/// first, those that repeat another left out, then its bundle if it has one. Sizes and hashes in `directory`
/// are filled in from them.
std::vector<std::byte> assemble_pack(Directory directory, const std::vector<std::vector<std::byte>>& parts);

}  // namespace selvage
