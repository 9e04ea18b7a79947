#include "renderer/integrators/photon_tracer.h"

#include "renderer/camera.h"
#include "renderer/sampling/warp.h"

namespace moonshade::renderer {

static constexpr uint32_t kMostSegments = 4096;

/// Of a grid of camera rays, those that end not too far away: a floor without end has no middle.
Focus focus_of(const PreparedScene& scene) {
  constexpr int kGrid = 64;
  const Settings& settings = scene.scene.settings;
  CameraRays camera(scene.scene.camera, settings.width, settings.height);
  std::vector<Ray> rays;
  for (int y = 0; y < kGrid; ++y)
    for (int x = 0; x < kGrid; ++x)
      rays.push_back(camera.ray((float(x) + 0.5f) * float(settings.width) / kGrid,
                                (float(y) + 0.5f) * float(settings.height) / kGrid));
  std::vector<Hit> hits(rays.size());
  scene.geometry->closest(rays, hits.data());
  std::vector<float> distances;
  for (const Hit& hit : hits)
    if (hit.found()) distances.push_back(hit.distance);
  const Box& all = scene.geometry->bounds();
  if (distances.empty()) return {all.center(), all.radius()};
  std::nth_element(distances.begin(), distances.begin() + long(distances.size() / 2), distances.end());
  float far = 2 * distances[distances.size() / 2];
  Box box;
  for (size_t k = 0; k < rays.size(); ++k)
    if (hits[k].found() && hits[k].distance <= far) box.add(rays[k].origin + rays[k].direction * hits[k].distance);
  return {box.center(), std::max(0.5f * glm::length(box.high - box.low) * 1.1f, 1e-3f * all.radius())};
}

PhotonTracer::PhotonTracer(const PreparedScene& scene, const PhotonSource& source, VolumeControls& controls,
                           size_t capacity)
    : scene_(scene), settings_(scene.scene.settings), source_(source),
      shader_(scene.scene, *scene.geometry, scene.materials, capacity), miss_shader_(scene, capacity), paths_(capacity),
      emitted_(capacity), rays_(capacity), hits_(capacity) {
  active_.reserve(capacity);
  if (scene.volumes->any()) tracker_ = std::make_unique<VolumeTracker>(scene, controls, capacity);
}

void PhotonTracer::trace(uint32_t pass, uint32_t first, uint32_t count, std::vector<Photon>& photons) {
  start(pass, first, count);
  ask_emitters();
  kept_.clear();
  while (!active_.empty()) {
    double begin = thread_seconds();
    for (size_t k = 0; k < active_.size(); ++k)
      rays_[k] = paths_[active_[k]].ray;
    scene_.geometry->closest({rays_.data(), active_.size()}, hits_.data());
    stats_.rays += active_.size();
    double traced = thread_seconds();
    stats_.trace_seconds += traced - begin;
    shader_.clear();
    flights_.clear();
    for (size_t k = 0; k < active_.size(); ++k) {
      Path& path = paths_[active_[k]];
      ++path.segments;
      path.alive = hits_[k].found();
      if (!path.alive) continue;
      if (tracker_ && path.media.active() != Media::kNone) {
        Flight flight;
        flight.owner = active_[k];
        flight.hit = hits_[k];
        flight.object = path.media.active();
        flight.ray = path.ray;
        flight.ray.far = hits_[k].distance;
        flight.sampler = path.sampler.fork(path.segments);
        flights_.push_back(flight);
      } else {
        meet(active_[k], hits_[k]);
      }
    }
    if (!flights_.empty()) track_volumes();
    shader_.shade(faults_, stats_, [&](const CompiledMaterial& material, size_t from, size_t to) {
      for (size_t k = from; k < to; ++k)
        bounce(material, k);
    });
    std::erase_if(active_, [&](uint32_t index) { return !paths_[index].alive; });
    stats_.shade_seconds += thread_seconds() - traced;
  }
  std::sort(kept_.begin(), kept_.end(),
            [](const Kept& a, const Kept& b) { return std::pair(a.path, a.segment) < std::pair(b.path, b.segment); });
  for (const Kept& kept : kept_)
    photons.push_back(kept.photon);
}

void PhotonTracer::start(uint32_t pass, uint32_t first, uint32_t count) {
  active_.clear();
  for (uint32_t k = 0; k < count; ++k) {
    Path path;
    path.sampler = Sampler(settings_.seed ^ 0x70686f74u, pass, first + k);
    emitted_[k] = source_.emit(path.sampler);
    path.ray = emitted_[k].ray;
    if (tracker_) path.media = media_at(*scene_.geometry, *scene_.volumes, path.ray.origin);
    path.power = emitted_[k].power;
    paths_[k] = path;
    if (!is_black(path.power) && is_finite(path.power)) active_.push_back(k);
  }
  stats_.paths += count;
}

/// Lights that shaders describe say how bright they are along the photon's way.
void PhotonTracer::ask_emitters() {
  shader_.clear();
  for (uint32_t k : active_) {
    const EmittedPhoton& photon = emitted_[k];
    if (photon.emitter == Emitter::Surroundings) miss_shader_.add(k, -photon.ray.direction, 0);
    if (photon.emitter != Emitter::Surface) continue;
    // Looked at from where it is going.
    float away = 1e-3f * std::max(1e-3f, scene_.geometry->bounds().radius());
    rays_[k] = {photon.ray.origin + photon.ray.direction * away, 0, -photon.ray.direction, kInfinity};
    shader_.add(k, rays_[k], {photon.object, photon.primitive, away}, 0, 0);
  }
  miss_shader_.shade(faults_, stats_,
                     [&](const MissShader::Arrival& a) { paths_[a.owner].power *= a.faulted ? Vec3(0) : a.radiance; });
  shader_.shade(faults_, stats_, [&](const CompiledMaterial&, size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) {
      SurfaceValues values = shader_.values(k);
      paths_[shader_.owner(k)].power *= shader_.faulted(k) ? Vec3(0) : values.emission * values.opacity;
    }
  });
  if (tracker_) ask_volumes();
  std::erase_if(active_, [&](uint32_t k) { return is_black(paths_[k].power); });
}

