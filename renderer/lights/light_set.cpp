// Densities: uniform over area for meshes (weighted by luminance), over the visible cone for spheres and the sun, by
// bands of equal solid angle for the sky, by a table for surroundings, by mean emission along a line for volumes.
#include "renderer/lights/light_set.h"

#include "renderer/kernels/kernels.h"
#include "renderer/sampling/warp.h"

namespace moonshade::renderer {

/// Index of the first cumulative share above `u`, and `u` made uniform again within it.
uint32_t LightSet::choose(std::span<const float> cumulative, float& u) {
  // Where all weigh the same, the first guess is right.
  uint32_t index = std::min(uint32_t(u * float(cumulative.size())), uint32_t(cumulative.size() - 1));
  // Which of few it is, no branch could foresee.
  auto start_of = [&](uint32_t i) { return cumulative[i - (i > 0)] * float(i > 0); };
  float low = start_of(index);
  bool found = bool(int(low <= u) & (int(index + 1 == cumulative.size()) | int(u < cumulative[index])));
  if (!found) {
    const float* first = cumulative.data();
    for (size_t left = cumulative.size() - 1, half; left > 0; left -= half) { // nor which half
      half = (left + 1) / 2;
      first += __builtin_unpredictable(first[half - 1] <= u) ? half : 0;
    }
    index = uint32_t(first - cumulative.data());
    low = start_of(index);
  }
  float share = cumulative[index] - low;
  u = share > 0 ? std::clamp((u - low) / share, 0.0f, 0x1.fffffep-1f) : 0.0f;
  return index;
}

/// Running shares of the sum; false where all weights are zero.
static bool accumulate(std::vector<float>& weights) {
  double sum = 0;
  for (float w : weights)
    sum += w;
  if (!(sum > 0) || !std::isfinite(sum)) return false;
  double running = 0;
  for (float& w : weights)
    w = float((running += w) / sum);
  return true;
}

LightSet::LightSet(const Scene& scene, const Geometry& geometry, const VolumeSet& volumes,
                   std::vector<ObjectEmission> emission, std::vector<Environment> environments)
    : geometry_(geometry), scene_(scene), environments_(std::move(environments)),
      light_of_object_(scene.objects.size(), -1) {
  for (const Light& light : scene.lights) {
    if (light.kind == LightKind::Sky)
      add_sky(light);
    else if (light.kind != LightKind::Environment && !is_black(light.color))
      add_point_or_sun(light);
  }
  for (uint32_t k = 0; k < environments_.size(); ++k) {
    asks_shaders_ |= environments_[k].by_shader();
    Entry entry;
    entry.kind = Kind::Around;
    entry.around = k;
    formulas_only_ = false;
    if (!environments_[k].is_black()) {
      environment_.push_back(uint32_t(lights_.size()));
      lights_.push_back(std::move(entry));
    }
  }
  for (uint32_t id = 0; id < scene.objects.size(); ++id) {
    if (const Volume* volume = volumes.of(id); volume && volume->glow) {
      Entry entry;
      entry.kind = Kind::Volume;
      entry.object = id;
      entry.glow = volume->glow.get();
      light_of_object_[id] = int32_t(lights_.size());
      lights_.push_back(std::move(entry));
    }
    if (emission[id].mean.empty()) continue;
    const PlacedObject& placed = geometry.objects()[id];
    if (placed.object->shape == Shape::Mesh)
      add_mesh(placed, id, emission[id]);
    else
      add_sphere(placed, id, emission[id]);
  }
  for (uint32_t id : environment_)
    if (lights_[id].kind != Kind::Around) formulas_.push_back(formula_of(lights_[id]));
  for (const Entry& entry : lights_)
    choices_.push_back(choice_of(entry));
}

LightSet::Choice LightSet::choice_of(const Entry& entry) const {
  if (entry.kind == Kind::Mesh) return {entry.cumulative, entry.emitting.data(), entry.by_shader ? &entry : nullptr};
  if (entry.kind == Kind::Sky && formulas_only_) return {entry.cumulative, nullptr, nullptr};
  return {};
}

void LightSet::add_point_or_sun(const Light& light) {
  Entry entry;
  entry.kind = light.kind == LightKind::Sun ? Kind::Sun : light.kind == LightKind::Spot ? Kind::Spot : Kind::Point;
  entry.light = light;
  float half = 0.5f * light.angle * kPi / 180, sine = std::sin(0.5f * half);
  entry.one_minus_cos = 2 * sine * sine;
  entry.cos_outer = std::cos(half);
  entry.cos_inner = std::cos(half * (1 - light.blend));
  if (entry.kind == Kind::Sun) environment_.push_back(uint32_t(lights_.size()));
  lights_.push_back(std::move(entry));
}

EnvironmentLight LightSet::formula_of(const Entry& entry) {
  EnvironmentLight formula;
  formula.is_sky = entry.kind == Kind::Sky;
  if (formula.is_sky) {
    formula.zenith = entry.light.zenith, formula.horizon = entry.light.horizon, formula.ground = entry.light.ground;
    formula.density = entry.band_density.data();
  } else if (entry.one_minus_cos > 0) {
    formula.direction = entry.light.direction;
    formula.one_minus_cos = entry.one_minus_cos;
    formula.disc_density = 1 / (2 * kPi * entry.one_minus_cos);
    formula.radiance = entry.light.color / (2 * kPi * entry.one_minus_cos);
  }
  return formula;
}

static Vec3 radiance_at(const EnvironmentLight& sky, float height) {
  lanes::V3<float> radiance = sky_radiance(sky, height);
  return {radiance[0], radiance[1], radiance[2]};
}

void LightSet::add_sky(const Light& light) {
  EnvironmentLight sky;
  sky.zenith = light.zenith, sky.horizon = light.horizon, sky.ground = light.ground;
  Entry entry;
  entry.kind = Kind::Sky;
  entry.light = light;
  for (int band = 0; band < kSkyBands; ++band)
    entry.cumulative.push_back(luminance(radiance_at(sky, (float(band) + 0.5f) * 2 / kSkyBands - 1)));
  // Irradiance by the normal's height: rings of equal solid angle, each over all azimuths.
  constexpr int kNormals = 65, kAzimuths = 64;
  irradiance_.resize(kNormals);
  for (int i = 0; i < kNormals; ++i) {
    float y = -1 + 2.0f * float(i) / (kNormals - 1), x = std::sqrt(std::max(0.0f, 1 - y * y));
    Vec3 sum(0);
    for (int band = 0; band < kSkyBands; ++band) {
      float h = (float(band) + 0.5f) * 2 / kSkyBands - 1, r = std::sqrt(1 - h * h);
      float cosines = 0;
      for (int a = 0; a < kAzimuths; ++a)
        cosines += std::max(0.0f, x * r * std::cos((float(a) + 0.5f) * 2 * kPi / kAzimuths) + y * h);
      sum += radiance_at(sky, h) * (cosines / kAzimuths);
    }
    irradiance_[i] += sum * (4 * kPi / kSkyBands);
  }
  if (!accumulate(entry.cumulative)) return; // black
  for (size_t band = 0; band < kSkyBands; ++band) {
    float share = entry.cumulative[band] - (band ? entry.cumulative[band - 1] : 0.0f);
    entry.band_density.push_back(share * kSkyBands / (4 * kPi));
  }
  environment_.push_back(uint32_t(lights_.size()));
  lights_.push_back(std::move(entry));
}

void LightSet::add_mesh(const PlacedObject& placed, uint32_t id, const ObjectEmission& emission) {
  const Mesh& mesh = *placed.object->mesh;
  Entry entry;
  entry.kind = Kind::Mesh;
  entry.object = id;
  entry.by_shader = emission.by_shader;
  entry.triangle_pdf.assign(mesh.triangles.size(), 0.0f);
  double sum = 0;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3& e = emission.mean[t];
    if (!(luminance(e) > 0)) continue;
    entry.one_sided = scene_.materials[placed.material_of(t)].emits_outward_only;
    const Mesh::Corners& c = mesh.triangles[t];
    Vec3 a = placed.vertices[c[0]], b = placed.vertices[c[1]], d = placed.vertices[c[2]];
    float area = 0.5f * glm::length(glm::cross(b - a, d - a)), brightness = luminance(e);
    entry.triangles.push_back(t);
    entry.emitting.push_back(
        {a, brightness, b, placed.mirrored ? -1.0f : 1.0f, d, 0, entry.by_shader ? Vec3(1) : e, 1});
    entry.cumulative.push_back(area * brightness);
    sum += entry.cumulative.back();
  }
  entry.power = float(sum);
  if (entry.triangles.empty() || !accumulate(entry.cumulative)) return;
  for (size_t i = 0; i < entry.triangles.size(); ++i) {
    LightTriangle& t = entry.emitting[i];
    t.density = entry.triangle_pdf[entry.triangles[i]] = float(t.density / sum);
    t.one_sided = entry.one_sided ? 1.0f : 0.0f;
  }
  light_of_object_[id] = int32_t(lights_.size());
  lights_.push_back(std::move(entry));
}

