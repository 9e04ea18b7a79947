// A camera prepared for rays: perspective (with a lens, where it has an aperture) or orthographic.
#pragma once

#include "renderer/geometry/geometry.h"
#include "renderer/lane_math.h"
#include "renderer/sampling/warp.h"
#include "renderer/scene/scene.h"

namespace moonshade::renderer {

class CameraRays {
public:
  CameraRays(const Camera& camera, int width, int height)
      : parallel_(camera.kind == CameraKind::Orthographic), origin_(camera.from),
        forward_(glm::normalize(camera.to - camera.from)), lens_radius_(parallel_ ? 0 : 0.5f * camera.aperture) {
    right_ = glm::normalize(glm::cross(forward_, camera.up));
    up_ = glm::cross(right_, forward_);
    focus_ = camera.focus > 0 ? camera.focus : glm::length(camera.to - camera.from);
    float half = parallel_ ? 0.5f * camera.height : std::tan(0.5f * camera.fov * kPi / 180);
    pixel_ = 2 * half / float(height);
    corner_ = up_ * half - right_ * (half * float(width) / float(height));
    if (!parallel_) corner_ += forward_;
    across_ = right_ * pixel_;
    down_ = -up_ * pixel_;
  }

  /// Through a place of the image in pixels, (0, 0) at its upper left corner, and a place of the lens in the unit
  /// square.
  Ray ray(float x, float y, const Vec2& lens = Vec2(0.5f)) const {
    Ray ray;
    lanes::V3<float> origin, direction;
    rays(x, y, lens.x, lens.y, origin, direction);
    ray.origin = {origin[0], origin[1], origin[2]};
    ray.direction = {direction[0], direction[1], direction[2]};
    return ray;
  }
  /// The same for lanes of them.
  template <class L>
  MS_INLINE void rays(L x, L y, L lens_x, L lens_y, lanes::V3<L>& origin, lanes::V3<L>& direction) const {
    using lanes::spread;
    lanes::V3<L> place = spread<L>(corner_) + spread<L>(across_) * x + spread<L>(down_) * y;
    origin = spread<L>(origin_);
    if (parallel_) {
      origin = origin + place;
      direction = spread<L>(forward_);
    } else if (lens_radius_ == 0) {
      direction = lanes::unit(place);
    } else {
      L disk_x, disk_y;
      sample_disk(lens_x, lens_y, disk_x, disk_y);
      lanes::V3<L> from = spread<L>(right_) * (disk_x * L(lens_radius_)) + spread<L>(up_) * (disk_y * L(lens_radius_));
      origin = origin + from;
      // All rays of one place of the image meet on the plane in focus.
      direction = lanes::unit(place * L(focus_) - from);
    }
  }
  bool has_lens() const { return lens_radius_ > 0; }

  /// Width of a pixel's footprint at the ray's origin, and its growth per unit of distance.
  float width() const { return parallel_ ? pixel_ : 0; }
  float spread() const { return parallel_ ? 0 : pixel_; }

  /// Of a point, along the camera's axis.
  float depth(const Vec3& point) const { return glm::dot(point - origin_, forward_); }

private:
  bool parallel_;
  Vec3 origin_, forward_, right_{0}, up_{0};
  Vec3 corner_{0}, across_{0}, down_{0}; ///< of the image: a unit away, or in the camera's plane
  float lens_radius_, focus_ = 1, pixel_ = 0;
};

} // namespace moonshade::renderer
