// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace selvage {

/// How a published mesh is to be cut into regions and levels of detail: what `selvage-pack build` is told by
/// options, as far as it needs no second file. server/publish turns it into the options of ingest.
struct PublishCut {
  enum class By : std::uint32_t { Shape, Groups, Components };
  enum class Mode : std::uint32_t { Xmrg, Classic, Zhang, ManganWhitaker, Cad };
  static constexpr std::uint32_t kLastBy = 2, kLastMode = 4;

  By by = By::Shape;
  Mode mode = Mode::Xmrg;
  std::uint32_t regions = 0;     ///< so many; 0: as many as the shape has, or streaming wants
  std::uint32_t min_region = 0;  ///< vertices; 0: the usual bound
  std::uint32_t max_region = 0;  ///< the same
  bool smooth = false;           ///< the borders between regions

  std::uint32_t levels = 2;          ///< of detail, the finest included ...
  std::vector<double> level_ratios;  ///< ... or, of those beside the finest, shares of the triangles ...
  std::vector<double> level_errors;  ///< ... or errors in model units; one of the two lists is empty

  friend bool operator==(const PublishCut&, const PublishCut&) = default;
};

}  // namespace selvage
