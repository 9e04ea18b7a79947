#include "renderer/integrators/irradiance_cache.h"

#include "renderer/camera.h"
#include "renderer/geometry/float_environment.h"
#include "renderer/lights/emission.h"
#include "renderer/sampling/warp.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace moonshade::renderer {

static constexpr int kSpacing = 6;     ///< pixels between records
static constexpr float kReach = 3;     ///< spacings over which a record counts
static constexpr uint32_t kRays = 256; ///< of a record, a round
static constexpr uint32_t kRecordsATask = 16;
static constexpr uint32_t kMostRounds = 3;
static constexpr uint32_t kDimension = 0;

struct IrradianceCache::Worker {
  Worker(const PreparedScene& scene, VolumeControls& controls)
      : rays(kRecordsATask * kRays), hits(rays.size()), shadows(scene, controls, rays.size()) {}
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  ShadowTracer shadows;
  WorkerStats stats;
  FaultLog faults;
};

IrradianceCache::IrradianceCache(const PreparedScene& scene, tbb::task_arena& arena, WorkerStats& stats,
                                 FaultLog& faults)
    : scene_(scene), colors_(average_colors(scene.scene, *scene.geometry, scene.materials)) {
  std::vector<Place> places = place_records();
  // As measured, whatever passes have raised: a resumed render gathers the same.
  VolumeControls controls(*scene.volumes);
  std::vector<std::unique_ptr<Worker>> workers(size_t(arena.max_concurrency()));
  uint32_t rounds = std::min(kMostRounds, std::max(1u, scene.scene.settings.depth) - 1);
  for (uint32_t round = 0; round < rounds; ++round)
    run_round(places, round, arena, controls, workers);
  for (const auto& worker : workers) {
    if (!worker) continue;
    stats += worker->stats;
    for (const auto& [key, count] : worker->faults)
      faults[key] += count;
  }
}

/// What the middles of some pixels see; volumes are looked through.
std::vector<IrradianceCache::Place> IrradianceCache::place_records() const {
  const Settings& settings = scene_.scene.settings;
  CameraRays camera(scene_.scene.camera, settings.width, settings.height);
  std::vector<Place> places;
  for (int y = kSpacing / 2; y < settings.height; y += kSpacing)
    for (int x = kSpacing / 2; x < settings.width; x += kSpacing) {
      Ray ray = camera.ray(float(x) + 0.5f, float(y) + 0.5f);
      for (int surface = 0; surface < 16; ++surface) {
        Hit hit;
        scene_.geometry->closest({&ray, 1}, &hit);
        if (!hit.found()) break;
        SurfacePoint s = scene_.geometry->surface(ray, hit);
        Vec3 normal = glm::dot(s.geometric_normal, ray.direction) > 0 ? -s.geometric_normal : s.geometric_normal;
        ray.origin = s.world - normal * s.offset;
        if (scene_.volumes->of(hit.object)) continue;
        places.push_back({s.world, normal, s.offset});
        break;
      }
    }
  return places;
}

void IrradianceCache::run_round(const std::vector<Place>& places, uint32_t round, tbb::task_arena& arena,
                                VolumeControls& controls, std::vector<std::unique_ptr<Worker>>& workers) {
  std::vector<Vec3> irradiance(places.size(), Vec3(0));
  uint32_t count = uint32_t(places.size()), tasks = (count + kRecordsATask - 1) / kRecordsATask;
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<uint32_t>(0, tasks, 1),
        [&](const tbb::blocked_range<uint32_t>& range) {
          DefaultFloatEnvironment environment;
          auto& worker = workers[size_t(tbb::this_task_arena::current_thread_index())];
          if (!worker) worker = std::make_unique<Worker>(scene_, controls);
          for (uint32_t task = range.begin(); task < range.end(); ++task) {
            uint32_t first = task * kRecordsATask, n = std::min(kRecordsATask, count - first);
            gather(std::span(places).subspan(first, n), first, round, *worker, irradiance.data() + first);
          }
        },
        tbb::simple_partitioner());
  });
  std::vector<Photon> records(places.size());
  DVec3 sum(0);
  for (size_t k = 0; k < places.size(); ++k) {
    records[k].position = places[k].point, records[k].normal = places[k].normal;
    records[k].power = irradiance[k];
    sum += DVec3(irradiance[k]);
  }
  mean_ = places.empty() ? Vec3(0) : Vec3(sum / double(places.size()));
  records_ = PhotonMap(std::move(records), 1, 1);
}

