#include "core/picture/shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "core/base/elementary.h"
#include "core/base/expect.h"

namespace dmpc::core {
namespace {

using Stage = HitState::Stage;

/// How far a secondary ray starts from its surface, along the true normal, grid-local. Coordinates are below about 1, so rounding
/// a point to float moves it by at most 2^-25 an axis, and the float plane of a neighbouring triangle is off by a few times that:
/// 2^-21 is ten times their sum (after M. Pharr, W. Jakob, G. Humphreys, Physically Based Rendering, section 6.8, with the bound
/// made a constant by the grid-local frame).
constexpr double surface_offset = 0x1p-21;
/// A shadow ray ends this share of its length before the light.
constexpr double light_gap = 1e-6;

/// One lane of a block's values, in double.
struct Lane {
  const float* rows;
  std::size_t stride, lane;

  double value(std::size_t row) const { return double{rows[row * stride + lane]}; }
  Vec3d vector(std::size_t row) const { return {value(row), value(row + 1), value(row + 2)}; }
};

Vec3d along(const Ray& ray, double t) { return Vec3d(ray.origin) + Vec3d(ray.direction) * t; }

/// Point, true normal and barycentric weights in double, after T. Moeller, B. Trumbore, "Fast, Minimum Storage Ray/Triangle
/// Intersection", 1997; weights clamped, so that the point lies on the triangle even where the float test let the ray in by
/// rounding.
void triangle_geometry(HitState& state, const Lane& lane) {
  const Vec3d v0 = lane.vector(0), edge1 = lane.vector(3) - v0, edge2 = lane.vector(6) - v0;
  const Vec3d direction(state.ray.direction), p = cross(direction, edge2);
  const double determinant = dot(edge1, p);
  if (determinant != 0.0) {
    const Vec3d from_v0 = Vec3d(state.ray.origin) - v0;
    state.u = std::clamp(dot(from_v0, p) / determinant, 0.0, 1.0);
    state.v = std::clamp(dot(direction, cross(from_v0, edge1)) / determinant, 0.0, 1.0 - state.u);
  }
  state.point = v0 + edge1 * state.u + edge2 * state.v;
  state.geometric_normal = normalize(cross(edge1, edge2));
}

void sphere_geometry(HitState& state, const Lane& lane) {
  const Vec3d center = lane.vector(0);
  state.geometric_normal = normalize(along(state.ray, double{state.hit.t}) - center);
  state.point = center + state.geometric_normal * std::fabs(lane.value(3));
}

void cone_geometry(HitState& state, const Lane& lane) {
  const Vec3d base = lane.vector(0), axis = lane.vector(4) - base, from_base = along(state.ray, double{state.hit.t}) - base;
  const double base_radius = std::fabs(lane.value(3)), widening = std::fabs(lane.value(7)) - base_radius;
  const double height = std::clamp(dot(from_base, axis) / dot(axis, axis), 0.0, 1.0);
  const Vec3d outward = from_base - axis * height;
  const double distance = length(outward), radius = base_radius + widening * height;
  const Vec3d radial = distance > 0.0 ? outward * (1.0 / distance) : Vec3d{};
  state.point = base + axis * height + radial * radius;
  const Vec3d normal = radial * dot(axis, axis) - axis * widening;
  state.geometric_normal = normalize(normal);
}

void read_geometry(HitState& state, const std::byte* record) {
  const auto header = read<BlockHeader>(record);
  const auto* rows = reinterpret_cast<const float*>(record + sizeof(BlockHeader));
  const Lane lane{rows, header.count, state.hit.lane};
  switch (header.kind) {
    case PrimitiveKind::triangle:
      triangle_geometry(state, lane);
      break;
    case PrimitiveKind::sphere:
      sphere_geometry(state, lane);
      break;
    case PrimitiveKind::cone:
      cone_geometry(state, lane);
      break;
  }
  const std::size_t references = (value_count(header.kind) + 1) * header.count;
  state.shading = read<ShadingReference>(record + sizeof(BlockHeader) + 4 * (references + state.hit.lane));
  state.curved = header.kind != PrimitiveKind::triangle;
  state.leaving = dot(Vec3d(state.ray.direction), state.geometric_normal) > 0.0;
  state.normal = state.leaving ? -state.geometric_normal : state.geometric_normal;
  state.stage = state.shading.is_smooth() ? Stage::normals : Stage::material;
}

/// The width, grid-local, of the ray's cone where it hits.
double cone_at_hit(const HitState& state, const ShadeOptions& options) {
  return cone_width(state.ray) + options.pixel_angle * double{state.hit.t};
}

/// What the cone covers of a surface at an angle is longer than wide; its length counts (T. Akenine-Moeller et al., "Texture
/// Level of Detail Strategies for Real-Time Ray Tracing", Ray Tracing Gems, 2019, chapter 20).
void begin_texture(HitState& state, const std::byte* record, const ShadeOptions& options, Operations& operations) {
  ++operations.texture_lookups;
  const auto textured = read<TexturedNormals>(record);
  const std::array<double, 3> weight{1.0 - state.u - state.v, state.u, state.v};
  TexturePlace place;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    place.s += weight[corner] * double{textured.place[corner][0]};
    place.t += weight[corner] * double{textured.place[corner][1]};
  }
  const double cosine = std::fabs(dot(Vec3d(state.ray.direction), state.geometric_normal));
  const double texels = cone_at_hit(state, options) * double{textured.texels_per_unit} / std::max(cosine, 1e-6);
  state.u = place.s;
  state.v = place.t;
  std::construct_at(&state.lookup, begin_lookup(textured.texture, place, texels));
  state.stage = Stage::texture;
}

TexturePlace texture_place(const HitState& state) { return {state.u, state.v}; }

void step_texture(HitState& state, const std::byte* record, Operations& operations) {
  step(state.lookup, texture_place(state), record, operations);
  state.stage = is_finished(state.lookup) ? Stage::textured_material : Stage::texture;
}

/// Blends the vertex normals, turned to the winding's side and then to the ray's.
void read_normals(HitState& state, const std::byte* record, const ShadeOptions& options, Operations& operations) {
  const auto normals = read<PatchNormals>(record);
  const Vec3d blend = Vec3d(normals.normal[0]) * (1.0 - state.u - state.v) + Vec3d(normals.normal[1]) * state.u +
                      Vec3d(normals.normal[2]) * state.v;
  const double size = length(blend);
  if (size > 0.0) {
    ++operations.normal_reads;
    const double side = dot(blend, state.normal) < 0.0 ? -1.0 : 1.0;
    state.normal = blend * (side / size);
  }
  state.shading = ShadingReference::flat(normals.material());
  state.stage = Stage::material;
  if (normals.is_textured()) {
    begin_texture(state, record, options, operations);
  }
}

/// The square of the cosine behind the surface by Snell's law; below 0 there is no refracted ray.
double refracted_cosine_squared(const HitState& state, double relative_index) {
  const double cosine = dot(Vec3d(state.ray.direction), state.normal);
  return 1.0 - relative_index * relative_index * (1.0 - cosine * cosine);
}

double relative_index(const HitState& state) {
  const double inside = state.material.refraction_index > 0.0F ? double{state.material.refraction_index} : 1.0;
  return state.leaving ? inside : 1.0 / inside;
}

/// What of the light found by a reflected ray counts: what cannot be transmitted is reflected, too.
float mirrored_share(const HitState& state) {
  return state.material.specular + (state.has_refraction ? 0.0F : state.material.transmittance);
}

bool reflects(const HitState& state, const Skips& skips) { return mirrored_share(state) > 0.0F || !skips.zero_terms; }

bool refracts(const HitState& state, const Skips& skips) {
  return state.has_refraction && (state.material.transmittance > 0.0F || !skips.zero_terms);
}

Stage after_reflection(const HitState& state, const Skips& skips) {
  return refracts(state, skips) ? Stage::refracted : Stage::finished;
}

/// The stage after the lights: children only while depth is left.
Stage after_lights(const HitState& state, const ShadeOptions& options, const Skips& skips) {
  if (state.ray.depth >= options.depth_max) {
    return Stage::finished;
  }
  return reflects(state, skips) ? Stage::reflected : after_reflection(state, skips);
}

/// Which children the hit may have, and which it does not have since their share is nothing.
void judge_children(HitState& state, const Skips& skips, Operations& operations) {
  const double index = relative_index(state);
  state.has_refraction = index <= 1.0 || !(refracted_cosine_squared(state, index) < 0.0);
  operations.total_internal_reflections += !state.has_refraction && state.material.transmittance > 0.0F ? 1 : 0;
  operations.skipped.zero_terms += reflects(state, skips) ? 0 : 1;
  operations.skipped.zero_terms += !state.has_refraction || refracts(state, skips) ? 0 : 1;
}

void read_material(HitState& state, const std::byte* record, const DatabaseHeader& header, const ShadeOptions& options,
                   const Skips& skips, Operations& operations) {
  auto material = read<MaterialRecord>(record);
  if (state.stage == Stage::textured_material) {
    material.color = material.color * state.lookup.sum;
  }
  std::construct_at(&state.material, material);
  ++operations.shadings;
  if (state.ray.depth < options.depth_max) {
    judge_children(state, skips, operations);
  }
  state.stage = header.light_count > 0 ? Stage::light : after_lights(state, options, skips);
}

/// A child that starts beside the hit, on the side that it goes to.
Ray child_ray(const HitState& state, const Vec3d& towards, RayKind kind) {
  const double side = dot(towards, state.geometric_normal) < 0.0 ? -1.0 : 1.0;
  Ray ray;
  ray.origin = Vec3f(state.point + state.geometric_normal * (side * surface_offset));
  ray.direction = Vec3f(normalize(towards));
  ray.ignored_primitive = state.curved ? no_primitive : state.hit.primitive;
  ray.pixel = state.ray.pixel;
  ray.sample = state.ray.sample;
  ray.depth = static_cast<std::uint8_t>(state.ray.depth + (kind == RayKind::shadow ? 0 : 1));
  ray.kind = kind;
  return ray;
}

Vec3d mirrored(const Vec3d& direction, const Vec3d& normal) { return direction - normal * (2.0 * dot(direction, normal)); }

/// Diffuse plus Phong's highlight (NFF) for light from the unit direction `to_light`.
Color reflected_light(const HitState& state, const LightRecord& light, const Vec3d& to_light, double cosine) {
  const MaterialRecord& material = state.material;
  const double lobe = std::clamp(dot(mirrored(Vec3d(state.ray.direction), state.normal), to_light), 0.0, 1.0);
  const double highlight = material.specular > 0.0F ? double{material.specular} * pow_unit(lobe, double{material.shine}) : 0.0;
  const Vec3d surface = Vec3d(material.color) * (double{material.diffuse} * cosine) + Vec3d{highlight, highlight, highlight};
  return Color(Vec3d(state.ray.weight) * Vec3d(light.intensity) * surface);
}

/// Whether a ray that brings `weight` from a light is left out, and why. The paper's convention shoots all.
bool leaves_out(bool is_lit, const Color& weight, const ShadeOptions& options, const Skips& skips, Operations& operations) {
  if (options.convention == Convention::paper || !(weight == Color{})) {
    return false;
  }
  const bool leaves = is_lit ? skips.zero_terms : skips.unlit;
  (is_lit ? operations.skipped.zero_terms : operations.skipped.unlit) += leaves ? 1 : 0;
  return leaves;
}

bool read_light(HitState& state, const std::byte* record, const DatabaseHeader& header, const ShadeOptions& options,
                const Skips& skips, Ray& child, Operations& operations) {
  const auto light = read<LightRecord>(record);
  if (++state.next_light == header.light_count) {
    state.stage = after_lights(state, options, skips);
  }
  const Vec3d towards = Vec3d(light.position) - state.point;
  const double distance = length(towards);
  const double cosine = distance > 0.0 ? dot(towards, state.normal) / distance : 0.0;
  const bool is_lit = cosine > 0.0;
  const Color weight = is_lit ? reflected_light(state, light, towards * (1.0 / distance), cosine) : Color{};
  if (leaves_out(is_lit, weight, options, skips, operations)) {
    return false;
  }
  child = child_ray(state, towards, RayKind::shadow);
  const Vec3d from_start = Vec3d(light.position) - Vec3d(child.origin);
  child.direction = Vec3f(normalize(from_start));
  child.t_max = static_cast<float>(length(from_start) * (1.0 - light_gap));
  child.weight = weight;
  return true;
}

/// A reflected or refracted ray's cone goes on with its parent's width and angle: what a curved surface does to it is left out.
void widen(const HitState& state, const ShadeOptions& options, Ray& child) {
  if (options.pixel_angle > 0) {
    child.cone = cone_bits(cone_at_hit(state, options));
  }
}

bool reflect(HitState& state, const ShadeOptions& options, const Skips& skips, Ray& child) {
  child = child_ray(state, mirrored(Vec3d(state.ray.direction), state.normal), RayKind::reflected);
  widen(state, options, child);
  child.weight = state.ray.weight * mirrored_share(state);
  state.stage = after_reflection(state, skips);
  return true;
}

bool refract(HitState& state, const ShadeOptions& options, Ray& child) {
  const double index = relative_index(state), cosine = -dot(Vec3d(state.ray.direction), state.normal);
  const double behind = std::sqrt(refracted_cosine_squared(state, index));
  const Vec3d towards = Vec3d(state.ray.direction) * index + state.normal * (index * cosine - behind);
  child = child_ray(state, towards, RayKind::refracted);
  widen(state, options, child);
  child.weight = state.ray.weight * state.material.transmittance;
  state.stage = Stage::finished;
  return true;
}

double brightest(const Vec3d& color) { return std::max({color.x, color.y, color.z, 0.0}); }

/// What a ray can bring to its sample at most, in any channel.
double contribution_bound(const Ray& ray, const ShadeOptions& options) {
  return brightest(Vec3d(ray.weight)) * (ray.kind == RayKind::shadow ? 1.0 : options.radiance_bound);
}

/// Whether a step has made a child, and one that is worth its shot.
bool kept(bool has_child, const Ray& child, const ShadeOptions& options, Operations& operations) {
  const bool is_cut = has_child && options.cutoff > 0 && contribution_bound(child, options) < options.cutoff;
  operations.rays_cut += is_cut ? 1 : 0;
  return has_child && !is_cut;
}

}  // namespace

