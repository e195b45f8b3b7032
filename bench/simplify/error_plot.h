// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "common/render/image.h"

namespace selvage::bench {

/// One line of a plot of error over resolution, as the dissertation's Fig. 3.16; both axes logarithmic.
struct ErrorCurve {
  std::string name;
  std::vector<double> error;  ///< by resolution; 0 is drawn at the lower edge
};

/// `percents` descend: the finest resolution is on the left.
Image plot_errors(const std::string& title, const std::vector<double>& percents,
                  const std::vector<ErrorCurve>& curves);

}  // namespace selvage::bench