void LightSet::add_sphere(const PlacedObject& placed, uint32_t id, const ObjectEmission& emission) {
  // A cone holds a sphere only where the object's matrix keeps it round.
  Mat3 gram = glm::transpose(placed.linear) * placed.linear;
  float s = placed.scale * placed.scale;
  bool round = true;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r)
      round &= std::abs(gram[c][r] - (c == r ? s : 0)) <= 1e-4f * s;
  if (placed.passable && placed.passable[placed.material_of(0)]) round = false; // its inner side shines through, too
  Entry entry;
  entry.kind = round ? Kind::Sphere : Kind::Ellipsoid;
  entry.object = id;
  entry.center = Vec3(placed.object->to_world[3]);
  entry.radius = placed.object->radius * placed.scale;
  entry.emission = emission.mean[0];
  entry.by_shader = emission.by_shader;
  light_of_object_[id] = int32_t(lights_.size());
  lights_.push_back(std::move(entry));
}

/// Of those that are formulas.
static void look(std::span<const EnvironmentLight> formulas, const Vec3& direction, Vec3& radiance, float& density) {
  lanes::V3<float> sum;
  surroundings(formulas.data(), formulas.size(), lanes::V3<float>{{direction.x, direction.y, direction.z}}, sum,
               density);
  radiance = {sum[0], sum[1], sum[2]};
}

