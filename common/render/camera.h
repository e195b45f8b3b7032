// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "common/mesh/vec3.h"

namespace selvage {

enum class UpAxis { Y, Z };
enum class Projection { Perspective, Orthographic };

/// Where to look from, said as one walks around a model. Azimuth 0 sees the front with +x to the right: from
/// +z if y is up, from -y if z is up. Azimuth grows to the right, elevation upwards.
struct View {
  double azimuth_degrees = 30;
  double elevation_degrees = 20;
  UpAxis up = UpAxis::Y;
  Projection projection = Projection::Perspective;
};

/// A point on the picture in pixels from the top left. Larger `nearness` hides smaller; it is linear in x and
/// y.
struct Projected {
  double x = 0, y = 0, nearness = 0;
};

/// Maps model units to the picture. A value: pictures of parts of a model taken with the camera of the whole
/// stay in register.
struct Camera {
  int width = 960, height = 720;                    ///< of the picture, in pixels
  Vec3 target;                                      ///< what is looked at
  Vec3 right{1, 0, 0}, up{0, 1, 0}, back{0, 0, 1};  ///< the picture's axes; `back` points to the eye
  double distance = 0;                              ///< from target to the eye; 0 for a parallel projection
  double scale = 1;                                 ///< pixels per model unit at the target
  double centre_x = 480, centre_y = 360;            ///< where the target appears

  Projected project(const Vec3& p) const;
};

/// A camera that shows all of `positions` as large as fits in the picture, less a margin (a share of the
/// smaller side). No points, or all in one place, give a camera that works and shows them in the middle.
Camera fit_camera(std::span<const Vec3> positions, const View& view, int width, int height,
                  double margin = 0.06);

}  // namespace selvage
