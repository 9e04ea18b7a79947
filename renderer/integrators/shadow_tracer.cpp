#include "renderer/integrators/shadow_tracer.h"

namespace moonshade::renderer {

static constexpr int kMostSurfaces = 256; // in a row that let light through

ShadowTracer::ShadowTracer(const PreparedScene& scene, VolumeControls& controls, size_t capacity)
    : scene_(scene), capacity_(capacity),
      wants_details_(scene.materials.any_passable() || scene.lights->asks_surfaces() || scene.lights->asks_shaders()),
      shadows_(capacity + 1), details_(wants_details_ ? capacity : 0), rays_(capacity), blocked_(capacity),
      miss_shader_(scene, capacity) {
  if (!scene.materials.any_passable() && !scene.lights->asks_surfaces()) return;
  shader_ = std::make_unique<HitShader>(scene.scene, *scene.geometry, scene.materials, capacity);
  hits_.resize(capacity);
  if (scene.volumes->any()) tracker_ = std::make_unique<VolumeTracker>(scene, controls, capacity);
}

void ShadowTracer::arrive(FaultLog& faults, WorkerStats& stats) {
  double start = thread_seconds();
  for (size_t k = 0; k < count_; ++k) {
    rays_[k] = shadows_[k].ray;
    // What is before the first surface counts.
    if (wants_details_ && details_[k].emitter == Emitter::Volume) rays_[k].far = 0;
  }
  scene_.geometry->occluded({rays_.data(), count_}, blocked_.data());
  stats.rays += count_;
  for (size_t k = 0; k < count_; ++k)
    if (blocked_[k]) shadows_[k].contribution = Vec3(0);
  stats.trace_seconds += thread_seconds() - start;
  if (!wants_details_) return;
  if (scene_.materials.any_passable()) pass_through(faults, stats);
  for (size_t k = 0; k < count_; ++k)
    if (details_[k].emitter == Emitter::Volume) shadows_[k].contribution = details_[k].glow;
  ask_emitters(faults, stats);
}

/// Nothing opaque is in the way of those that are left.
void ShadowTracer::pass_through(FaultLog& faults, WorkerStats& stats) {
  active_.clear();
  for (uint32_t k = 0; k < count_; ++k)
    if (!is_black(shadows_[k].contribution)) active_.push_back(k);
  for (int surface = 0; !active_.empty(); ++surface) {
    if (surface == kMostSurfaces) {
      for (uint32_t index : active_)
        shadows_[index].contribution = Vec3(0);
      return;
    }
    for (size_t k = 0; k < active_.size(); ++k)
      rays_[k] = shadows_[active_[k]].ray;
    scene_.geometry->closest({rays_.data(), active_.size()}, hits_.data());
    stats.rays += active_.size();
    if (tracker_) track_volumes(surface, faults, stats);
    shader_->clear();
    size_t left = 0;
    for (size_t k = 0; k < active_.size(); ++k) {
      if (!hits_[k].found()) continue;
      Shadow& shadow = shadows_[active_[k]];
      ShadowDetails& details = details_[active_[k]];
      if (scene_.volumes->of(hits_[k].object)) {
        SurfacePoint s = scene_.geometry->surface(shadow.ray, hits_[k]);
        bool entering = glm::dot(s.geometric_normal, shadow.ray.direction) < 0;
        details.media.cross(hits_[k].object, entering);
        shadow.ray.origin = s.world + s.geometric_normal * (entering ? -s.offset : s.offset);
        shadow.ray.far = std::max(shadow.ray.far - s.distance, 0.0f);
        details.light.distance -= s.distance;
        details.width += details.spread * s.distance;
        active_[left++] = active_[k];
        continue;
      }
      const PlacedObject& placed = scene_.geometry->objects()[hits_[k].object];
      if (!placed.passable[placed.material_of(hits_[k].primitive)]) {
        shadow.contribution = Vec3(0);
        continue;
      }
      shader_->add(active_[k], shadow.ray, hits_[k], details.width, details.spread);
      active_[left++] = active_[k];
    }
    active_.resize(left);
    shader_->shade(faults, stats, [&](const CompiledMaterial& material, size_t begin, size_t end) {
      for (size_t k = begin; k < end; ++k) {
        Shadow& shadow = shadows_[shader_->owner(k)];
        ShadowDetails& details = details_[shader_->owner(k)];
        shadow.contribution *= shader_->straight_through(material, k);
        const ShadedPoint s = shader_->point(k);
        shadow.ray.origin = s.world - s.geometric_normal * s.offset;
        shadow.ray.far -= s.distance;
        details.light.distance -= s.distance;
        details.width = shader_->width(k);
        if (!(shadow.ray.far > 0)) shadow.ray.far = 0;
      }
    });
    std::erase_if(active_, [&](uint32_t index) {
      return is_black(shadows_[index].contribution) || shadows_[index].ray.far <= 0;
    });
  }
}

/// From where the active shadows are to what they meet next.
void ShadowTracer::track_volumes(int surface, FaultLog& faults, WorkerStats& stats) {
  flights_.clear(), glowing_.clear();
  for (size_t k = 0; k < active_.size(); ++k) {
    const Shadow& shadow = shadows_[active_[k]];
    const ShadowDetails& details = details_[active_[k]];
    Flight flight;
    flight.object = details.media.active();
    if (flight.object == Media::kNone) continue;
    flight.owner = active_[k];
    flight.ray = shadow.ray;
    if (hits_[k].found()) flight.ray.far = std::min(flight.ray.far, hits_[k].distance);
    if (flight.ray.far == kInfinity) continue; // an open mesh has no inside
    flight.width = details.width, flight.spread = details.spread;
    flight.sampler = details.sampler.fork(uint32_t(surface));
    bool glows = details.emitter == Emitter::Volume && details.light.object == flight.object;
    (glows ? glowing_ : flights_).push_back(flight);
  }
  fly(flights_, VolumeTracker::Mode::Transmittance, faults, stats);
  fly(glowing_, VolumeTracker::Mode::Glow, faults, stats);
}

void ShadowTracer::fly(std::vector<Flight>& flights, VolumeTracker::Mode mode, FaultLog& faults, WorkerStats& stats) {
  tracker_->run(flights, mode, faults, stats);
  for (const Flight& flight : flights) {
    Shadow& shadow = shadows_[flight.owner];
    details_[flight.owner].glow += shadow.contribution * flight.glow;
    shadow.contribution *= flight.faulted ? 0.0f : flight.weight;
  }
}

void ShadowTracer::ask_emitters(FaultLog& faults, WorkerStats& stats) {
  if (shader_) shader_->clear();
  for (uint32_t k = 0; k < count_; ++k) {
    const Shadow& shadow = shadows_[k];
    const ShadowDetails& details = details_[k];
    if (details.emitter == Emitter::Known || details.emitter == Emitter::Volume || is_black(shadow.contribution))
      continue;
    if (details.emitter == Emitter::Surface)
      shader_->add(k, shadow.ray, details.light, details.width, details.spread);
    else
      miss_shader_.add(k, shadow.ray.direction, details.spread);
  }
  miss_shader_.shade(faults, stats, [&](const MissShader::Arrival& a) {
    shadows_[a.owner].contribution *= a.faulted ? Vec3(0) : a.radiance;
  });
  if (!shader_) return;
  shader_->shade(faults, stats, [&](const CompiledMaterial& material, size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) {
      bool dark = shader_->faulted(k) || (material.emits_outward_only && shader_->backface(k));
      SurfaceValues values = shader_->values(k);
      shadows_[shader_->owner(k)].contribution *= dark ? Vec3(0) : values.emission * values.opacity;
    }
  });
}

} // namespace moonshade::renderer