Vec3 LightSet::environment(const Vec3& direction) const {
  Vec3 sum;
  float density;
  look(formulas_, direction, sum, density);
  for (const Environment& environment : environments_)
    sum += environment.radiance(direction);
  return sum;
}

float LightSet::entry_pdf(const Entry& entry, const Vec3& direction) const {
  if (entry.kind == Kind::Around) return environments_[entry.around].pdf(direction);
  EnvironmentLight formula = formula_of(entry);
  Vec3 radiance;
  float density;
  look({&formula, 1}, direction, radiance, density);
  return density;
}

float LightSet::environment_pdf(const Vec3& direction) const {
  Vec3 radiance;
  float sum;
  look(formulas_, direction, radiance, sum);
  for (const Environment& environment : environments_)
    if (!environment.is_black()) sum += environment.pdf(direction);
  return sum / float(lights_.size());
}

LightSample LightSet::sample_environment(const Vec3& direction) const {
  LightSample sample{direction, kInfinity, Vec3(1), environment_pdf(direction), false};
  if (asks_shaders_)
    sample.emitter = Emitter::Surroundings;
  else
    sample.radiance = environment(direction);
  return sample;
}

static void ask_surface(LightSample& sample, uint32_t object, uint32_t primitive) {
  sample.radiance = Vec3(1);
  sample.emitter = Emitter::Surface;
  sample.object = object, sample.primitive = primitive;
}

LightSample LightSet::sample_mesh(const Entry& entry, const Vec3& point, const Vec2& u) const {
  float within = u.x;
  uint32_t index = choose(entry.cumulative, within);
  const LightTriangle& t = entry.emitting[index];
  auto lane = [](const Vec3& v) { return lanes::V3<float>{{v.x, v.y, v.z}}; };
  AreaSample<float> area{lane(t.a), lane(t.b), lane(t.c), within, u.y, t.density, t.side, {t.one_sided != 0}, {}, 0, 0};
  sample_area(lane(point), area);
  LightSample sample;
  if (!(area.pdf > 0)) return sample;
  sample.direction = {area.direction[0], area.direction[1], area.direction[2]};
  sample.distance = area.distance;
  sample.pdf = area.pdf;
  sample.radiance = t.emission;
  if (entry.by_shader) ask_surface(sample, entry.object, entry.triangles[index]);
  return sample;
}

/// 1 - cos of the half angle under which a sphere is seen; 0 from inside.
static float sphere_cone(float radius, float squared_distance) {
  float sine2 = radius * radius / squared_distance;
  if (!(sine2 < 0.9999f)) return 0;
  return sine2 < 1e-3f ? sine2 * (0.5f + 0.125f * sine2) : 1 - std::sqrt(1 - sine2);
}

LightSample LightSet::sample_sphere(const Entry& entry, const Vec3& point, const Vec2& u) const {
  Vec3 to = entry.center - point;
  float squared = glm::dot(to, to);
  float one_minus_cos = sphere_cone(entry.radius, squared);
  LightSample sample;
  if (one_minus_cos <= 0) return sample;
  Frame frame(to / std::sqrt(squared));
  sample.direction = frame.to_world(sample_cone(u, one_minus_cos));
  double first, second;
  const PlacedObject& placed = geometry_.objects()[entry.object];
  if (!intersect_sphere(placed, point, sample.direction, first, second)) first = glm::dot(to, sample.direction);
  sample.distance = float(first);
  sample.radiance = entry.emission;
  sample.pdf = 1 / (2 * kPi * one_minus_cos);
  if (entry.by_shader) ask_surface(sample, entry.object, 0);
  return sample;
}

