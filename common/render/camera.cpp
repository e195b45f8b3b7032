// SPDX-License-Identifier: MIT
#include "common/render/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace selvage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// In radii of the model: near enough for a sense of depth, far enough that nothing bulges.
constexpr double kEyeDistance = 4.5;

struct Box {
  Vec3 low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};

  void add(const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  Vec3 middle() const { return low * 0.5 + high * 0.5; }
};

void set_axes(Camera& camera, const View& view) {
  const double azimuth = view.azimuth_degrees * std::numbers::pi / 180;
  const double elevation = view.elevation_degrees * std::numbers::pi / 180;
  const bool y_is_up = view.up == UpAxis::Y;
  const Vec3 side{1, 0, 0}, front = y_is_up ? Vec3{0, 0, 1} : Vec3{0, -1, 0},
                            sky = y_is_up ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const Vec3 out = side * std::sin(azimuth) + front * std::cos(azimuth);
  camera.right = side * std::cos(azimuth) - front * std::sin(azimuth);
  camera.back = out * std::cos(elevation) + sky * std::sin(elevation);
  camera.up = sky * std::cos(elevation) - out * std::sin(elevation);
}

}  // namespace

Projected Camera::project(const Vec3& p) const {
  const Vec3 d = p - target;
  const double x = dot(d, right), y = dot(d, up), depth = distance - dot(d, back);
  if (distance == 0) return {centre_x + scale * x, centre_y - scale * y, -depth};
  const double shrink = distance / depth;
  return {centre_x + scale * shrink * x, centre_y - scale * shrink * y, 1 / depth};
}

Camera fit_camera(std::span<const Vec3> positions, const View& view, int width, int height, double margin) {
  Camera camera{.width = width, .height = height, .centre_x = width / 2.0, .centre_y = height / 2.0};
  set_axes(camera, view);
  if (positions.empty()) return camera;

  Box box;
  for (const Vec3& p : positions) box.add(p);
  camera.target = box.middle();
  const double radius = length(box.high - camera.target);
  if (!(radius > 0)) return camera;
  if (view.projection == Projection::Perspective) camera.distance = kEyeDistance * radius;

  camera.centre_x = camera.centre_y = 0;
  Box seen;
  for (const Vec3& p : positions) {
    const Projected q = camera.project(p);
    seen.add({q.x, q.y, 0});
  }
  const double gap = 2 * margin * std::min(width, height), least = 1e-3 * radius;
  const Vec3 size = seen.high - seen.low;
  const double fit =
      std::min((width - gap) / std::max(size.x, least), (height - gap) / std::max(size.y, least));
  camera.scale = fit;
  camera.centre_x = width / 2.0 - fit * seen.middle().x;
  camera.centre_y = height / 2.0 - fit * seen.middle().y;
  return camera;
}

}  // namespace selvage
