#include "apps/lab/oracle/reference/tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/lab/oracle/facet_lobes.h"
#include "apps/lab/oracle/reference/emitters.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

using core::RayKind;
using core::Vec3d;

/// Returns the direction of a light's cone, from the unit octahedron unfolded on a square: the corners are its lower half.
Vec3d ahead_of(const core::LightSpread& spread) {
  const double x = spread.ahead[0] / 32767.5 - 1, y = spread.ahead[1] / 32767.5 - 1, z = 1 - std::fabs(x) - std::fabs(y);
  const Vec3d below{std::copysign(1 - std::fabs(y), x), std::copysign(1 - std::fabs(x), y), z};
  return normalize(z < 0 ? below : Vec3d{x, y, z});
}

double cosine_of(std::uint16_t angle) { return std::cos((angle & 0x7fff) * (std::numbers::pi / 32767)); }

/// Returns the fraction of a light left by the distance and cone in its record, which the judges decode independently.
double left_of(const core::LightSpread& spread, const Vec3d& towards, double distance) {
  const double near = spread.falls_off() ? 1 / (distance * distance) : 1;
  if (!spread.is_cone()) {
    return near;
  }
  const double cosine = -dot(towards, ahead_of(spread)), first = cosine_of(spread.full), second = cosine_of(spread.none),
               full = std::max(first, second), none = std::min(first, second);
  const double t = cosine >= full ? 1 : cosine <= none ? 0 : (cosine - none) / (full - none);
  return near * (first < second ? t * t : spread.is_smooth() ? t * t * (3 - 2 * t) : t);
}

/// Offset of a secondary ray from its surface, relative to the body's coordinates and radius, as a point is computed to some
/// 1e-16 of them. Nothing else in the scene, however large, moves a shadow.
constexpr double gap = 1e-13;
/// A shadow ray ends this share of its length before the light, so that a surface through the light does not hide it.
constexpr double light_gap = 1e-9;
/// The largest depth that a ray's record can hold.
constexpr int depth_limit = 255;

/// Alpha nearer than this to 0 or 1 counts as that, as in the product.
constexpr double alpha_rounding = 0x1p-16;

Vec3d mirrored(const Vec3d& direction, const Vec3d& normal) { return direction - normal * (2 * dot(direction, normal)); }

/// Veach's power heuristic, for light that another technique might have found.
double share_of(double own, double other) { return std::isinf(own) ? 1 : own * own / (own * own + other * other); }

double start_gap(const ReferenceBody& body) {
  const double coordinate = core::max_over(body.place, double{0}, [&](const Vec3d& place) { return largest_component(place); });
  const double radius = std::max(std::fabs(body.radius[0]), std::fabs(body.radius[1]));
  return gap * (coordinate + radius);
}

double brightest(const Vec3d& color) { return std::max({color.x, color.y, color.z}); }

/// Judges in single precision, as the product does.
bool brings_nothing(const ReferenceRay& shadow) { return core::Color(shadow.weight) == core::Color{}; }

}  // namespace

struct ReferenceTracer::Touch {
  const ReferenceRay& ray;
  std::uint32_t body;
  const core::Material& material;
  ReferenceSurface surface;
  Vec3d normal;            ///< for shading: on the ray's side, interpolated between a patch's normals
  double index = 1;        ///< ratio of refractive indices: the ray's side over the other side
  double cone = 0;         ///< the width here of the cones of the rays that leave
  ReferenceReach reach{};  ///< the ray's
  Vec3d color;             ///< diffuse colour, with texture or vertex colours
  Vec3d specular;          ///< colour of highlight and mirror
  Vec3d emission;
  double diffuse = 0, transmittance = 0;
  double there = 1;  ///< the share of the surface that is present according to alpha