/// Density per area in the world of a point drawn uniformly on a sphere in object space, `unit` being its normal there.
float LightSet::ellipsoid_pdf(const PlacedObject& placed, const Vec3& unit) {
  float r = placed.object->radius, volume = placed.scale * placed.scale * placed.scale;
  return 1 / (4 * kPi * r * r * volume * glm::length(placed.normal_matrix * unit));
}

LightSample LightSet::sample_ellipsoid(const Entry& entry, const Vec3& point, const Vec2& u) const {
  const PlacedObject& placed = geometry_.objects()[entry.object];
  float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
  Vec3 unit(r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z);
  Vec3 to = Vec3(placed.object->to_world * Vec4(unit * placed.object->radius, 1)) - point;
  float squared = glm::dot(to, to);
  LightSample sample;
  if (!(squared > 0)) return sample;
  sample.distance = std::sqrt(squared);
  sample.direction = to / sample.distance;
  float cosine = std::abs(glm::dot(normalize_or(placed.normal_matrix * unit, unit), sample.direction));
  if (cosine == 0) return sample;
  sample.pdf = ellipsoid_pdf(placed, unit) * squared / cosine;
  sample.radiance = entry.emission;
  if (entry.by_shader) ask_surface(sample, entry.object, 0);
  return sample;
}

LightSample LightSet::sample_point(const Entry& entry, const Vec3& point) const {
  Vec3 to = entry.light.position - point;
  float squared = glm::dot(to, to);
  if (!(squared > 0)) return {};
  float distance = std::sqrt(squared);
  LightSample sample{to / distance, distance, entry.light.color / squared, 1, true};
  if (entry.kind == Kind::Spot) sample.radiance *= spot_share(entry, sample.direction);
  return sample;
}

/// Of a spot's intensity along its axis, in the direction opposite to `to_light`.
float LightSet::spot_share(const Entry& entry, const Vec3& to_light) {
  float cosine = -glm::dot(to_light, entry.light.direction);
  if (cosine <= entry.cos_outer) return 0;
  if (cosine >= entry.cos_inner) return 1;
  float t = (cosine - entry.cos_outer) / (entry.cos_inner - entry.cos_outer);
  return t * t * (3 - 2 * t);
}

LightSample LightSet::sample_volume(const Entry& entry, const Vec3& point, const Vec2& u, float w) const {
  Vec3 to = entry.glow->sample(u, w).world - point;
  LightSample sample;
  sample.direction = normalize_or(to, Vec3(0));
  if (is_black(sample.direction)) return sample;
  GlowGrid::Line line = entry.glow->line(point, sample.direction);
  sample.pdf = line.pdf;
  sample.distance = line.far * (1 + 1e-3f); // the grid's box holds the volume but for rounding
  sample.radiance = Vec3(1);
  sample.emitter = Emitter::Volume;
  sample.object = entry.object;
  return sample;
}

float LightSet::volume_pdf(uint32_t object, const Vec3& from, const Vec3& direction) const {
  int32_t light = light_of_object_[object];
  return light < 0 ? 0 : lights_[size_t(light)].glow->line(from, direction).pdf / float(lights_.size());
}

LightSample LightSet::sample_light(size_t light, const Vec3& point, const Vec2& u, float w) const {
  const Entry& entry = lights_[light];
  if (entry.kind != Kind::Sun) return sample_entry(entry, point, u, w);
  Vec3 direction = entry.light.direction;
  if (entry.one_minus_cos > 0) direction = Frame(direction).to_world(sample_cone(u, entry.one_minus_cos));
  return {direction, kInfinity, entry.light.color, 1, true};
}

/// Of a place within a band.
static float sky_height(uint32_t band, float within) {
  return std::clamp((float(band) + within) * 2 / kSkyBands - 1, -1.0f, 1.0f);
}

