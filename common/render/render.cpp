// SPDX-License-Identifier: MIT
#include "common/render/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/render/labels.h"
#include "common/render/rasterise.h"
#include "common/render/text.h"

namespace selvage {
namespace {

constexpr Rgb kClay{214, 208, 198};
constexpr double kLeastLabel = 8, kLabelShareOfRoom = 1.2;  // px; below that a number is a smudge

/// Normals at the corners of triangles: the mean over the triangles around a vertex that lean less than the
/// crease angle from this one, weighted by area. Computed for what is seen only.
class CornerNormals {
 public:
  CornerNormals(const Scene& scene, double crease_degrees)
      : scene_(scene),
        least_cosine_(std::cos(crease_degrees * std::numbers::pi / 180)),
        is_flat_(crease_degrees <= 0) {
    areas_.reserve(scene.triangles.size());
    for (const auto& [a, b, c] : scene.triangles) {
      const Vec3& p = scene.positions[a];
      areas_.push_back(cross(scene.positions[b] - p, scene.positions[c] - p));
    }
    if (!is_flat_) gather_triangles();
  }

  std::array<Vec3, 3> of(TriangleId t) const {
    const Vec3 own = normalised(areas_[t]);
    if (is_flat_) return {own, own, own};
    std::array<Vec3, 3> normals;
    for (int k = 0; k < 3; ++k) {
      const VertexId v = scene_.triangles[t][k];
      Vec3 sum = areas_[t];
      const std::uint32_t first = first_of_vertex_[v], last = first_of_vertex_[v + 1];
      for (std::uint32_t i = first; i < last && last - first <= kMostAtVertex; ++i) {
        const Vec3& other = areas_[triangles_[i]];
        if (triangles_[i] != t && dot(own, other) >= least_cosine_ * length(other)) sum += other;
      }
      normals[k] = normalised(sum);
    }
    return normals;
  }

 private:
  void gather_triangles() {
    first_of_vertex_.assign(scene_.positions.size() + 1, 0);
    for (const Triangle& t : scene_.triangles)
      for (VertexId v : t) ++first_of_vertex_[v];
    std::uint32_t sum = 0;
    for (std::uint32_t& first : first_of_vertex_) first = sum += first;
    triangles_.resize(sum);
    for (TriangleId t = 0; t < scene_.triangles.size(); ++t)
      for (VertexId v : scene_.triangles[t]) triangles_[--first_of_vertex_[v]] = t;
  }

  static constexpr std::uint32_t kMostAtVertex = 500;  // the tip of a fan that large is shaded flat: its
                                                       // triangles would each look at all others
  const Scene& scene_;
  double least_cosine_;
  bool is_flat_;
  std::vector<Vec3> areas_;  // normals as long as twice the area
  std::vector<std::uint32_t> first_of_vertex_, triangles_;
};

/// A photographer's table: a soft key light from the upper left, a weak fill from the right, sky and
/// ground. Lights move with the camera, so every side of a model is lit alike.
class Studio {
 public:
  explicit Studio(const Camera& camera)
      : key_(normalised(camera.right * -0.5 + camera.up * 0.75 + camera.back * 0.8)),
        fill_(normalised(camera.right * 0.9 + camera.up * -0.1 + camera.back * 0.5)),
        gloss_(normalised(key_ + camera.back)),
        up_(camera.up),
        back_(camera.back) {}

  /// The inside of an open surface is darker, so that holes read as holes.
  Light shade(const Light& albedo, Vec3 normal, bool is_inside) const {
    if (dot(normal, back_) < 0) normal = -normal;
    const double diffuse = 0.84 * std::max(0.0, dot(normal, key_)) +
                           0.18 * std::max(0.0, dot(normal, fill_)) + 0.29 + 0.11 * dot(normal, up_);
    const auto gloss = static_cast<float>(0.06 * std::pow(std::max(0.0, dot(normal, gloss_)), 32));
    return (albedo * static_cast<float>(diffuse) + Light{gloss, gloss, gloss}) * (is_inside ? 0.55f : 1.0f);
  }

 private:
  Vec3 key_, fill_, gloss_, up_, back_;
};

class Renderer {
 public:
  Renderer(const Scene& scene, const Camera& camera, const RenderOptions& options)
      : scene_(scene),
        options_(options),
        samples_(std::max(1, options.samples)),
        studio_(camera),
        normals_(scene, options.crease_degrees) {
    for (const Vec3& p : scene.positions) {
      const Projected q = camera.project(p);
      points_.push_back({q.x * samples_, q.y * samples_, q.nearness});
    }
    seen_ = rasterise(points_, scene.triangles, camera.width * samples_, camera.height * samples_);
    is_inside_out_ = shows_mostly_backs();
    border_offsets_ = disc(options.border_px * samples_ / 2);
  }