  /// For paths, if the material has microfacets.
  bool has_facets = false;
  core::Microfacets facets_there;  ///< with the effect of textures
  FacetLobes<double> facets() const {
    const core::Microfacets& facets = facets_there;
    const double side = dot(ray.direction, surface.normal) > 0 ? -1 : 1;
    const double shown = there * facets.opacity, dielectric = shown * (1 - facets.metallic);
    return FacetLobes<double>({.base = color,
                               .metallic = facets.metallic,
                               .alpha = facets.roughness * facets.roughness,
                               .reflectance = facets.reflectance,
                               .there = shown,
                               .matt = dielectric * (1 - facets.transmission),
                               .absent = 1 - shown,
                               .passing = dielectric * facets.transmission * (color.x + color.y + color.z) / 3,
                               .index = index,
                               .direction = ray.direction,
                               .normal = normal,
                               .true_normal = surface.normal * side});
  }

  /// Returns the square of the cosine behind the surface by Snell's law; below 0 all light is reflected.
  double refracted_cosine_squared() const {
    const double cosine = dot(ray.direction, normal);
    return 1 - index * index * (1 - cosine * cosine);
  }
  bool transmits() const { return transmittance > 0 && refracted_cosine_squared() >= 0; }
  Vec3d bent_direction() const {
    const double cosine = -dot(ray.direction, normal), behind = std::sqrt(refracted_cosine_squared());
    return ray.direction * index + normal * (index * cosine - behind);
  }
};

Vec3d ReferenceTracer::radiance(ReferenceRay ray) {
  const ReferenceHit hit = trace(ray);
  if (!hit.found()) {
    return ray.weight * light_beyond(ray);
  }
  const Touch met = touch(ray, hit);
  Vec3d sum = glow(met);
  for (ReferenceRay& child : spawned(met)) {
    if (child.kind != RayKind::shadow) {
      sum = sum + radiance(child);
    } else if (!trace(child).found()) {
      sum = sum + child.weight;
    }
  }
  return sum;
}

Vec3d ReferenceTracer::glow(const ReferenceRay& ray, const ReferenceHit& hit) const { return glow(touch(ray, hit)); }

Vec3d ReferenceTracer::glow(const Touch& touch) const {
  return touch.ray.weight * (touch.emission + scene_.ambient * (touch.color * touch.diffuse));
}

std::vector<ReferenceRay> ReferenceTracer::spawned(const ReferenceRay& ray, const ReferenceHit& hit) const {
  return spawned(touch(ray, hit));
}

std::vector<ReferenceRay> ReferenceTracer::spawned(const Touch& met) const {
  std::vector<ReferenceRay> rays;
  rays.reserve(scene_.lights.size() + 2);
  if (options_.transport.is_by_paths() && met.ray.depth > options_.depth_max) {
    return rays;  // it has found an emitter
  }
  add_shadow_rays(met, rays);
  if (options_.transport.is_by_paths()) {
    add_light_sample_ray(met, rays);
    add_path_ray(met, rays);
    return rays;
  }
  if (met.ray.depth < options_.depth_max) {
    add_children(met, rays);
  }
  return rays;
}

ReferenceHit ReferenceTracer::trace(ReferenceRay& ray) {
  ++rays_;
  if (watcher_ != nullptr) {
    watcher_->shoot(ray);
  }
  const ReferenceHit hit = ray.kind == RayKind::shadow ? finder_.any(ray) : finder_.closest(ray);
  if (watcher_ != nullptr) {
    watcher_->end(ray, hit);
  }
  return hit;
}

