// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "common/codec/connectivity.h"
#include "common/coding/entropy_encoder.h"
#include "common/mesh/corner_table.h"

namespace selvage {

struct EncodedConnectivity {
  FanTable table;                          ///< as the decoder will have it
  std::vector<CornerId> source_of_corner;  ///< corner of the given table, by 3 * triangle + place in `table`
};

/// Edgebreaker [Ros99; dissertation Table 5.2] with its own stack. The longest boundary loop of each
/// component is visited before the start and costs nothing; others are closed by virtual vertices; a
/// component without a loop starts from a triangle; handles become HandleSplits. Mirror:
/// client/decode/connectivity_decoder.h.
EncodedConnectivity encode_connectivity(const CornerTable& table, EntropyEncoder& out);

}  // namespace selvage