void IrradianceCache::gather(std::span<const Place> places, uint32_t first, uint32_t round, Worker& worker,
                             Vec3* irradiance) const {
  uint32_t seed = scene_.scene.settings.seed ^ 0x69727261u;
  size_t count = places.size() * kRays;
  auto sampler_of = [&](size_t ray) { return Sampler(seed, first + uint32_t(ray / kRays), uint32_t(ray % kRays)); };
  for (size_t k = 0; k < count; ++k) {
    const Place& place = places[k / kRays];
    Vec3 direction = Frame(place.normal).to_world(sample_cosine_hemisphere(sampler_of(k).two(kDimension)));
    worker.rays[k] = {place.point + place.normal * place.offset, 0, normalize_or(direction, place.normal), kInfinity};
  }
  double start = thread_seconds();
  scene_.geometry->closest({worker.rays.data(), count}, worker.hits.data());
  worker.stats.rays += count;
  worker.stats.trace_seconds += thread_seconds() - start;
  // Each ray brings color / pi * (direct + indirect) of a mean of pi * radiance.
  auto bring = [&](size_t k, const Vec3& radiance) { irradiance[k / kRays] += radiance * (kPi / kRays); };
  for (size_t k = 0; k < count; ++k) {
    const Hit& hit = worker.hits[k];
    if (!hit.found() || scene_.volumes->of(hit.object)) continue;
    SurfacePoint s = scene_.geometry->surface(worker.rays[k], hit);
    Vec3 normal = glm::dot(s.geometric_normal, worker.rays[k].direction) > 0 ? -s.geometric_normal : s.geometric_normal;
    Vec3 albedo = colors_[hit.object] * kInvPi;
    // The footprint of a ray among as many: it covers its share of the hemisphere.
    float width = s.distance * 0.15f / kSpacing;
    if (round > 0) bring(k, albedo * at(s.world, normal, width));
    if (scene_.lights->count() == 0) continue;
    Sampler sampler = sampler_of(k);
    LightSample light = scene_.lights->sample(s.world, sampler.one(kDimension + 1 + 2 * round),
                                              sampler.two(kDimension + 2 + 2 * round));
    float cosine = glm::dot(light.direction, normal);
    if (!(light.pdf > 0) || is_black(light.radiance) || cosine <= 0) continue;
    Shadow shadow;
    shadow.ray = {s.world + normal * s.offset, 0, light.direction, shadow_end(light.distance, s.offset)};
    shadow.owner = uint32_t(k);
    shadow.contribution = albedo * light.radiance * (cosine / light.pdf);
    if (!worker.shadows.wants_details()) {
      worker.shadows.add(shadow);
      continue;
    }
    ShadowDetails details;
    details.width = width * kSpacing;
    details.emitter = light.emitter;
    details.light = {light.object, light.primitive, light.distance};
    details.sampler = sampler.fork(round);
    worker.shadows.add(shadow, details);
  }
  worker.shadows.trace(worker.faults, worker.stats, bring);
}

Vec3 IrradianceCache::at(const Vec3& point, const Vec3& normal, float width) const {
  float radius = kReach * kSpacing * width;
  for (int wider = 0; wider < 6; ++wider, radius *= 2) {
    Vec3 sum(0);
    float weights = 0;
    records_.near(point, radius, [&](const Photon& record) {
      float facing = glm::dot(record.normal, normal);
      Vec3 apart = record.position - point;
      // Records on other surfaces see other things: none from before or behind this one.
      float height = std::abs(glm::dot(apart, normal)) / radius;
      if (facing < 0.5f || height > 0.3f) return;
      float near = 1 - glm::dot(apart, apart) / (radius * radius);
      float weight = near * near * facing * facing * (1 - height / 0.3f) + 1e-6f;
      sum += record.power * weight;
      weights += weight;
    });
    if (weights > 1e-5f) return sum / weights;
  }
  return mean_;
}

} // namespace moonshade::renderer
