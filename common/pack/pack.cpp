// SPDX-License-Identifier: MIT
#include "common/pack/pack.h"

#include <algorithm>
#include <cstring>

#include "common/coding/byte_io.h"

namespace selvage {
namespace {

// As PNG's: a byte above 127, the name, and line ends that a text-mode transfer would damage.
constexpr char kMagic[8] = {'\x89', 'S', 'L', 'V', '\r', '\n', '\x1a', '\n'};

void write_header(ByteWriter& out, const PackHeader& header) {
  out.append(std::as_bytes(std::span(kMagic)));
  out.u16(header.major);
  out.u16(header.minor);
  out.u32(header.summary_size);
  out.u64(header.directory_size);
  out.u64(header.file_size);
  out.append(std::as_bytes(std::span(header.id.bytes)));
  while (out.size() < kPackHeaderSize) out.u8(0);
}

}  // namespace

Result<PackHeader> parse_pack_header(std::span<const std::byte> bytes, std::uint64_t file_size) {
  if (bytes.size() < kPackHeaderSize)
    return fail(ErrorCode::BadStream, "not a selvage pack: too short for a header");
  ByteReader in(bytes.first(kPackHeaderSize));
  const auto magic = in.take(sizeof kMagic);
  if (std::memcmp(magic.data(), kMagic, sizeof kMagic) != 0)
    return fail(ErrorCode::BadStream, "not a selvage pack: wrong magic bytes", 0);
  PackHeader header;
  header.major = in.u16();
  header.minor = in.u16();
  if (header.major > kPackMajorVersion) {
    return fail(ErrorCode::Unsupported, "pack format version " + std::to_string(header.major) + "." +
                                            std::to_string(header.minor) + " is newer than this program's " +
                                            std::to_string(kPackMajorVersion) + "; update selvage");
  }
  header.summary_size = in.u32();
  header.directory_size = in.u64();
  header.file_size = in.u64();
  const auto id = in.take(Hash::kSize);
  std::memcpy(header.id.bytes.data(), id.data(), Hash::kSize);
  if (header.file_size != file_size) {
    return fail(ErrorCode::BadStream, "truncated or padded pack: its header says " +
                                          std::to_string(header.file_size) + " bytes, there are " +
                                          std::to_string(file_size));
  }
  if (header.directory_size > file_size - kPackHeaderSize)
    return fail(ErrorCode::BadStream, "directory reaches past the end of the pack", 16);
  return header;
}

Pack::Pack() = default;
Pack::~Pack() = default;

Result<std::shared_ptr<const Pack>> Pack::open(const std::filesystem::path& path) {
  auto mapped = MappedFile::open(path);
  if (!mapped) return forward_error(mapped);
  std::shared_ptr<Pack> pack(new Pack);
  pack->mapped_ = std::move(*mapped);
  pack->bytes_ = pack->mapped_->bytes();
  if (auto ok = pack->parse(); !ok) return forward_error(ok, path.string());
  return pack;
}

Result<std::shared_ptr<const Pack>> Pack::from_bytes(std::vector<std::byte> bytes) {
  std::shared_ptr<Pack> pack(new Pack);
  pack->owned_ = std::move(bytes);
  pack->bytes_ = pack->owned_;
  if (auto ok = pack->parse(); !ok) return forward_error(ok);
  return pack;
}

Result<void> Pack::parse() {
  auto header = parse_pack_header(bytes_, bytes_.size());
  if (!header) return forward_error(header);
  header_ = *header;
  auto directory = parse_directory(directory_bytes(), header_.summary_size);
  if (!directory) return forward_error(directory);
  directory_ = std::move(*directory);
  if (pack_id(directory_bytes(), header_.summary_size) != header_.id) {
    return fail(ErrorCode::BadStream, "the header's id is not the hash of the summary page", 32);
  }
  const RegionEntry& last = directory_.regions.back();
  if (last.bundle.offset + last.bundle.size != bytes_.size()) {
    return fail(ErrorCode::BadStream, "the parts that the directory lists do not fill the pack");
  }
  return {};
}

std::span<const std::byte> Pack::directory_bytes() const {
  return bytes_.subspan(kPackHeaderSize, header_.directory_size);
}

std::span<const std::byte> Pack::part(const PartRef& ref) const {
  return bytes_.subspan(ref.offset, ref.size);
}

Result<void> check_part(const PartRef& ref, std::span<const std::byte> bytes) {
  if (bytes.size() != ref.size)
    return fail(ErrorCode::BadStream, "part has another size than the directory says");
  if (hash_of(bytes) != ref.hash) return fail(ErrorCode::BadStream, "part does not match its hash");
  return {};
}

std::vector<std::byte> assemble_pack(Directory directory, const std::vector<std::vector<std::byte>>& parts) {
  auto part = parts.begin();
  const auto fill_in = [&](PartRef& ref) {
    ref.size = static_cast<std::uint32_t>(part->size());
    ref.hash = hash_of(*part);
    ++part;
  };
  for (RegionEntry& entry : directory.regions) {
    for (auto level = entry.levels.rbegin(); level != entry.levels.rend(); ++level) {
      if (!level->is_repeat) fill_in(level->part);
    }
    if (entry.bundle_triangles > 0) fill_in(entry.bundle);
  }
  const DirectoryBytes packed = write_directory(directory);
  PackHeader header;
  header.summary_size = packed.summary_size;
  header.directory_size = packed.bytes.size();
  header.file_size = kPackHeaderSize + packed.bytes.size();
  for (const auto& bytes : parts) header.file_size += bytes.size();
  header.id = pack_id(packed.bytes, packed.summary_size);

  ByteWriter out;
  write_header(out, header);
  out.append(packed.bytes);
  for (const auto& bytes : parts) out.append(bytes);
  return std::move(out).take();
}

}  // namespace selvage