ReferenceTracer::Touch ReferenceTracer::touch(const ReferenceRay& ray, const ReferenceHit& hit) const {
  const ReferenceBody& body = scene_.bodies[hit.body];
  Touch result{ray, hit.body, scene_.materials[body.material], surface_at(body, ray, hit.t), {}, 1, 0, {}, {}, {}, {}};
  if (watcher_ != nullptr) {
    watcher_->touch(ray, body, result.surface);
  }
  const bool leaving = dot(ray.direction, result.surface.normal) > 0;
  result.normal = leaving ? -result.surface.normal : result.surface.normal;
  if (body.is_smooth()) {
    Vec3d blend;
    for (std::size_t k = 0; k < 3; ++k) {
      blend = blend + scene_.normals[body.first_normal + k] * result.surface.weight[k];
    }
    const double size = length(blend);
    result.normal = size > 0 ? blend * ((dot(blend, result.normal) < 0 ? -1 : 1) / size) : result.normal;
  }
  const double inside = result.material.refraction_index > 0 ? result.material.refraction_index : 1;
  result.index = leaving ? inside : 1 / inside;
  const double share = options_.pixel_share / std::sqrt(static_cast<double>(options_.first_samples)), distance = ray.cone + hit.t;
  const bool is_primary = ray.kind == RayKind::primary;
  result.cone = share * narrow_angle(ray) * (is_primary ? distance : hit.t) + (is_primary ? 0 : ray.cone);
  result.reach = is_primary ? ReferenceReach{ray.apart[0] * (share * distance), ray.apart[1] * (share * distance)}
                            : cone_about(ray.direction, result.cone);
  finish(result);
  return result;
}

/// If metal and roughness have a shown texture, too, both use the footprint on the finer of the two.
ReferenceTexel ReferenceTracer::look_up(const Touch& touch, const core::Texture& texture) const {
  const ReferenceBody& body = scene_.bodies[touch.body];
  ReferencePaint paint{.corner = body.place, .place = {}};
  std::copy_n(scene_.places.begin() + body.first_place, paint.place.size(), paint.place.begin());
  const auto texels = [](const core::Texture& of) { return static_cast<double>(of.levels[0].width) * of.levels[0].height; };
  const core::Texture* finer = &scene_.textures[touch.material.texture];
  if (touch.has_facets && touch.material.microfacets.have_texture()) {
    const core::Texture& facets = scene_.textures[touch.material.microfacets.texture];
    finer = texels(facets) > texels(*finer) ? &facets : finer;
  }
  ReferenceFootprint footprint = footprint_of(paint, *finer, touch.surface.weight, touch.ray.direction, touch.reach);
  footprint.width *= std::sqrt(texels(texture) / texels(*finer));
  if (watcher_ != nullptr) {
    watcher_->look_up(footprint);
  }
  return texture_sum(texture, footprint);
}

/// Returns metal and roughness at the hit.
core::Microfacets ReferenceTracer::facets_of(const Touch& touch) const {
  core::Microfacets facets = touch.material.microfacets;
  if (touch.has_facets && facets.have_texture()) {
    const ReferenceTexel shares = look_up(touch, scene_.textures[facets.texture]);
    facets.metallic *= shares.light.z;
    facets.roughness *= shares.light.y;
  }
  return facets;
}

/// Returns the colour from a texture, or from the colours of the corners; alpha does not affect light.
ReferenceTexel ReferenceTracer::paint_of(const Touch& touch) const {
  const ReferenceBody& body = scene_.bodies[touch.body];
  if (body.has_colors()) {
    ReferenceTexel sum;
    for (std::size_t k = 0; k < 3; ++k) {
      sum = sum + scene_.colors[body.first_color + k] * touch.surface.weight[k];
    }
    return sum;
  }
  if (!body.is_textured()) {
    return {{1, 1, 1}, 1};
  }
  const core::Texture& texture = scene_.textures[touch.material.texture];
  const ReferenceTexel sum = look_up(touch, texture);
  return texture.format != core::TexelFormat::srgb_alpha
             ? ReferenceTexel{sum.light, 1}
             : ReferenceTexel{sum.light * (sum.alpha > 0 ? 1 / sum.alpha : 0), sum.alpha};
}

/// The file's cutoff, like its texels' alpha, has few digits: alpha within half of 1/65,535 of the cutoff is kept.
bool is_cut_away(double alpha, const core::Material& material) {
  constexpr double steps = 65535;
  return alpha * steps < std::max(1.0, std::floor(material.alpha_cutoff * steps + 0.5)) - 0.5;
}

