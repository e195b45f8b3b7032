// SPDX-License-Identifier: MIT
#include "common/render/png.h"

#include <cstdlib>
#include <memory>
#include <string_view>

#include <spng.h>

#include "common/base/replace_file.h"

namespace selvage {

Result<std::vector<std::byte>> encode_png(const Image& image) {
  if (image.width <= 0 || image.height <= 0)
    return fail(ErrorCode::InvalidArgument, "a PNG needs at least one pixel");
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> png(spng_ctx_new(SPNG_CTX_ENCODER),
                                                                spng_ctx_free);
  if (!png) return fail(ErrorCode::LimitExceeded, "out of memory for a PNG");
  spng_set_option(png.get(), SPNG_ENCODE_TO_BUFFER, 1);
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(image.width);
  header.height = static_cast<std::uint32_t>(image.height);
  header.bit_depth = 8;
  header.color_type = SPNG_COLOR_TYPE_TRUECOLOR;
  spng_set_ihdr(png.get(), &header);

  static_assert(sizeof(Rgb) == 3);
  const int failed = spng_encode_image(png.get(), image.pixels.data(), image.pixels.size() * sizeof(Rgb),
                                       SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
  if (failed != 0)
    return fail(ErrorCode::InvalidArgument, std::string("cannot encode a PNG: ") + spng_strerror(failed));
  std::size_t size = 0;
  int error = 0;
  const std::unique_ptr<void, decltype(&std::free)> buffer(spng_get_png_buffer(png.get(), &size, &error),
                                                           std::free);
  if (!buffer)
    return fail(ErrorCode::LimitExceeded, std::string("cannot encode a PNG: ") + spng_strerror(error));
  const auto* bytes = static_cast<const std::byte*>(buffer.get());
  return std::vector<std::byte>(bytes, bytes + size);
}

Result<void> write_png(const std::filesystem::path& path, const Image& image) {
  auto bytes = encode_png(image);
  if (!bytes) return forward_error(bytes, path.string());
  const std::string_view content(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  auto written = replace_file(path, content);
  if (!written) return forward_error(written, path.string());
  return {};
}

}  // namespace selvage