void LightSet::look_up(ScatterBlock& block, size_t count, LightSample* others) const {
  static const LightTriangle kNone;
  for (size_t i = 0; i < kLanes; ++i)
    block.triangles[i] = &kNone, block.sky[i] = block.delta[i] = 0, block.light_pdf[i] = 0;
  for (size_t i = 0; i < count; ++i) {
    const Choice& choice = choices_[block.light[i]];
    others[i].emitter = Emitter::Known;
    if (choice.cumulative.empty()) {
      look_up_other(block, i, others[i]);
      continue;
    }
    // Triangle or sky: no branch, which nobody could foresee.
    uint32_t index = choose(choice.cumulative, block.light_u[i]);
    block.triangles[i] = choice.emitting ? choice.emitting + index : &kNone;
    block.sky[i] = !choice.emitting;
    block.height[i] = sky_height(index, block.light_u[i]);
    if (const Entry* entry = choice.by_shader) ask_surface(others[i], entry->object, entry->triangles[index]);
  }
}

void LightSet::look_up_other(ScatterBlock& block, size_t i, LightSample& found) const {
  Vec3 point(block.point[0][i], block.point[1][i], block.point[2][i]);
  found = sample_of(block.light[i], point, {block.light_u[i], block.light_v[i]}, block.light_w[i]);
  for (int c = 0; c < 3; ++c)
    block.to_light[c][i] = found.direction[c], block.radiance[c][i] = found.radiance[c];
  block.light_distance[i] = found.distance, block.light_pdf[i] = found.pdf;
  block.delta[i] = found.delta;
}

LightSample LightSet::sample_entry(const Entry& entry, const Vec3& point, const Vec2& u, float w) const {
  switch (entry.kind) {
  case Kind::Mesh:
    return sample_mesh(entry, point, u);
  case Kind::Sphere:
    return sample_sphere(entry, point, u);
  case Kind::Sun:
    if (entry.one_minus_cos <= 0) return {entry.light.direction, kInfinity, entry.light.color, 1, true};
    return sample_environment(Frame(entry.light.direction).to_world(sample_cone(u, entry.one_minus_cos)));
  case Kind::Sky: {
    Vec2 within = u;
    lanes::V3<float> d = direction_at_height(sky_height(choose(entry.cumulative, within.x), within.x), within.y);
    return sample_environment({d[0], d[1], d[2]});
  }
  case Kind::Around:
    return sample_environment(environments_[entry.around].sample(u));
  case Kind::Ellipsoid:
    return sample_ellipsoid(entry, point, u);
  case Kind::Volume:
    return sample_volume(entry, point, u, w);
  case Kind::Point:
  case Kind::Spot:
    break;
  }
  return sample_point(entry, point);
}

LightSample LightSet::sample_of(size_t light, const Vec3& point, const Vec2& u, float w) const {
  LightSample sample = sample_entry(lights_[light], point, u, w);
  if (sample.distance < kInfinity || sample.delta) sample.pdf /= float(lights_.size()); // the mixture's already is
  return sample;
}

LightSample LightSet::sample(const Vec3& point, float choice, const Vec2& u) const {
  if (lights_.empty()) return {};
  float place = choice * float(lights_.size());
  size_t light = std::min(size_t(place), lights_.size() - 1);
  return sample_of(light, point, u, place - float(light));
}

float LightSet::object_pdf(uint32_t object, uint32_t primitive, const Vec3& from, const Vec3& direction, float distance,
                           const Vec3& normal) const {
  int32_t light = light_of_object_[object];
  if (light < 0) return 0;
  const Entry& entry = lights_[size_t(light)];
  if (entry.kind == Kind::Sphere) {
    Vec3 to = entry.center - from;
    float one_minus_cos = sphere_cone(entry.radius, glm::dot(to, to));
    return one_minus_cos > 0 ? 1 / (2 * kPi * one_minus_cos * float(lights_.size())) : 0;
  }
  float cosine = std::abs(glm::dot(normal, direction));
  if (!(cosine > 0)) return 0;
  if (entry.kind == Kind::Ellipsoid) {
    const PlacedObject& placed = geometry_.objects()[object];
    Vec3 unit = normalize_or(glm::transpose(placed.linear) * normal, normal);
    return ellipsoid_pdf(placed, unit) * distance * distance / (cosine * float(lights_.size()));
  }
  return entry.triangle_pdf[primitive] * distance * distance / (cosine * float(lights_.size()));
}

Vec3 LightSet::sky_irradiance(const Vec3& normal) const {
  Vec3 around(0);
  for (const Environment& environment : environments_)
    around += environment.irradiance(normal);
  if (irradiance_.empty()) return around;
  float at = (normal.y + 1) * 0.5f * float(irradiance_.size() - 1);
  size_t low = std::min(size_t(std::max(at, 0.0f)), irradiance_.size() - 2);
  return around + glm::mix(irradiance_[low], irradiance_[low + 1], at - float(low));
}

} // namespace moonshade::renderer
