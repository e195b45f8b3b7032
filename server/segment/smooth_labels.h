// SPDX-License-Identifier: MIT
//
// Smooths the borders between regions (the dissertation's future work) without moving them out of concave
// creases.
#pragma once

#include <span>

#include "server/segment/minima.h"
#include "server/segment/neighbours.h"

namespace selvage {

/// Two rounds. In each, the vertices within three edges of a border hold a share for each of their labels
/// (the four greatest are kept) and average three times with their neighbours,
///   share <- share_v + sum_w g_vw share_w / sum_w g_vw,   g = 1 / (1 + c / 0.1),   c = max(0, -(kappa_v +
///   kappa_w) / 2),
/// then take the label with the greatest share, the lower of equal ones. Small effect: boundary triangles -3
/// %.
void smooth_labels(const Neighbours& neighbours, std::span<const float> kappa, Minima& labels);

}  // namespace selvage
