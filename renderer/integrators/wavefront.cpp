// The loop over bounces, and what both integrators share.
#include "renderer/integrators/wavefront.h"

#include "renderer/sampling/warp.h"

#include <algorithm>
#include <numeric>

namespace moonshade::renderer {

static const Vec3 kFaultColor(1, 0, 1);
static constexpr size_t kLeastTogether = 6;     // rays in a packet that go different ways; fewer are as fast alone
static constexpr uint32_t kMostSegments = 4096; // of a path, sheets without end included

Wavefront::Wavefront(const PreparedScene& scene, VolumeControls& controls, size_t capacity)
    : scene_(scene), settings_(scene.scene.settings), kernels_(kernels()),
      camera_(scene.scene.camera, settings_.width, settings_.height),
      shader_(scene.scene, *scene.geometry, scene.materials, capacity), miss_shader_(scene, capacity),
      shadows_(scene, controls, capacity), paths_(capacity), packets_(capacity), rays_(capacity), hits_(capacity) {
  active_.reserve(capacity);
  camera_path_.width = camera_.width();
  camera_path_.spread = camera_.spread();
  if (!scene.volumes->any()) return;
  tracker_ = std::make_unique<VolumeTracker>(scene, controls, capacity);
  camera_path_.media = media_at(*scene.geometry, *scene.volumes, scene.scene.camera.from);
}

void Wavefront::run(const Task& task, const SampleOutputs& out) {
  last_ = thread_seconds();
  looks_at_first_ = out.first != nullptr;
  photons_ = task.photons;
  cache_ = task.cache;
  if (looks_at_first_) first_.assign(task.pixels.size() * task.samples, FirstHit{});
  generate(task);
  stats_.film_seconds += lap();
  while (!active_.empty()) {
    trace();
    stats_.trace_seconds += lap();
    take_hits();
    miss_shader_.shade(faults_, stats_, [&](const MissShader::Arrival& arrival) { leave(arrival); });
    shader_.shade(faults_, stats_, [&](const CompiledMaterial& material, size_t begin, size_t end) {
      if (looks_at_first_) note_first_hits(begin, end);
      scatter(material, begin, end);
    });
    trace_shadows();
    std::erase_if(active_, [&](uint32_t index) { return !paths_[index].alive; });
    stats_.shade_seconds += lap();
  }
  deliver(task, out);
  stats_.film_seconds += lap();
}

void Wavefront::generate(const Task& task) {
  const uint32_t* pixels = task.pixels.data();
  Path* paths = paths_.data();
  for (uint8_t size : task.groups) {
    for (uint32_t s = 0; s < task.samples; ++s, paths += size) {
      std::fill_n(packets_.begin() + (paths - paths_.data()), size, uint32_t(paths - paths_.data()));
      kernels_.camera_paths(camera_, camera_path_, settings_.seed, pixels, uint32_t(settings_.width),
                            task.first_sample + s, size, paths);
    }
    pixels += size;
  }
  active_.resize(size_t(paths - paths_.data()));
  std::iota(active_.begin(), active_.end(), 0u);
  stats_.paths += active_.size();
}

/// Packets are what is left of a sample of a group: what they report depends on nothing else.
void Wavefront::trace() {
  size_t count = active_.size();
  for (size_t k = 0; k < count; ++k)
    rays_[k] = &paths_[active_[k]].ray;
  stats_.rays += count;
  bool coherent = paths_[active_[0]].segments == 0; // all leave the camera at once
  for (size_t at = 0, end = 0; at < count; at = end) {
    while (end < count && packets_[active_[end]] == packets_[active_[at]])
      ++end;
    std::span<const Ray* const> rays(rays_.data() + at, end - at);
    if (rays.size() >= (coherent ? 2 : kLeastTogether))
      scene_.geometry->closest_together(rays, hits_.data() + at, coherent);
    else
      for (size_t k = at; k < end; ++k)
        hits_[k] = scene_.geometry->closest(*rays_[k]);
  }
}

void Wavefront::take_hits() {
  shader_.clear();
  flights_.clear();
  constexpr size_t kAhead = 8;
  for (size_t k = 0; k < active_.size(); ++k) {
    if (k + kAhead < active_.size()) __builtin_prefetch(&paths_[active_[k + kAhead]].segments, 1);
    Path& path = paths_[active_[k]];
    ++path.segments;
    if (tracker_ && hits_[k].found() && path.media.active() != Media::kNone) {
      Flight flight;
      flight.owner = active_[k];
      flight.hit = hits_[k];
      flight.object = path.media.active();
      flight.ray = path.ray;
      flight.ray.far = hits_[k].distance;
      flight.width = path.width, flight.spread = path.spread;
      flight.sampler = path.sampler.fork(2 * path.segments);
      flights_.push_back(flight);
    } else {
      meet(active_[k], hits_[k]);
    }
  }
  if (!flights_.empty()) track_volumes();
}

/// The end of a ray; borders of volumes are passed at once.
void Wavefront::meet(uint32_t index, const Hit& hit) {
  Path& path = paths_[index];
  if (!hit.found()) {
    miss_shader_.add(index, path.ray.direction, path.spread);
  } else if (tracker_ && scene_.volumes->of(hit.object)) {
    SurfacePoint s = scene_.geometry->surface(path.ray, hit);
    bool entering = glm::dot(s.geometric_normal, path.ray.direction) < 0;
    path.media.cross(hit.object, entering);
    path.ray.origin = s.world + s.geometric_normal * (entering ? -s.offset : s.offset);
    path.travelled += s.distance;
    path.width += path.spread * s.distance;
    path.alive = path.segments < kMostSegments;
  } else {
    shader_.add(index, path.ray, hit, path.width, path.spread);
  }
}

void Wavefront::track_volumes() {
  tracker_->run(flights_, VolumeTracker::Mode::Distance, faults_, stats_);
  for (const Flight& flight : flights_) {
    Path& path = paths_[flight.owner];
    if (!is_black(flight.glow)) {
      float pdf = path.mirror ? 0 : scene_.lights->volume_pdf(flight.object, path.from, path.ray.direction);
      path.radiance += path.throughput * flight.glow * (path.mirror ? 1 : power_heuristic(path.pdf, pdf));
    }
    path.throughput *= flight.weight;
    if (flight.faulted || flight.weight == 0) {
      path.alive = false;
      path.faulted |= flight.faulted;
    } else if (flight.collided) {
      scatter_in_volume(flight.owner, flight);
    } else {
      meet(flight.owner, flight.hit);
    }
  }
  trace_shadows();
}

void Wavefront::scatter_in_volume(uint32_t index, const Flight& flight) {
  Path& path = paths_[index];
  path.throughput *= flight.albedo;
  path.alive = may_bounce(path);
  if (!path.alive) return;
  Vec3 point = path.ray.origin + path.ray.direction * flight.distance;
  path.width += path.spread * flight.distance;
  LightSample light = scene_.lights->count()
                          ? scene_.lights->sample(point, path.sampler.one(dimension(path, kLightChoice)),
                                                  path.sampler.two(dimension(path, kLightPoint)))
                          : LightSample{};
  bool goes_on = settings_.integrator != IntegratorKind::Whitted;
  if (light.pdf > 0 && !is_black(light.radiance)) {
    float phase = phase_hg(glm::dot(path.ray.direction, light.direction), flight.anisotropy);
    float weight = light.delta || !goes_on ? 1.0f : power_heuristic(light.pdf, phase);
    Vec3 contribution = path.throughput * light.radiance * (phase * weight / light.pdf);
    add_shadow({{point, 0, light.direction, shadow_end(light.distance, 0)}, contribution, index}, light, path.width,
               path.spread);
  }
  path.alive = goes_on && survives(path);
  if (!path.alive) return;
  Vec2 u = path.sampler.two(dimension(path, kDirection));
  float cosine = sample_hg(u.x, flight.anisotropy), sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
  Vec3 local(sine * std::cos(2 * kPi * u.y), sine * std::sin(2 * kPi * u.y), cosine);
  Vec3 direction = normalize_or(Frame(path.ray.direction).to_world(local), path.ray.direction);
  path.ray = {point, 0, direction, kInfinity};
  path.from = point;
  path.travelled = 0;
  path.pdf = phase_hg(cosine, flight.anisotropy);
  path.mirror = false;
  ++path.bounces;
}

/// What a ray sees that meets nothing.
void Wavefront::leave(const MissShader::Arrival& arrival) {
  Path& path = paths_[arrival.owner];
  path.alive = false;
  if (arrival.faulted) {
    path.faulted = true;
    if (path.bounces == 0) path.radiance = kFaultColor;
    return;
  }
  if (is_black(arrival.radiance)) return;
  float weight = 1;
  if (!path.mirror)
    weight = power_heuristic(path.pdf,
                             arrival.density ? *arrival.density : scene_.lights->environment_pdf(path.ray.direction));
  path.radiance += path.throughput * arrival.radiance * weight;
}

void Wavefront::scatter(const CompiledMaterial& material, size_t begin, size_t end) {
  switch (settings_.integrator) {
  case IntegratorKind::Path:
    scatter_path(material, begin, end);
    break;
  case IntegratorKind::Whitted:
    scatter_whitted(material, begin, end);
    break;
  case IntegratorKind::Sppm:
    scatter_sppm(material, begin, end);
    break;
  case IntegratorKind::Irradiance:
    scatter_irradiance(material, begin, end);
    break;
  }
}

/// A point without values shows magenta where the camera sees it, and ends the path with nothing anywhere else.
bool Wavefront::end_if_faulted(Path& path, size_t k) {
  if (!shader_.faulted(k)) return false;
  path.alive = false;
  path.faulted = true;
  if (path.bounces == 0) path.radiance = kFaultColor;
  return true;
}

/// Chance decides where the surface is partly there.
bool Wavefront::passes(Path& path, size_t k, const SurfaceValues& values) {
  if (values.opacity >= 1 || path.sampler.one(dimension(path, kOpacity)) < values.opacity) return false;
  go_straight(path, k);
  return true;
}

/// On the way through a solid.
void Wavefront::absorb(Path& path, const CompiledMaterial& material, size_t k, const SurfaceValues& values) const {
  if (!shader_.backface(k) || material.thin || values.transmission <= 0 || is_black(material.absorption)) return;
  path.throughput *= glm::exp(-material.absorption * shader_.point(k).distance);
}

void Wavefront::follow(Path& path, size_t k, const Vec3& direction, float spread) {
  const ShadedPoint s = shader_.point(k);
  float side = glm::dot(direction, s.geometric_normal) < 0 ? -1.0f : 1.0f;
  path.ray = {s.world + s.geometric_normal * (s.offset * side), 0, direction, kInfinity};
  path.from = path.ray.origin;
  path.travelled = 0;
  path.width = shader_.width(k);
  path.spread += spread;
  ++path.bounces;
}

void Wavefront::go_straight(Path& path, size_t k) {
  const ShadedPoint s = shader_.point(k);
  path.ray.origin = s.world - s.geometric_normal * s.offset;
  path.travelled += s.distance;
  path.width = shader_.width(k);
  path.alive = path.segments < kMostSegments;
}

/// Russian roulette, by what the path can still bring (within glass, throughputs are less by the square of its index).
bool Wavefront::survives(Path& path) {
  float brightest = max_component(glm::abs(path.throughput));
  if (!(brightest > 0)) return false;
  if (path.bounces + 1 < kRouletteFrom) return true;
  float survival = std::min(0.95f, brightest * path.eta2);
  if (path.sampler.one(dimension(path, kRoulette)) >= survival) return false;
  path.throughput /= survival;
  return true;
}

/// From point `k`.
void Wavefront::add_shadow(uint32_t path, size_t k, const LightSample& light, const Vec3& contribution) {
  const ShadedPoint s = shader_.point(k);
  float side = glm::dot(light.direction, s.geometric_normal) < 0 ? -1.0f : 1.0f;
  Vec3 origin = s.world + s.geometric_normal * (s.offset * side);
  add_shadow({{origin, 0, light.direction, shadow_end(light.distance, s.offset)}, contribution, path}, light,
             shader_.width(k), paths_[path].spread);
}

void Wavefront::add_shadow(const Shadow& shadow, const LightSample& light, float width, float spread) {
  if (shadows_.room() == 0) trace_shadows();
  if (!shadows_.wants_details()) return shadows_.add(shadow);
  ShadowDetails details;
  details.width = width, details.spread = spread;
  details.emitter = light.emitter;
  details.light = {light.object, light.primitive, light.distance};
  if (tracker_) {
    const Path& path = paths_[shadow.owner];
    details.media = path.media;
    details.sampler = path.sampler.fork(2 * path.segments + 1);
  }
  shadows_.add(shadow, details);
}

void Wavefront::trace_shadows() {
  if (shadows_.empty()) return;
  stats_.shade_seconds += lap();
  shadows_.trace(faults_, stats_, [&](uint32_t path, const Vec3& light) { paths_[path].radiance += light; });
  lap();
}

/// What paths see that have just left the camera.
void Wavefront::note_first_hits(size_t begin, size_t end) {
  for (size_t k = begin; k < end; ++k) {
    uint32_t owner = shader_.owner(k);
    if (paths_[owner].bounces != 0 || first_[owner].object != 0) continue; // volumes are looked through
    const ShadedPoint s = shader_.point(k);
    const Hit& hit = shader_.hit(k);
    SurfaceValues values = shader_.values(k);
    Vec3 albedo = values.color * (Vec3(1) - values.reflectance) + values.reflectance;
    if (shader_.faulted(k)) albedo = kFaultColor;
    uint32_t material = scene_.geometry->objects()[hit.object].material_of(hit.primitive);
    first_[owner] = {albedo, s.shading_normal, s.world, camera_.depth(s.world), hit.object + 1, material + 1};
  }
}

/// From the order of groups to that of pixels.
template <typename Visit> static void each_sample(const Task& task, Visit visit) {
  size_t path = 0, pixel = 0;
  for (uint8_t size : task.groups) {
    for (size_t s = 0; s < task.samples; ++s)
      for (size_t p = 0; p < size; ++p, ++path)
        visit(path, (pixel + p) * task.samples + s);
    pixel += size;
  }
}

void Wavefront::deliver(const Task& task, const SampleOutputs& out) {
  each_sample(task, [&](size_t k, size_t at) {
    Vec3 value = paths_[k].radiance;
    if (!is_finite(value)) {
      ++faults_[{"", "radiance", kNotFinite, 0, ""}];
      value = Vec3(0);
      paths_[k].faulted = true;
    }
    float brightest = max_component(glm::abs(value)); // tracking through volumes also gives negative samples
    if (settings_.clamp > 0 && brightest > settings_.clamp) value *= settings_.clamp / brightest;
    out.radiance[at] = value;
    if (out.faulted) out.faulted[at] = paths_[k].faulted;
    if (out.first) out.first[at] = first_[k];
  });
}

} // namespace moonshade::renderer