  Image paint(int width, int height) {
    Image image(width, height, options_.background);
    const float share = 1.0f / static_cast<float>(samples_ * samples_);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        Light sum;
        for (int j = 0; j < samples_; ++j)
          for (int i = 0; i < samples_; ++i) sum += light_at(x * samples_ + i, y * samples_ + j);
        image.at(x, y) = to_rgb(sum * share);
      }
    }
    return image;
  }

  void write_labels(Image& image) const {
    if (options_.label_px <= 0 || scene_.region_of_triangle.empty()) return;
    for (const LabelPlace& place : find_label_places(seen_, scene_.region_of_triangle)) {
      const double room = place.room / samples_;
      const double height = std::min(options_.label_px, kLabelShareOfRoom * room);
      if (height < kLeastLabel) continue;
      draw_text_centred(image, place.x / samples_, place.y / samples_, std::to_string(place.region),
                        {.height_px = height, .halo_px = height / 9});
    }
  }

 private:
  struct Offset {
    int x, y;
  };

  /// The offsets within a radius, without the middle.
  static std::vector<Offset> disc(double radius) {
    std::vector<Offset> offsets;
    const int reach = static_cast<int>(std::ceil(radius));
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x)
        if ((x != 0 || y != 0) && std::hypot(x, y) <= radius) offsets.push_back({x, y});
    return offsets;
  }

  bool is_back(TriangleId t) const {
    const Projected &a = points_[scene_.triangles[t][0]], &b = points_[scene_.triangles[t][1]],
                    &c = points_[scene_.triangles[t][2]];
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;  // y points down
  }

  /// Files whose triangles all face inwards are common; then backs are what one should see.
  bool shows_mostly_backs() const {
    std::int64_t balance = 0;
    for (TriangleId t : seen_.triangle)
      if (t != kNone) balance += is_back(t) ? 1 : -1;
    return balance > 0;
  }

  Rgb colour_of(TriangleId t) const {
    return scene_.colour_of_triangle.empty() ? kClay : scene_.colour_of_triangle[t];
  }

  Light light_at(int x, int y) {
    const TriangleId t = seen_.at(x, y);
    if (t == kNone) return to_light(options_.background);
    if (t != shaded_) {  // neighbours in a row mostly see the same triangle
      shaded_ = t;
      corner_normals_ = normals_.of(t);
      albedo_ = to_light(colour_of(t));
      is_inside_ = is_back(t) != is_inside_out_;
    }
    if (is_on_border(x, y, t)) return to_light(kBlack);
    const Light light = studio_.shade(albedo_, normal_at(x + 0.5, y + 0.5, t), is_inside_);
    return light * static_cast<float>(1 - 0.75 * wire_at(x + 0.5, y + 0.5, t));
  }

  bool is_on_border(int x, int y, TriangleId t) const {
    const Rgb own = colour_of(t);
    return std::ranges::any_of(border_offsets_, [&](const Offset& o) {
      if (!seen_.contains(x + o.x, y + o.y)) return false;
      const TriangleId other = seen_.at(x + o.x, y + o.y);
      return other != kNone && other != t && colour_of(other) != own;
    });
  }

  Vec3 normal_at(double x, double y, TriangleId t) const {
    const Projected &a = points_[scene_.triangles[t][0]], &b = points_[scene_.triangles[t][1]],
                    &c = points_[scene_.triangles[t][2]];
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const double wb = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
    const double wc = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
    return normalised(corner_normals_[0] * (1 - wb - wc) + corner_normals_[1] * wb + corner_normals_[2] * wc);
  }

  /// How much a sample belongs to the line along the nearest edge of its triangle, 0 to 1.
  double wire_at(double x, double y, TriangleId t) const {
    if (options_.wire_px <= 0) return 0;
    double nearest = 1e9;
    for (int k = 0; k < 3; ++k) {
      const Projected &a = points_[scene_.triangles[t][k]], &b = points_[scene_.triangles[t][(k + 1) % 3]];
      const double along = std::hypot(b.x - a.x, b.y - a.y);
      if (along > 0)
        nearest = std::min(nearest, std::abs((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / along);
    }
    return std::clamp(options_.wire_px * samples_ / 2 + 0.5 - nearest, 0.0, 1.0);
  }

  const Scene& scene_;
  const RenderOptions& options_;
  const int samples_;
  const Studio studio_;
  const CornerNormals normals_;
  std::vector<Projected> points_;  // in samples
  VisibleTriangles seen_;
  std::vector<Offset> border_offsets_;

  bool is_inside_out_ = false;

  TriangleId shaded_ = kNone;  // the rest is of this triangle
  std::array<Vec3, 3> corner_normals_{};
  Light albedo_;
  bool is_inside_ = false;
};

}  // namespace

Image render(const Scene& scene, const Camera& camera, const RenderOptions& options) {
  Renderer renderer(scene, camera, options);
  Image image = renderer.paint(camera.width, camera.height);
  renderer.write_labels(image);
  return image;
}

}  // namespace selvage
