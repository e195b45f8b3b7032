// SPDX-License-Identifier: MIT
//
// What the codec knows before the first byte: how every model begins, and the weights that predict a vertex
// and the size of its residual. All of it comes from training (bench/train) and is part of the format's
// version: a stream decodes only with the tables that it was coded with.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "common/coding/symbol_models.h"

namespace selvage {

/// Where each kind of symbol finds its models in a region part's bank.
namespace region_model {
inline constexpr unsigned kClersCounts = 10;  ///< triangles around a gate's end: 1, 2 ... 10 and more
inline constexpr unsigned kClers = 0;  ///< + (previous symbol * kClersCounts + tail) * kClersCounts + head
inline constexpr unsigned kMagnitudes = 48;
inline constexpr unsigned kMagnitude =
    kClers + 5 * kClersCounts * kClersCounts;  ///< + (axis * 2 + several) * kMagnitudes + size class
inline constexpr unsigned kFields = kMagnitude + 3 * 2 * kMagnitudes;
enum Field : unsigned {
  kExcess = kFields,  ///< bit lengths: what a residual's magnitude exceeds its largest plain symbol by
  kExtraSymbols,      ///< bit lengths: CLERS symbols beyond the directory's number of triangles
  kHandleCount,       ///< bit lengths, as the next four
  kHandleGap,
  kHandleReach,
  kVirtualCount,
  kVirtualGap,
  kIsClosed,
  kShape,    ///< the region's blends: of the shape correction, ...
  kTrend,    ///< of the neighbours' errors, ...
  kTangent,  ///< and of the tangent plane
  kTurned,   ///< two: after a triangle as it was, after a turned one
  kTurned1,
  kAnchorCount,  ///< bit lengths, as the rest
  kAnchorGap,
  kGroupStep,
  kLooseCount,
  kDigits,  ///< of the decimals that floats are, 0 if they are none
  kPlaces,
  kExact,                  ///< by the symbol before on the same axis where the coordinate came up before, ...
  kExactNew = kExact + 4,  ///< ... and where not
  kAfterExact = kExactNew + 4 - 1,
  kMapLoop,    ///< bit lengths, as the next: which loop of a coarser level, counted from the one expected
  kMapLead,    ///< boundary indices before the first whole run
  kMapRun,     ///< boundary indices that a vertex of a coarser level stands for, less one
  kMapExcess,  ///< bit lengths: what a run exceeds its largest plain symbol by
  kIsListed,   ///< 1 if positions are places in lists of values
  kListCount,  ///< bit lengths, as the next two: values in a list
  kListGap,    ///< between grid coordinates, or ranks of decimals
  kListFloatGap,
  kListSigns,  ///< by axis and what is known of the signs, see SignContext
  kListPick =
      kListSigns + 24,  ///< by which places around are equal, and whether these surroundings are known
  kListStep = kListPick + 2 * 8,  ///< bit lengths, two: without and with a parallelogram
  kCount = kListStep + 2
};
}  // namespace region_model

/// And in a bundle's bank.
namespace bundle_model {
inline constexpr unsigned kRunContexts = 1 + 2 * 4 * 4 * 3;      ///< see JoinRuns
inline constexpr unsigned kStepContexts = kRunContexts * 4 * 3;  ///< see JoinProgress::model_of
inline constexpr unsigned kStep = 0;
enum Field : unsigned {
  kStart = kStep + kStepContexts,
  kHasTurned,
  kTurned,
  kTurned1,
  kSlot,  ///< two: of a start, of a tip
  kSlot1,
  kStartSkip,  ///< bit lengths
  kTipGap,     ///< bit lengths
  kCount
};
}  // namespace bundle_model

/// Corrections of the parallelogram prediction, in 1024ths; see geometry_walk.h for what they weigh.
struct ShapeWeights {
  std::int16_t beyond = 0, ring = 0, trend = 0;
};
inline constexpr unsigned kShapeClasses = 64;
/// No weight is larger, so predictions stay within 2^28 of a grid of 24 bits, whatever a stream claims.
inline constexpr std::int16_t kMostShapeWeight = 1024;

/// The logarithm of a residual's size as a linear function of other logarithms, in 256ths: tangential and
/// normal residuals nearby, spread, reach, recent tangential and normal residuals, a constant, and the
/// residuals of the same vertex that are known already: first axis, second axis.
inline constexpr unsigned kSizeFeatures = 9;
inline constexpr unsigned kCommonSizeFeatures = 7;
using SizeWeights = std::array<std::int16_t, kSizeFeatures>;
inline constexpr unsigned kSizeClasses = 4;  ///< parallelograms: 0, 1, 2, 3 and more

struct CodecTables {
  std::span<const StartModel> region, bundle;
  std::array<ShapeWeights, kShapeClasses> shape;
  std::array<std::array<SizeWeights, 3>, kSizeClasses> size;  ///< by size class and axis
};

/// A model as training writes it: probabilities as levels, each 2^(-level / 12) of the whole before
/// normalisation.
struct PackedModel {
  std::array<std::uint8_t, kSymbols> levels;
  std::uint8_t uses, uses_limit;
};
/// Integer arithmetic: the same on every machine. Every symbol gets a share, at least 2^-15.
StartModel unpack(const PackedModel& packed);

/// The tables of this format version.
const CodecTables& shipped_tables();
/// A region model as the tables spell it, for training to keep what it does not see.
std::string_view shipped_region_text(unsigned model);

}  // namespace selvage
