#include "renderer/lights/photon_source.h"

#include "renderer/sampling/warp.h"

namespace moonshade::renderer {

static constexpr float kAimed = 0.8f; // of the photons that can be

PhotonSource::PhotonSource(const Geometry& geometry, const LightSet& lights, const Vec3& focus, float focus_radius)
    : geometry_(geometry), lights_(lights), focus_(focus), center_(geometry.bounds().center()),
      focus_radius_(focus_radius), radius_(geometry.bounds().radius() * 1.001f) {
  double sum = 0;
  for (const LightSet::Entry& entry : lights.lights_)
    sum += double(power_of(entry));
  double running = 0;
  for (const LightSet::Entry& entry : lights.lights_)
    cumulative_.push_back(float((running += double(power_of(entry))) / sum));
  if (!(sum > 0)) cumulative_.clear();
}

/// What reaches the focus, roughly: shares of photons, which any positive numbers may be.
float PhotonSource::power_of(const LightSet::Entry& entry) const {
  float disc = kPi * focus_radius_ * focus_radius_;
  switch (entry.kind) {
  case LightSet::Kind::Sun:
    return luminance(entry.light.color) * disc;
  case LightSet::Kind::Sky:
    return luminance(entry.light.zenith + entry.light.horizon) * 0.5f * kPi * disc;
  case LightSet::Kind::Around:
    return luminance(lights_.environments_[entry.around].mean()) * 4 * kPi * disc;
  case LightSet::Kind::Point:
    return luminance(entry.light.color) * 4 * kPi;
  case LightSet::Kind::Spot:
    return luminance(entry.light.color) * 2 * kPi * entry.one_minus_cos;
  case LightSet::Kind::Mesh:
    return entry.power * kPi * (entry.one_sided ? 1.0f : 2.0f);
  case LightSet::Kind::Volume:
    return entry.glow->power() * 4 * kPi;
  case LightSet::Kind::Sphere:
  case LightSet::Kind::Ellipsoid:
    break;
  }
  return luminance(entry.emission) * 4 * kPi * kPi * entry.radius * entry.radius;
}

/// A ray through a disc across the scene, or, for the most part, across what the camera sees.
EmittedPhoton PhotonSource::from_far(const Vec3& to_light, const Vec2& u, float choice) const {
  Frame frame(to_light);
  bool aimed = choice < kAimed;
  Vec2 d = sample_disk(u) * (aimed ? focus_radius_ : radius_);
  Vec3 through = (aimed ? focus_ : center_) + frame.s * d.x + frame.t * d.y;
  // From outside the scene.
  Vec3 origin = through + to_light * (glm::dot(center_ - through, to_light) + radius_);
  auto within = [&](const Vec3& c, float r) {
    Vec3 apart = through - c;
    apart -= to_light * glm::dot(apart, to_light);
    return glm::dot(apart, apart) <= r * r ? 1 / (kPi * r * r) : 0.0f;
  };
  float pdf = kAimed * within(focus_, focus_radius_) + (1 - kAimed) * within(center_, radius_);
  EmittedPhoton photon;
  photon.ray = {origin, 0, -to_light, kInfinity};
  photon.power = pdf > 0 ? Vec3(1 / pdf) : Vec3(0);
  return photon;
}

EmittedPhoton PhotonSource::from_point(const LightSet::Entry& entry, const Vec2& u, float choice) const {
  Vec3 to = focus_ - entry.light.position;
  float squared = glm::dot(to, to), cone = 0, everywhere = 2;
  if (squared > 1.01f * focus_radius_ * focus_radius_)
    cone = 1 - std::sqrt(1 - focus_radius_ * focus_radius_ / squared);
  Vec3 axis(0, 1, 0);
  if (entry.kind == LightSet::Kind::Spot) axis = entry.light.direction, everywhere = entry.one_minus_cos;
  Vec3 aim = cone > 0 ? to / std::sqrt(squared) : axis;
  bool aimed = cone > 0 && choice < kAimed;
  Vec3 direction = Frame(aimed ? aim : axis).to_world(sample_cone(u, aimed ? cone : everywhere));
  float share = cone > 0 ? kAimed : 0;
  float pdf = glm::dot(direction, axis) >= 1 - everywhere - 1e-6f ? (1 - share) / (2 * kPi * everywhere) : 0.0f;
  if (cone > 0 && glm::dot(direction, aim) >= 1 - cone) pdf += share / (2 * kPi * cone);
  EmittedPhoton photon;
  photon.ray = {entry.light.position, 0, normalize_or(direction, axis), kInfinity};
  if (!(pdf > 0)) return photon;
  photon.power = entry.light.color / pdf;
  if (entry.kind == LightSet::Kind::Spot) photon.power *= LightSet::spot_share(entry, -direction);
  return photon;
}

/// From a point of what glows, in any direction.
EmittedPhoton PhotonSource::from_volume(const LightSet::Entry& entry, const Vec2& at, float w, const Vec2& u) const {
  GlowGrid::Point point = entry.glow->sample(at, w);
  float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
  EmittedPhoton photon;
  photon.ray = {point.world, 0, Vec3(r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z), kInfinity};
  photon.power = point.density > 0 ? Vec3(4 * kPi / point.density) : Vec3(0);
  photon.emitter = Emitter::Volume;
  photon.object = entry.object;
  return photon;
}

EmittedPhoton PhotonSource::from_surface(const LightSet::Entry& entry, const Vec2& at, const Vec2& u,
                                         float choice) const {
  const PlacedObject& placed = geometry_.objects()[entry.object];
  EmittedPhoton photon;
  Vec3 point, normal, emission = entry.emission;
  float pdf = 0, offset;
  if (entry.kind == LightSet::Kind::Mesh) {
    float first = at.x;
    uint32_t index = LightSet::choose(entry.cumulative, first);
    photon.primitive = entry.triangles[index];
    const LightTriangle& t = entry.emitting[index];
    float root = std::sqrt(first);
    point = t.a * (1 - root) + t.b * (root * (1 - at.y)) + t.c * (root * at.y);
    normal = normalize_or(glm::cross(t.b - t.a, t.c - t.a), Vec3(0)) * t.side;
    pdf = t.density;
    emission = t.emission;
    offset = 1e-6f * max_component(glm::max(glm::abs(t.a), glm::max(glm::abs(t.b), glm::abs(t.c))));
    if (!entry.one_sided) {
      if (choice < 0.5f) normal = -normal;
      pdf *= 0.5f;
    }
  } else {
    float z = 1 - 2 * at.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
    Vec3 unit(r * std::cos(2 * kPi * at.y), r * std::sin(2 * kPi * at.y), z);
    point = Vec3(placed.object->to_world * Vec4(unit * placed.object->radius, 1));
    normal = normalize_or(placed.normal_matrix * unit, unit);
    pdf = LightSet::ellipsoid_pdf(placed, unit);
    offset = 2e-6f * (max_component(glm::abs(point)) + entry.radius);
  }
  if (!(pdf > 0) || is_black(normal)) return photon;
  Vec3 direction = Frame(normal).to_world(sample_cosine_hemisphere(u));
  photon.ray = {point + normal * offset, 0, normalize_or(direction, normal), kInfinity};
  photon.power = Vec3(kPi / pdf);
  photon.object = entry.object;
  if (entry.by_shader)
    photon.emitter = Emitter::Surface;
  else
    photon.power *= emission;
  return photon;
}

/// Density of directions towards light from far away, the choice among lights included.
float PhotonSource::far_pdf(const Vec3& to_light) const {
  float sum = 0;
  for (uint32_t id : lights_.environment_) {
    float share = cumulative_[id] - (id ? cumulative_[id - 1] : 0.0f);
    sum += share * lights_.entry_pdf(lights_.lights_[id], to_light);
  }
  return sum;
}

EmittedPhoton PhotonSource::emit(const Sampler& sampler) const {
  if (cumulative_.empty()) return {};
  float choice = sampler.one(0);
  Vec2 first = sampler.two(1), second = sampler.two(2);
  uint32_t id = LightSet::choose(cumulative_, choice);
  float share = cumulative_[id] - (id ? cumulative_[id - 1] : 0.0f);
  const LightSet::Entry& entry = lights_.lights_[id];
  EmittedPhoton photon;
  switch (entry.kind) {
  case LightSet::Kind::Point:
  case LightSet::Kind::Spot:
    photon = from_point(entry, second, choice);
    break;
  case LightSet::Kind::Volume:
    photon = from_volume(entry, first, sampler.one(3), second);
    break;
  case LightSet::Kind::Mesh:
  case LightSet::Kind::Sphere:
  case LightSet::Kind::Ellipsoid:
    photon = from_surface(entry, first, second, choice);
    break;
  default: {
    bool point_like = entry.kind == LightSet::Kind::Sun && entry.one_minus_cos <= 0;
    LightSample light = lights_.sample_entry(entry, Vec3(0), first, 0);
    photon = from_far(light.direction, second, choice);
    if (point_like) {
      photon.power *= entry.light.color;
      break;
    }
    float pdf = far_pdf(light.direction);
    photon.power *= pdf > 0 ? light.radiance / pdf : Vec3(0);
    photon.emitter = light.emitter;
    return photon; // the choice is in the density
  }
  }
  photon.power /= share;
  return photon;
}

} // namespace moonshade::renderer