/// Sets how the surface scatters light at the hit, weighted by alpha.
void ReferenceTracer::finish(Touch& touch) const {
  const core::Material& material = touch.material;
  touch.has_facets = options_.transport.is_by_paths() && material.microfacets.are_there();
  touch.facets_there = facets_of(touch);
  const ReferenceTexel paint = paint_of(touch);
  const double alpha = paint.alpha > 1 - alpha_rounding ? 1 : paint.alpha < alpha_rounding ? 0 : paint.alpha;
  const double there = material.alpha == core::AlphaUse::none    ? 1
                       : material.alpha == core::AlphaUse::blend ? alpha
                       : is_cut_away(alpha, material)            ? 0
                                                                 : 1;
  touch.color = material.color * paint.light;
  touch.diffuse = material.diffuse * there;
  touch.specular = (material.specular_color * material.specular + touch.color * material.tinted_specular) * there;
  touch.transmittance = material.transmittance * there + (1 - there);
  touch.emission = material.emission * (there * mis_weight(touch));
  touch.index = there > 0 ? touch.index : 1;
  touch.there = there;
}

ReferenceRay ReferenceTracer::child(const Touch& touch, const Vec3d& towards, RayKind kind) const {
  const double side = dot(towards, touch.surface.normal) < 0 ? -1 : 1;
  ReferenceRay ray;
  ray.origin = touch.surface.point + touch.surface.normal * (side * start_gap(scene_.bodies[touch.body]));
  ray.direction = normalize(towards);
  ray.ignored_body = touch.body;
  ray.weight = touch.ray.weight;
  ray.depth = touch.ray.depth + (kind == RayKind::shadow ? 0 : 1);
  ray.kind = kind;
  ray.cone = kind == RayKind::shadow ? 0 : touch.cone;
  ray.apart = touch.ray.apart;
  ray.pixel = touch.ray.pixel;
  ray.sample = touch.ray.sample;
  return ray;
}

/// Each has the diffuse light and Phong's highlight that it brings unless the light is blocked.
void ReferenceTracer::add_shadow_rays(const Touch& touch, std::vector<ReferenceRay>& rays) const {
  const Vec3d mirror = mirrored(touch.ray.direction, touch.normal);
  for (std::uint32_t index = 0; index < scene_.lights.size(); ++index) {
    const ReferenceLight& light = scene_.lights[index];
    const Vec3d towards = light.position - touch.surface.point;
    const double distance = length(towards);
    const double share = distance > 0 ? left_of(light.spread, towards * (1 / distance), distance) : 0;
    const double cosine = share > 0 ? dot(towards, touch.normal) / distance : 0;
    if (!(cosine > 0) && options_.convention == core::Convention::haines) {
      continue;
    }
    ReferenceRay ray = child(touch, towards, RayKind::shadow);
    const Vec3d from_start = light.position - ray.origin;
    ray.direction = normalize(from_start);
    ray.t_max = length(from_start) * (1 - light_gap);
    ray.light = index;
    ray.weight = {};
    if (cosine > 0 && touch.has_facets) {
      ray.weight =
          touch.ray.weight * light.intensity * share * touch.facets().response(towards * (1 / distance)).value * std::numbers::pi;
    } else if (cosine > 0) {
      const double lobe = std::clamp(dot(mirror, towards) / distance, 0.0, 1.0);
      const double highlight = touch.specular == Vec3d{} ? 0 : std::pow(lobe, touch.material.shine);
      ray.weight =
          touch.ray.weight * light.intensity * share * (touch.color * (touch.diffuse * cosine) + touch.specular * highlight);
    }
    if (options_.convention == core::Convention::paper || !brings_nothing(ray)) {
      rays.push_back(ray);
    }
  }
}

/// Adds the mirrored ray and the one through glass. Light that cannot be transmitted is reflected.
void ReferenceTracer::add_children(const Touch& touch, std::vector<ReferenceRay>& rays) const {
  const double total = touch.transmits() ? 0 : touch.transmittance;
  const Vec3d mirrored_share = touch.specular * touch.material.mirror + Vec3d{total, total, total};
  if (!(mirrored_share == Vec3d{})) {
    ReferenceRay reflected = child(touch, mirrored(touch.ray.direction, touch.normal), RayKind::reflected);
    reflected.weight = reflected.weight * mirrored_share;
    rays.push_back(reflected);
  }
  if (touch.transmits()) {
    ReferenceRay refracted = child(touch, touch.bent_direction(), RayKind::refracted);
    refracted.weight = refracted.weight * touch.transmittance;
    rays.push_back(refracted);
  }
}

