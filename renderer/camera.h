// A perspective camera prepared for rays.
#pragma once

#include "renderer/geometry/geometry.h"
#include "renderer/scene/scene.h"

namespace moonshade::renderer {

class CameraRays {
public:
  CameraRays(const Camera& camera, int width, int height) : origin_(camera.from) {
    Vec3 forward = glm::normalize(camera.to - camera.from);
    forward_ = forward;
    Vec3 right = glm::normalize(glm::cross(forward, camera.up));
    Vec3 up = glm::cross(right, forward);
    float half = std::tan(0.5f * camera.fov * kPi / 180);
    pixel_ = 2 * half / float(height);
    corner_ = forward - right * (half * float(width) / float(height)) + up * half;
    across_ = right * pixel_;
    down_ = -up * pixel_;
  }

  /// Through a place of the image in pixels, (0, 0) at its upper left corner.
  Ray ray(float x, float y) const { return {origin_, 0, glm::normalize(corner_ + across_ * x + down_ * y), kInfinity}; }

  /// Width of a pixel's footprint per unit of distance.
  float spread() const { return pixel_; }

  /// Of a point, along the camera's axis.
  float depth(const Vec3& point) const { return glm::dot(point - origin_, forward_); }

private:
  Vec3 origin_, forward_{0}, corner_{0}, across_{0}, down_{0};
  float pixel_ = 0;
};

} // namespace moonshade::renderer
