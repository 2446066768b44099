#include "core/picture/shade.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "core/base/elementary.h"
#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "core/picture/hits/hit_geometry.h"
#include "core/picture/hits/ray_start.h"
#include "core/picture/surfaces/microfacet_lobes.h"
#include "core/picture/surfaces/surface_response.h"
#include "core/record/emitter.h"
#include "core/record/instance.h"
#include "core/trace/placed_leaf.h"

namespace dmpc::core {
namespace {

using Stage = HitState::Stage;

/// The maximum depth that a ray's record can hold.
constexpr int depth_limit = 255;

TexturePlace texture_place(const HitState& state) { return {state.u, state.v}; }

float both_shares(const HitState& state) { return mirrored_share(state) + state.surface.material.transmittance; }

std::uint64_t bits_of(const Vec3f& vector) {
  const auto word = [](float value) { return std::uint64_t{std::bit_cast<std::uint32_t>(value)}; };
  return mix(mix(word(vector.x) << 32U | word(vector.y)) + word(vector.z));
}

/// A mirrored instance has its corners in reverse order.
void turn_places(const HitState& state, TexturedNormals& triangle) {
  if (state.is_in_mirror) {
    std::swap(triangle.place[0], triangle.place[2]);
  }
}

/// A random number from 0 to 1 for a ray, independent of who shades its hit, and when.
double chance_of(const Ray& ray) {
  const std::uint64_t place = std::uint64_t{ray.pixel} << 32U | ray.sample;
  const std::uint64_t bits = mix(mix(mix(place) + bits_of(ray.origin) + ray.depth) + bits_of(ray.direction));
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

/// Light reflected for a light source at this cosine: by a microfacet surface, or diffuse plus Phong's highlight (NFF);
/// `highlight` is lobe_cosine() to the power of the shininess.
Color reflected_light(const HitState& state, const LightRecord& light, const LightFall& fall, double highlight) {
  const MaterialRecord& material = state.surface.material;
  if (material.has_microfacets()) {
    return Color(Vec3d(state.ray.weight) * Vec3d(light.intensity) *
                 (MicrofacetLobes(state).response(fall.towards) * std::numbers::pi));
  }
  const double mirrored_light = material.specular > 0.0F ? double{material.specular} * highlight : 0.0;
  const Vec3d surface =
      Vec3d(material.color) * (double{material.diffuse} * fall.cosine) + Vec3d(state.gloss().tint) * mirrored_light;
  return Color(Vec3d(state.ray.weight) * Vec3d(light.intensity) * surface);
}

/// Keeps a share of the surface; the ray continues through the rest.
void cover(MaterialRecord& material, float share) {
  material.diffuse *= share;
  material.specular *= share;
  material.transmittance = material.transmittance * share + (1.0F - share);
}

/// The coverage that alpha leaves with this cutoff. The weights of a look-up add up to 1 except for rounding, which must neither
/// send a ray nor cut away a texel of exactly the cutoff.
float share_left(std::uint16_t cutoff, float alpha) {
  constexpr float rounding = 0x1p-16F;
  const float share = alpha > 1.0F - rounding ? 1.0F : alpha < rounding ? 0.0F : alpha;
  if (cutoff == 0) {
    return share;
  }
  return share * float{MaterialExtensionRecord::share_max} < static_cast<float>(cutoff) - 0.5F ? 0.0F : 1.0F;
}

/// Applies alpha to a hit and returns the coverage.
float cover_by_alpha(HitState& state, std::uint16_t cutoff, float refraction_index) {
  MaterialRecord& material = state.surface.material;
  const float share = share_left(cutoff, state.coverage());
  material.refraction_index = share > 0.0F ? refraction_index : 1.0F;  // a hole does not refract
  if (share < 1.0F) {
    cover(material, share);
  }
  return share;
}

/// Applies a texture to a surface's record, which is that of one without metal. The part that alpha leaves out is no metal.
void multiply(const HitState::FacetShares& shares, MicrofacetRecord& facets, MaterialRecord& material) {
  facets.metallic *= std::min(shares.metallic, 1.0F);  // the weights of a look-up add up to 1 except for rounding
  facets.alpha *= std::min(shares.roughness * shares.roughness, 1.0F);
  const float dielectric = 1.0F - facets.metallic, absent = 1.0F - material.specular;
  material.diffuse *= dielectric;
  material.transmittance = absent + std::max(material.transmittance - absent, 0.0F) * dielectric;
}

/// Highlight and mirror; the surface's own colour is that of the material.
HitState::Gloss gloss_of(MaterialRecord& material, const MaterialExtensionRecord& finish) {
  const Color color = finish.specular + material.color * material.specular;
  material.specular = std::max({color.x, color.y, color.z});
  HitState::Gloss gloss{.mirror = static_cast<float>(finish.mirror) / float{MaterialExtensionRecord::share_max}};
  if (material.specular > 0.0F) {
    gloss.tint = {color.x / material.specular, color.y / material.specular, color.z / material.specular};
  }
  return gloss;
}

/// The texture of metal and roughness of a material, if there is one.
const Texture* facet_texture(const Scene& scene, const Material& material) {
  return material.microfacets.have_texture() ? &scene.textures[material.microfacets.texture] : nullptr;
}

/// The maximum factor that a texture applies to the material's colour.
double texture_max(const Scene& scene, const Material& material) {
  return material.texture == Material::no_texture ? 1 : scene.textures[material.texture].brightest;
}

/// Whether the last hit of a path sends a BSDF-sampled ray whose end may be emitting.
bool is_bsdf_sampled(const DatabaseHeader& header) { return header.has_emission != 0 || has_sky_picture(header); }

}  // namespace

int ray_depth_max(const ShadeOptions& options, const DatabaseHeader& header, const Skips& skips) {
  if (!options.transport.is_by_paths()) {
    return options.layer == Layer::light ? waiting_hits_max(options, skips) : options.depth_max;
  }
  const bool looks_for_light = is_bsdf_sampled(header);
  return std::min(options.depth_max + (looks_for_light ? 1 : 0), depth_limit);
}

double radiance_bound(const Scene& scene, int depth_max, const Transport& transport) {
  const double ambient = brightest(scene.ambient);
  double light = 0, direct = 0, passed_on = 0, emitter = 0;
  for (const PointLight& point_light : scene.lights) {
    const double nearest = point_light.falls_off_from > 0 ? point_light.falls_off_from : 1;
    light += brightest(intensity_of(point_light, scene)) / (nearest * nearest);
  }
  const double sky = transport.has_sky ? scene.sky.brightest : 0;
  for (const Material& material : scene.materials) {
    emitter = std::max(emitter, transport.is_by_paths() ? brightest(material.emission) : 0.0);
  }
  emitter += sky;  // hits sample both
  for (const Material& material : scene.materials) {
    if (transport.is_by_paths() && material.microfacets.are_there()) {
      const MicrofacetBound bound = bound_of(material, texture_max(scene, material), facet_texture(scene, material));
      const double aimed = emitter * bound.passed_on * (1 + 0x1p-6);
      direct = std::max(direct, light * bound.direct + brightest(material.emission) + aimed);
      passed_on = std::max(passed_on, bound.passed_on);
      continue;
    }
    const double texture = texture_max(scene, material);
    const double diffuse = material.diffuse * brightest(material.color) * texture, specular = material.specular_max(texture);
    const double scattered = transport.is_by_paths() ? diffuse : 0, share = specular * material.mirror + material.transmittance;
    // Light sampling of an emitter brings no more than a path that hits it, up to the rounding of densities.
    const double aimed = emitter * (scattered + share) * (1 + 0x1p-6);
    direct = std::max(direct, light * (diffuse + specular) + ambient * diffuse + brightest(material.emission) + aimed);
    passed_on = std::max(passed_on, scattered + (material.alpha == AlphaUse::none ? share : std::max(share, 1.0)));
  }
  if (transport.is_by_paths()) {
    passed_on = std::max(passed_on, 1.0);  // the survivors of roulette count for others
  }
  const double background = std::max({brightest(scene.background), double{brightest(transport.zenith)}, sky});
  double bound = std::max(background, direct);
  const int looks = transport.is_by_paths() ? 1 : 0;  // for the last hit's light sampling of the sky or of emitters
  for (int depth = depth_max + looks; depth > 2; --depth) {
    bound = std::max(background, direct + passed_on * bound);
  }
  return bound;
}

bool may_find_light(const DatabaseHeader& header, const Transport& transport, RayKind kind) {
  const bool is_beyond_black = header.background == Color{} && (!transport.has_gradient || transport.zenith == Color{});
  const bool sees_beyond = transport.has_sky || kind != RayKind::scattered;
  return header.light_count > 0 || hits_glow(header) || (sees_beyond && !is_beyond_black);
}

double sample_spacing(std::uint32_t sample, std::uint32_t first_samples) {
  std::uint64_t count = first_samples;
  while (sample >= count) {
    count *= 2;
  }
  return 1.0 / std::sqrt(static_cast<double>(count));
}

/// The width, grid-local, of the ray's footprint at the hit. For a primary ray it is measured along the film, where it is the
/// side of a pixel. For all others it is measured across the ray, by the shorter side of the pixel as seen from the eye: a cone
/// of that width covers nothing that the pixel does not, and other samples cover the rest, whose difference an error estimate
/// sees.
double Shader::width_at_hit(const HitState& state) const {
  const Ray& ray = state.ray;
  const double side = options_.pixel_share * sample_spacing(ray.sample, options_.first_samples) * camera_->pixel_size();
  const double t{state.hit.t};
  return ray.kind == RayKind::primary ? side * (cone_width(ray) + t) * dot(Vec3d(ray.direction), camera_->forward())
                                      : cone_width(ray) + side * camera_->square_cosine(ray.pixel) * t;
}

void Shader::read_geometry(HitState& state, const std::byte* record) const {
  PlacedLeaf placed;
  if (is_in_instance(state.hit)) {
    const PlacedMesh place(state.place(), header_.frame);
    operations_.placed_triangles += placed.place(record, place);
    record = placed.record();
    state.is_in_mirror = place.is_mirrored();
  }
  core::read_geometry(state, record);
  if (options_.pixel_share > 0 && state.stage == Stage::normals) {
    const bool is_primary = state.ray.kind == RayKind::primary;
    std::construct_at(&state.ellipse, cut_ellipse(state, record, is_primary ? camera_->forward() : Vec3d(state.ray.direction)));
  }
}

void Shader::begin_texture(HitState& state, const TexturedNormals& textured) const {
  ++operations_.texture_lookups;
  const CutEllipse ellipse = options_.pixel_share > 0 ? state.ellipse : CutEllipse{};
  const TextureFootprint footprint = footprint_of(textured, state.u, state.v, ellipse, width_at_hit(state));
  state.u = footprint.middle.s;
  state.v = footprint.middle.t;
  state.set_coverage(textured.texture.format == TexelFormat::srgb_alpha ? 0.0F : 1.0F);
  std::construct_at(&state.lookup, begin_lookup(textured.texture, footprint));
  state.stage = Stage::texture;
}

/// Metal and roughness are looked up before the colour, which has more to store. Both use the ray's footprint on the finer of the
/// two textures.
void Shader::begin_facets(HitState& state, const FacetedNormals& triangle) const {
  ++operations_.texture_lookups;
  const TextureReference &color = triangle.textured.texture, &facets = triangle.facets;
  const CutEllipse ellipse = options_.pixel_share > 0 ? state.ellipse : CutEllipse{};
  TexturedNormals finer = triangle.textured;
  finer.texture = texels_of_other(color, facets) > 1.0 ? facets : color;
  TextureFootprint footprint = footprint_of(finer, state.u, state.v, ellipse, width_at_hit(state));
  state.u = footprint.middle.s;
  state.v = footprint.middle.t;
  state.set_color_width(footprint.width * texels_of_other(finer.texture, color));
  state.set_coverage(0.0F);
  footprint.width *= texels_of_other(finer.texture, facets);
  std::construct_at(&state.lookup, begin_lookup(facets, footprint));
  state.stage = Stage::texture;
}

/// The colour's look-up begins when that of metal and roughness has ended.
void Shader::turn_to_color(HitState& state, const std::byte* record) const {
  ++operations_.texture_lookups;
  const auto textured = read<TexturedNormals>(record);
  const HitState::FacetShares shares{.metallic = state.lookup.sum.z, .roughness = state.lookup.sum.y};
  turn_to(state.lookup, textured.texture, double{state.color_width()}, texture_place(state));
  state.shading = ShadingReference::flat(textured.normals.material());
  state.set_facet_shares(shares);
  state.set_coverage(textured.texture.format == TexelFormat::srgb_alpha ? 0.0F : 1.0F);
  state.stage = Stage::texture;
}

/// For a format with alpha the look-up sums premultiplied colours, and alpha.
void Shader::step_texture(HitState& state, const std::byte* record) const {
  float alpha = state.coverage();
  core::step(state.lookup, texture_place(state), record, operations_, alpha);
  state.set_coverage(alpha);
  const bool is_of_facets = state.lookup.format == TexelFormat::linear;
  state.stage = !is_finished(state.lookup) ? Stage::texture : is_of_facets ? Stage::color_texture : Stage::textured_material;
  if (is_finished(state.lookup) && state.lookup.format == TexelFormat::srgb_alpha) {
    state.lookup.sum = alpha > 0.0F ? state.lookup.sum * (1.0F / alpha) : Color{};
  }
}

/// Interpolates the colours of a triangle's corners for the hit, as if from a texture.
void Shader::read_corners(HitState& state, const TexturedNormals& corners) const {
  const std::array<double, 3> weight{1.0 - state.u - state.v, state.u, state.v};
  std::array<double, 4> sum{};
  for (std::size_t corner = 0; corner < weight.size(); ++corner) {
    const CornerColor color = corners.color(corner);
    for (std::size_t channel = 0; channel < sum.size(); ++channel) {
      sum[channel] += weight[corner] * color[channel];
    }
  }
  for (double& channel : sum) {
    channel /= corner_color_max;
  }
  std::construct_at(&state.lookup, TextureLookup{.sum = Color(Vec3d{sum[0], sum[1], sum[2]})});
  state.set_coverage(static_cast<float>(sum[3]));
  state.stage = Stage::textured_material;
}

/// Blends the vertex normals, flipped to the winding's side and then to the ray's.
void Shader::blend_normals(HitState& state, const std::array<Vec3f, 3>& normals) const {
  const Vec3d blend = Vec3d(normals[0]) * (1.0 - state.u - state.v) + Vec3d(normals[1]) * state.u + Vec3d(normals[2]) * state.v;
  const double size = length(blend);
  if (size > 0.0) {
    ++operations_.normal_reads;
    const double side = dot(blend, state.normal) < 0.0 ? -1.0 : 1.0;
    state.normal = blend * (side / size);
  }
}

/// Keeps the normals of a base mesh until its instance is read once more.
void Shader::keep_normals(HitState& state, const PatchNormals& normals) const {
  if (!normals.is_textured()) {
    state.shading = ShadingReference::flat(normals.material());
  }
  const CutEllipse ellipse = options_.pixel_share > 0 ? state.ellipse : CutEllipse{};
  std::construct_at(&state.of_mesh, HitState::MeshNormals{ellipse, normals.normal[2]});
  state.normal = std::bit_cast<Vec3d>(std::array{normals.normal[0], normals.normal[1]});
  state.stage = Stage::placed_normals;
}

/// Computes the same normals as the converter computes for a copy.
void Shader::place_normals(HitState& state, const std::byte* instance) const {
  const auto two = std::bit_cast<std::array<Vec3f, 2>>(state.normal);
  const CutEllipse ellipse = state.of_mesh.ellipse;
  const PlacedMesh place(read<InstanceRecord>(instance), header_.frame);
  ++operations_.placed_triangles;
  const std::array<Vec3f, 3> normals = place.normals({two[0], two[1], state.of_mesh.third});
  state.normal = state.leaving ? -state.geometric_normal : state.geometric_normal;
  std::construct_at(&state.ellipse, ellipse);
  blend_normals(state, normals);
  state.has_normals = true;
  state.stage = state.shading.is_smooth() ? Stage::normals : Stage::material;
}

void Shader::read_normals(HitState& state, const std::byte* record) const {
  const auto normals = read<PatchNormals>(record);
  if (is_in_instance(state.hit) && !state.has_normals) {
    return keep_normals(state, normals);
  }
  if (!state.has_normals) {
    blend_normals(state, normals.normal);
  }
  if (normals.is_textured() && read<TexturedNormals>(record).has_facets != 0) {
    auto faceted = read<FacetedNormals>(record);
    turn_places(state, faceted.textured);
    return begin_facets(state, faceted);
  }
  state.shading = ShadingReference::flat(normals.material());
  state.stage = Stage::material;
  if (normals.is_textured()) {
    auto textured = read<TexturedNormals>(record);
    turn_places(state, textured);
    textured.has_texture() ? begin_texture(state, textured) : read_corners(state, textured);
  }
}

Color Shader::glow(const HitState& state) const {
  const MaterialRecord& material = state.surface.material;
  const Vec3d weight(state.ray.weight),
      reflected = weight * Vec3d(header_.ambient) * (Vec3d(material.color) * double{material.diffuse});
  return Color(weight * Vec3d(state.emission()) + reflected);
}

bool Shader::reflects(const HitState& state) const { return mirrored_share(state) > 0.0F || !skips_.zero_terms; }

bool Shader::refracts(const HitState& state) const {
  return state.has_refraction && (state.surface.material.transmittance > 0.0F || !skips_.zero_terms);
}

bool Shader::sends_one(const HitState& state) const {
  return options_.one_child_from > 0 && state.ray.depth >= options_.one_child_from && reflects(state) && refracts(state);
}

Stage Shader::after_reflection(const HitState& state) const {
  return refracts(state) && !sends_one(state) ? Stage::refracted : Stage::finished;
}

/// At the last depth the path sends a ray of its own to find emitters, as long as rays may be as deep.
bool Shader::is_at_last_depth(const HitState& state) const {
  return state.ray.depth >= ray_depth_max(options_, header_, skips_) ||
         (state.ray.depth >= options_.depth_max && !is_bsdf_sampled(header_));
}

Stage Shader::after_lights_of_path(const HitState& state) const {
  const bool finds_light = state.ray.depth <= options_.depth_max && (!is_at_last_depth(state) || options_.transport.has_sky);
  return finds_light ? Stage::continued : Stage::finished;
}

/// The number of lights that are sampled. A path beyond its last bounce only samples emitters.
std::uint32_t Shader::light_count(const HitState& state) const {
  const bool asks = !options_.transport.is_by_paths() || state.ray.depth <= options_.depth_max;
  return asks ? header_.light_count : 0;
}

/// The stage after the lights: children only while depth is left.
Stage Shader::after_lights(const HitState& state) const {
  if (options_.transport.is_by_paths()) {
    return after_lights_of_path(state);
  }
  if (state.ray.depth >= options_.depth_max) {
    return Stage::finished;
  }
  if (sends_one(state)) {
    return chance_of(state.ray) * double{both_shares(state)} < double{mirrored_share(state)} ? Stage::reflected
                                                                                             : Stage::refracted;
  }
  return reflects(state) ? Stage::reflected : after_reflection(state);
}

void Shader::judge_refraction(HitState& state) const {
  const double index = relative_index(state);
  state.has_refraction = index <= 1.0 || !(refracted_cosine_squared(state.ray.full_direction(), state.normal, index) < 0.0);
  operations_.total_internal_reflections += !state.has_refraction && state.surface.material.transmittance > 0.0F ? 1 : 0;
}

/// Determines which children the hit may have, and which are omitted because their weight is 0.
void Shader::judge_children(HitState& state) const {
  judge_refraction(state);
  operations_.skipped.zero_terms += reflects(state) ? 0 : 1;
  operations_.skipped.zero_terms += !state.has_refraction || refracts(state) ? 0 : 1;
}

void Shader::read_material(HitState& state, const std::byte* record) const {
  auto material = read<MaterialRecord>(record);
  if (state.stage == Stage::textured_material) {
    material.color = material.color * state.lookup.sum;
  } else {
    state.set_coverage(1.0F);
  }
  std::construct_at(&state.surface, HitState::Surface{.material = material, .next_light = 0});
  ++operations_.shadings;
  state.set_gloss({});
  if (material.has_extension()) {
    state.stage = Stage::finish;
  } else if (!shows_layer(state, 0)) {
    come_to_lights(state, {});
  }
}

/// In a layer the surface becomes a matt one in its colour, of which alpha, if it counts here, leaves a share; where the layer is
/// no mean, all or nothing.
bool Shader::shows_layer(HitState& state, float metallic, std::optional<std::uint16_t> cutoff) const {
  constexpr std::uint16_t half = MaterialExtensionRecord::share_max / 2 + 1;
  if (options_.layer == Layer::light) {
    return false;
  }
  const Color color = layer_color(options_.layer, state, metallic, camera_->eye(), header_.frame.scale);
  state.surface.material = {.color = color, .diffuse = 1};
  if (cutoff) {
    cover_by_alpha(state, is_mean(options_.layer) ? *cutoff : std::max(*cutoff, half), 1.0F);
  }
  come_to_lights(state, {});
  return true;
}

/// The emission is scaled by the surface's coverage.
void Shader::read_extension(HitState& state, const std::byte* record) const {
  if (state.has_microfacets()) {
    return read_microfacets(state, record);
  }
  const auto finish = read<MaterialExtensionRecord>(record);
  state.set_gloss(gloss_of(state.surface.material, finish));
  if (shows_layer(state, 0, finish.alpha_cutoff)) {
    return;
  }
  const float share = cover_by_alpha(state, finish.alpha_cutoff, finish.refraction_index);
  come_to_lights(state, finish.emission * (share * mis_weight(state, finish.emission)));
}

/// The material's highlight and mirror are removed.
void Shader::read_microfacets(HitState& state, const std::byte* record) const {
  auto facets = read<MicrofacetRecord>(record);
  if (facets.has_texture != 0) {
    multiply(state.facet_shares(), facets, state.surface.material);
  }
  if (shows_layer(state, facets.metallic, facets.alpha_cutoff)) {
    return;
  }
  const float share = cover_by_alpha(state, facets.alpha_cutoff, facets.refraction_index);
  state.set_microfacets({.metallic = facets.metallic,
                         .alpha = facets.alpha,
                         .reflectance = facets.reflectance,
                         .there = std::exchange(state.surface.material.specular, 0.0F)});
  come_to_lights(state, facets.emission * (share * mis_weight(state, facets.emission)));
}

void Shader::come_to_lights(HitState& state, const Color& emission) const {
  if (hits_glow()) {
    state.set_emission(emission);
  }
  if (options_.transport.is_by_paths()) {
    judge_refraction(state);
  } else if (state.ray.depth < options_.depth_max) {
    judge_children(state);
  }
  if (light_count(state) > 0) {
    state.stage = Stage::light;
  } else {
    end_point_lights(state);
  }
}

/// Goes on to the emitter that is sampled, if there is one, else to the stage after emitters.
void Shader::end_point_lights(HitState& state) const {
  if (aims_at_emitter(state)) {
    begin_emitter(state);
  } else {
    end_emitters(state);
  }
}

/// Whether a ray that brings `weight` from a light is omitted, and why. The paper's convention traces all of them.
bool Shader::leaves_out(bool is_lit, const Color& weight) const {
  if (options_.convention == Convention::paper || !(weight == Color{})) {
    return false;
  }
  const bool leaves = is_lit ? skips_.zero_terms : skips_.unlit;
  (is_lit ? operations_.skipped.zero_terms : operations_.skipped.unlit) += leaves ? 1 : 0;
  return leaves;
}

bool Shader::read_light(HitState& state, const std::byte* record, Ray& child) const {
  const auto light = read<LightRecord>(record);
  const Vec3d position(light.position);
  const Vec3d way = position - state.point;
  const double distance = length(way);
  const Vec3d towards = direction_of(way, distance);
  const LightFall fall{towards, dot(towards, state.normal)};
  const MaterialRecord& material = state.surface.material;
  double highlight = 0.0;
  if (fall.cosine > 0.0 && material.specular > 0.0F) {
    highlight = pow_unit(lobe_cosine(state.ray.full_direction(), state.normal, fall.towards), double{material.shine});
  }
  if (!shine(state, light, fall, highlight, child)) {
    return false;
  }
  aim_shadow(child, position, state.point, state.geometric_normal, towards, distance,
             start_towards(towards, state.geometric_normal, state.clearance));
  return true;
}

bool Shader::shine(HitState& state, const LightRecord& light, const LightFall& fall, double highlight, Ray& child) const {
  expect(state.stage == Stage::light, "a light shines on a hit that has come to it");
  if (++state.surface.next_light == header_.light_count) {
    end_point_lights(state);
  }
  LightRecord here = light;
  bool is_lit = fall.cosine > 0.0;
  if (is_lit && !light.spread.is_plain()) {
    const double share = share_of(light.spread, fall.towards, length(Vec3d(light.position) - state.point));
    here.intensity = Color(Vec3d(light.intensity) * share);
    is_lit = share > 0.0;
  }
  const Color weight = is_lit ? reflected_light(state, here, fall, highlight) : Color{};
  if (leaves_out(is_lit, weight)) {
    return false;
  }
  begin_child(child, state, RayKind::shadow);
  child.weight = weight;
  return is_worth_it(child);
}

/// A reflected or refracted ray's cone keeps its parent's width and angle; the effect of curvature is ignored.
void Shader::widen(const HitState& state, Ray& child) const {
  if (options_.pixel_share > 0) {
    const bool is_primary = state.ray.kind == RayKind::primary;
    const double shorter = is_primary ? dot(Vec3d(state.ray.direction), camera_->forward()) : 1.0;
    child.cone = cone_bits(width_at_hit(state) * shorter);
  }
}

bool Shader::send(HitState& state, Ray& child) const {
  const bool is_mirrored = state.stage == Stage::reflected;
  expect(is_mirrored || state.stage == Stage::refracted, "a hit sends a ray when it has come to that");
  begin_child(child, state, is_mirrored ? RayKind::reflected : RayKind::refracted);
  widen(state, child);
  const float share = sends_one(state) ? both_shares(state)
                      : is_mirrored    ? mirrored_share(state)
                                       : state.surface.material.transmittance;
  child.weight = state.ray.weight * share;
  if (is_mirrored) {
    child.weight = child.weight * mirrored_tint(state);
  }
  state.stage = is_mirrored ? after_reflection(state) : Stage::finished;
  return is_worth_it(child);
}

bool Shader::send_alone(HitState& state, Ray& child) const {
  const Vec3d direction = state.ray.full_direction();
  const Vec3d towards =
      normalize(state.stage == Stage::reflected ? mirrored_direction(direction, state.normal)
                                                : bent_direction(direction, state.normal, relative_index(state)));
  if (!send(state, child)) {
    return false;
  }
  leave(child, state.point, state.geometric_normal, towards, start_towards(towards, state.geometric_normal, state.clearance));
  return true;
}

Ray Shader::continued_ray(const HitState& state, const Vec3d& towards, RayKind kind, const Color& weight) const {
  Ray ray = child_ray(state, towards, start_towards(towards, state.geometric_normal, state.clearance), kind);
  ray.weight = weight;
  return ray;
}

/// A shadow ray of infinite length brings the sky's light.
bool Shader::look_at_sky(const HitState& state, const PathStep& step, Ray& child) const {
  child = continued_ray(state, step.towards, RayKind::shadow, state.ray.weight * step.weight);
  if (has_sky_picture(header_)) {
    return false;  // beyond the maximum depth of rays
  }
  child.weight = child.weight * sky_light(options_.transport, header_.background, child.direction);
  return !leaves_out(true, child.weight);
}

bool Shader::send_on(HitState& state, Ray& child) const {
  expect(state.stage == Stage::continued, "a path goes on from a hit that has come to that");
  state.stage = Stage::finished;
  const std::optional<PathStep> step = path_step(state);
  if (!step) {
    return false;
  }
  if (is_at_last_depth(state)) {
    return look_at_sky(state, *step, child);
  }
  const RayKind kind =
      state.ray.depth < options_.depth_max ? step->kind : RayKind::scattered;  // the last one shows no background
  if (is_for_nothing(kind)) {
    return false;
  }
  child = continued_ray(state, step->towards, kind, state.ray.weight * step->weight);
  child.density = has_emitters(header_) || has_sky_picture(header_) ? density_bits(step->density) : std::uint16_t{0};
  widen(state, child);
  return true;
}

/// The ray's light would be 0, however far it goes.
bool Shader::is_for_nothing(RayKind kind) const {
  const bool leaves = skips_.zero_terms && !may_find_light(header_, options_.transport, kind);
  operations_.skipped.zero_terms += leaves ? 1 : 0;
  return leaves;
}

/// Whether its maximum contribution to its sample, in any channel, is not below the cutoff.
bool Shader::is_worth_it(const Ray& child) const {
  const double bound = brightest(Vec3d(child.weight)) * (child.kind == RayKind::shadow ? 1.0 : options_.radiance_bound);
  const bool is_cut = options_.cutoff > 0 && bound < options_.cutoff;
  operations_.rays_cut += is_cut ? 1 : 0;
  return !is_cut;
}

bool Shader::step(HitState& state, const std::byte* record, Ray& child) const {
  switch (state.stage) {
    case Stage::instance:
      state.set_place(read<InstanceRecord>(record));
      state.stage = Stage::geometry;
      return false;
    case Stage::geometry:
      read_geometry(state, record);
      return false;
    case Stage::placed_normals:
      place_normals(state, record);
      return false;
    case Stage::normals:
      read_normals(state, record);
      return false;
    case Stage::texture:
      step_texture(state, record);
      return false;
    case Stage::color_texture:
      turn_to_color(state, record);
      return false;
    case Stage::material:
    case Stage::textured_material:
      read_material(state, record);
      return false;
    case Stage::finish:
      read_extension(state, record);
      return false;
    case Stage::sky:
      read_sky(state, record);
      return false;
    case Stage::light:
      return read_light(state, record, child);
    case Stage::emitter_choice:
      read_choice(state, record, header_.emitter_count, Stage::emitter);
      return false;
    case Stage::emitter:
      return read_emitter(state, record, child);
    case Stage::sky_choice:
      read_choice(state, record, sky_tile_count(header_.sky), Stage::sky_aim);
      return false;
    case Stage::sky_aim:
      return read_sky_aim(state, record, child);
    case Stage::reflected:
    case Stage::refracted:
      return send_alone(state, child);
    case Stage::continued:
      return send_on(state, child);
    case Stage::finished:
      break;
  }
  expect(false, "a finished hit is not shaded again");
  return false;
}

}  // namespace dmpc::core