Vec3d ReferenceTracer::sky(const Vec3d& direction) const {
  const core::Transport& transport = options_.transport;
  const double height = transport.has_gradient ? std::max(0.0, dot(direction, Vec3d(transport.up))) : 0.0;
  return scene_.background * (1 - height) + Vec3d(transport.zenith) * height;
}

/// Scattered rays do not see a background.
Vec3d ReferenceTracer::light_beyond(const ReferenceRay& ray) const {
  return options_.transport.has_sky ? sky(ray.direction) : ray.kind == RayKind::scattered ? Vec3d{} : scene_.background;
}

/// How a surface scatters light, in each channel.
struct ReferenceTracer::Ways {
  Vec3d scattered, mirrored, through;

  double all() const { return brightest(scattered) + brightest(mirrored) + brightest(through); }
};

ReferenceTracer::Ways ReferenceTracer::ways_of(const Touch& touch) {
  const double total = touch.transmits() ? 0 : touch.transmittance, through = touch.transmits() ? touch.transmittance : 0;
  return {touch.color * touch.diffuse,
          touch.specular * touch.material.mirror + Vec3d{total, total, total},
          {through, through, through}};
}

/// Returns nothing if the direction leads into the surface.
std::optional<Vec3d> ReferenceTracer::scattered_direction(const Touch& touch) {
  const ReferenceRay& ray = touch.ray;
  const Vec3d towards =
      core::cosine_direction(core::pair_of(ray.pixel, ray.sample, ray.depth, core::Purpose::direction), touch.normal);
  const bool is_outside = dot(towards, touch.surface.normal) * dot(ray.direction, touch.surface.normal) < 0;
  return is_outside ? std::optional(towards) : std::nullopt;
}

double ReferenceTracer::scattered_density(const Touch& touch, const Vec3d& towards) {
  if (touch.has_facets) {
    return touch.facets().response(towards).density;
  }
  const Ways ways = ways_of(touch);
  const double cosine = dot(towards, touch.normal);
  const bool is_outside = dot(towards, touch.surface.normal) * dot(touch.ray.direction, touch.surface.normal) < 0;
  return cosine > 0 && is_outside && ways.all() > 0 ? brightest(ways.scattered) / ways.all() * cosine / std::numbers::pi : 0;
}

/// Samples one emitter, weighted by how rarely a path's own ray would find it.
void ReferenceTracer::add_light_sample_ray(const Touch& touch, std::vector<ReferenceRay>& rays) const {
  const ReferenceRay& from = touch.ray;
  if (scene_.emitters.empty() || from.depth > options_.depth_max || from.depth >= depth_limit) {
    return;
  }
  const auto pair = [&from](core::Purpose purpose) { return core::pair_of(from.pixel, from.sample, from.depth, purpose); };
  const auto target = aim_from(scene_, touch.surface.point, pair(core::Purpose::place), pair(core::Purpose::emitter));
  if (!target) {
    return;
  }
  ReferenceRay ray = child(touch, target->way, RayKind::shadow);
  const double density = scattered_density(touch, ray.direction);
  if (!(density > 0)) {
    return;
  }
  const ReferenceBody& body = scene_.bodies[target->body];
  const double other = core::density_of(core::density_bits(density));
  const Vec3d place = touch.surface.point + target->way;
  const double share = share_of(light_sampling_density(scene_, body, touch.surface.point, place, target->normal), other);
  const Vec3d reflected = touch.has_facets ? touch.facets().response(ray.direction).value
                                           : touch.color * (touch.diffuse * dot(ray.direction, touch.normal) / std::numbers::pi);
  ray.weight = from.weight * scene_.materials[body.material].emission * reflected * (share / target->density);
  const Vec3d way = place - ray.origin;
  ray.direction = normalize(way);
  ray.t_max = length(way) * (1 - light_gap);
  if (!brings_nothing(ray)) {
    rays.push_back(ray);
  }
}