double radiance_bound(const Scene& scene, int depth_max) {
  double light = 0, direct = 0, passed_on = 0;
  for (const PointLight& point_light : scene.lights) {
    light += brightest(intensity_of(point_light, scene));
  }
  for (const Material& material : scene.materials) {
    const double texture = material.texture == Material::no_texture ? 1 : scene.textures[material.texture].brightest;
    direct = std::max(direct, light * (material.diffuse * brightest(material.color) * texture + material.specular));
    passed_on = std::max(passed_on, material.specular + material.transmittance);
  }
  const double background = brightest(scene.background);
  double bound = std::max(background, direct);
  for (int depth = depth_max; depth > 2; --depth) {
    bound = std::max(background, direct + passed_on * bound);
  }
  return bound;
}

HitState begin_shading(const Ray& ray, const Hit& hit) {
  HitState state;
  state.ray = ray;
  state.hit = hit;
  return state;
}

Address record_needed(const HitState& state, const DatabaseHeader& header) {
  switch (state.stage) {
    case Stage::geometry:
      return state.hit.block;
    case Stage::normals:
      return state.shading.normals();
    case Stage::texture:
      return record_needed(state.lookup);
    case Stage::material:
    case Stage::textured_material:
      return advance(header.materials, state.shading.material() * sizeof(MaterialRecord));
    case Stage::light:
      return advance(header.lights, state.next_light * sizeof(LightRecord));
    default:
      return no_address;
  }
}

bool shade_step(HitState& state, const std::byte* record, const DatabaseHeader& header, const ShadeOptions& options,
                const Skips& skips, Ray& child, Operations& operations) {
  switch (state.stage) {
    case Stage::geometry:
      read_geometry(state, record);
      return false;
    case Stage::normals:
      read_normals(state, record, options, operations);
      return false;
    case Stage::texture:
      step_texture(state, record, operations);
      return false;
    case Stage::material:
    case Stage::textured_material:
      read_material(state, record, header, options, skips, operations);
      return false;
    case Stage::light:
      return kept(read_light(state, record, header, options, skips, child, operations), child, options, operations);
    case Stage::reflected:
      return kept(reflect(state, options, skips, child), child, options, operations);
    case Stage::refracted:
      return kept(refract(state, options, child), child, options, operations);
    case Stage::finished:
      break;
  }
  expect(false, "a finished hit is not shaded again");
  return false;
}

}  // namespace dmpc::core