/// Photons that begin where something may glow, volume by volume.
void PhotonTracer::ask_volumes() {
  glowing_.clear();
  for (uint32_t k : active_) {
    if (emitted_[k].emitter != Emitter::Volume) continue;
    // The grid from which they were drawn is greater than the volume.
    if (paths_[k].media.active() == emitted_[k].object)
      glowing_.push_back(k);
    else
      paths_[k].power = Vec3(0);
  }
  std::sort(glowing_.begin(), glowing_.end(), [&](uint32_t a, uint32_t b) {
    return std::pair(emitted_[a].object, a) < std::pair(emitted_[b].object, b);
  });
  points_.clear();
  for (uint32_t k : glowing_)
    points_.push_back(emitted_[k].ray.origin);
  emission_.resize(points_.size());
  for (size_t begin = 0, end; begin < glowing_.size(); begin = end) {
    uint32_t object = emitted_[glowing_[begin]].object;
    for (end = begin; end < glowing_.size() && emitted_[glowing_[end]].object == object;)
      ++end;
    tracker_->emission(object, std::span(points_).subspan(begin, end - begin), emission_.data() + begin, faults_,
                       stats_);
  }
  for (size_t k = 0; k < glowing_.size(); ++k)
    paths_[glowing_[k]].power *= emission_[k];
}

void PhotonTracer::meet(uint32_t index, const Hit& hit) {
  Path& path = paths_[index];
  if (!tracker_ || !scene_.volumes->of(hit.object)) return shader_.add(index, path.ray, hit, 0, 0);
  SurfacePoint s = scene_.geometry->surface(path.ray, hit);
  bool entering = glm::dot(s.geometric_normal, path.ray.direction) < 0;
  path.media.cross(hit.object, entering);
  path.ray.origin = s.world + s.geometric_normal * (entering ? -s.offset : s.offset);
  path.alive = path.segments < kMostSegments;
}

void PhotonTracer::track_volumes() {
  tracker_->run(flights_, VolumeTracker::Mode::Distance, faults_, stats_);
  for (const Flight& flight : flights_) {
    Path& path = paths_[flight.owner];
    path.power *= flight.weight;
    path.alive = !flight.faulted && flight.weight != 0;
    if (!path.alive) continue;
    if (!flight.collided) {
      meet(flight.owner, flight.hit);
      continue;
    }
    float survival = max_component(flight.albedo);
    path.alive =
        path.bounces + 3 <= settings_.depth && survival > 0 && path.sampler.one(dimension(path, kSurvival)) < survival;
    if (!path.alive) continue;
    path.power *= flight.albedo / survival;
    Vec2 u = path.sampler.two(dimension(path, kDirection));
    float cosine = sample_hg(u.x, flight.anisotropy), sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    Vec3 local(sine * std::cos(2 * kPi * u.y), sine * std::sin(2 * kPi * u.y), cosine);
    Vec3 direction = normalize_or(Frame(path.ray.direction).to_world(local), path.ray.direction);
    path.ray = {path.ray.origin + path.ray.direction * flight.distance, 0, direction, kInfinity};
    ++path.bounces;
  }
}

void PhotonTracer::bounce(const CompiledMaterial& material, size_t k) {
  uint32_t index = shader_.owner(k);
  Path& path = paths_[index];
  path.alive = false;
  if (shader_.faulted(k)) return;
  const ShadedPoint s = shader_.point(k);
  SurfaceValues values = shader_.values(k);
  auto go_straight = [&] {
    path.ray.origin = s.world - s.geometric_normal * s.offset;
    path.alive = path.segments < kMostSegments;
  };
  if (values.opacity < 1 && path.sampler.one(dimension(path, kOpacity)) >= values.opacity) return go_straight();
  if (shader_.backface(k) && !material.thin && values.transmission > 0)
    path.power *= glm::exp(-material.absorption * s.distance);
  Bsdf bsdf = shader_.bsdf(material, k, values, true);
  if (path.bounces > 0 && bsdf.has_extent(gathered_lobes(bsdf)))
    kept_.push_back(
        {index, path.segments, {s.world, path.power, -path.ray.direction, s.geometric_normal, path.bounces}});
  // One edge from the light so far, one more to come, and the camera's.
  if (path.bounces + 3 > settings_.depth) return;
  BsdfSample next =
      bsdf.sample(path.sampler.one(dimension(path, kLobe)), path.sampler.two(dimension(path, kDirection)));
  if (!next.valid || !is_finite(next.weight)) return;
  // Photons keep their power as far as they can: what is absorbed is so by chance.
  float survival = std::min(1.0f, max_component(next.weight));
  if (!(survival > 0) || path.sampler.one(dimension(path, kSurvival)) >= survival) return;
  path.power *= next.weight / survival;
  if (next.straight) return go_straight();
  float side = glm::dot(next.direction, s.geometric_normal) < 0 ? -1.0f : 1.0f;
  path.ray = {s.world + s.geometric_normal * (s.offset * side), 0, next.direction, kInfinity};
  ++path.bounces;
  path.alive = true;
}

} // namespace moonshade::renderer