/// Returns the weight of the emission at the ray's hit: the rest is light sampling.
double ReferenceTracer::mis_weight(const Touch& touch) const {
  const ReferenceBody& body = scene_.bodies[touch.body];
  return body.is_light_sampled ? share_of(touch.ray.density, light_sampling_density(scene_, body, touch.ray.origin,
                                                                                    touch.surface.point, touch.surface.normal))
                               : 1;
}

std::optional<ReferenceRay> ReferenceTracer::continued_by_facets(const Touch& touch, const core::SamplePair& choice) const {
  const ReferenceRay& before = touch.ray;
  const auto step =
      touch.facets().step(choice, core::pair_of(before.pixel, before.sample, before.depth, core::Purpose::direction));
  if (!step) {
    return std::nullopt;
  }
  ReferenceRay ray = child(touch, step->towards, before.kind == RayKind::scattered ? RayKind::scattered : step->kind);
  ray.weight = ray.weight * step->weight;
  if (step->kind == RayKind::scattered) {
    ray.density = core::density_of(core::density_bits(step->density));
  }
  return ray;
}

/// Chooses one of the three lobes with a probability in proportion to its brightest channel; it counts for all.
std::optional<ReferenceRay> ReferenceTracer::continued(const Touch& touch, const core::SamplePair& choice) const {
  if (touch.has_facets) {
    return continued_by_facets(touch, choice);
  }
  const Ways ways = ways_of(touch);
  const double all = ways.all(), place = choice.x * all;
  const auto go = [&](const Vec3d& towards, const Vec3d& share, RayKind kind) {
    ReferenceRay ray = child(touch, towards, touch.ray.kind == RayKind::scattered ? RayKind::scattered : kind);
    ray.weight = ray.weight * share * (all / brightest(share));
    return std::optional(ray);
  };
  if (!(all > 0)) {
    return std::nullopt;
  }
  if (place < brightest(ways.scattered)) {
    const std::optional<Vec3d> towards = scattered_direction(touch);
    std::optional<ReferenceRay> ray = towards ? go(*towards, ways.scattered, RayKind::scattered) : std::nullopt;
    if (ray) {
      ray->density = core::density_of(core::density_bits(scattered_density(touch, *towards)));
    }
    return ray;
  }
  return place < brightest(ways.scattered) + brightest(ways.mirrored)
             ? go(mirrored(touch.ray.direction, touch.normal), ways.mirrored, RayKind::reflected)
             : go(touch.bent_direction(), ways.through, RayKind::refracted);
}

/// Applies roulette. The last ray sees only the sky, and emitters if there are any.
void ReferenceTracer::add_path_ray(const Touch& touch, std::vector<ReferenceRay>& rays) const {
  const core::SamplePair choice = core::pair_of(touch.ray.pixel, touch.ray.sample, touch.ray.depth, core::Purpose::choice);
  std::optional<ReferenceRay> ray = continued(touch, choice);
  const double survival = ray && touch.ray.depth >= core::roulette_from ? std::min(1.0, brightest(ray->weight)) : 1;
  if (!ray || (survival < 1 && !(choice.y < survival))) {
    return;
  }
  ray->weight = ray->weight * (1 / survival);
  if (touch.ray.depth < options_.depth_max) {
    rays.push_back(*ray);
  } else if (scene_.has_emission) {
    ray->kind = RayKind::scattered;
    rays.push_back(*ray);
  } else if (options_.transport.has_sky) {
    ReferenceRay look = child(touch, ray->direction, RayKind::shadow);
    look.weight = ray->weight * sky(ray->direction);
    if (!brings_nothing(look)) {
      rays.push_back(look);
    }
  }
}

}  // namespace dmpc::apps
