#include "apps/foreign/pbrt/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/frontend/line/shown_text.h"
#include "core/base/elementary.h"

namespace dmpc::apps::pbrt {
namespace {

using core::Vec3d;
using enum ParameterType;

/// Kinds of pbrt-v3.
constexpr std::array<std::string_view, 11> old_kinds{"matte",     "plastic",     "metal",  "glass",        "mirror", "uber",
                                                     "substrate", "translucent", "disney", "kdsubsurface", "fourier"};

double mean(const Vec3d& v) { return (v.x + v.y + v.z) / 3; }

Vec3d clamped(const Vec3d& color) {
  return {std::clamp(color.x, 0.0, 1.0), std::clamp(color.y, 0.0, 1.0), std::clamp(color.z, 0.0, 1.0)};
}

/// Returns the share of diffuse light inside a medium of this index that its smooth surface reflects inwards: all but 1/n^2 of
/// the transmittance (S. Duntley, "The Optical Properties of Diffusing Materials", JOSA 32, 1942, for the mean of Fresnel's
/// reflection outside).
double inner_reflection(double index) {
  constexpr double index_min = 1.001;  // the formula is unusable below
  if (!(index > index_min)) {
    return 0;
  }
  const double n = index, square = n * n, sum = square + 1, difference = square - 1, fourth = square * square;
  const double outside = 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
                         square * difference * difference / (sum * sum * sum) * core::natural_log((n - 1) / (n + 1)) -
                         2 * n * square * (square + 2 * n - 1) / (sum * (fourth - 1)) +
                         8 * fourth * (fourth + 1) / (sum * (fourth - 1) * (fourth - 1)) * core::natural_log(n);
  return 1 - (1 - outside) / square;
}

/// Returns the reflectance of both faces of a pane, from that of one face.
double of_both_faces(double one) { return 2 * one / (1 + one); }

/// Returns the reflectance at normal incidence of a metal with this index, per channel.
Vec3d channels_of(const Vec3d& eta, const Vec3d& k, double below) {
  const auto channel = [below](double n, double k_of) { return straight_reflection(n / below, k_of / below); };
  return {channel(eta.x, k.x), channel(eta.y, k.y), channel(eta.z, k.z)};
}

/// Returns the k that gives a metal with eta 1 this reflectance.
double k_of_reflectance(double share) {
  const double most = std::min(share, 0.9999);
  return 2 * std::sqrt(most / (1 - most));
}

/// Blends two surfaces; the result has the kind of the one with the larger share.
Surface blended(const Surface& first, const Surface& second, double amount) {
  Surface result = amount < 0.5 ? first : second;
  const auto between = [&](double a, double b) { return a + (b - a) * amount; };
  result.has_facets = first.has_facets || second.has_facets;
  result.is_drawn = first.is_drawn || second.is_drawn;
  result.color.color = first.color.color * (1 - amount) + second.color.color * amount;
  result.facets.metallic = between(first.facets.metallic, second.facets.metallic);
  result.facets.roughness = between(first.facets.roughness, second.facets.roughness);
  result.facets.transmission = between(first.facets.transmission, second.facets.transmission);
  return result;
}

}  // namespace

Surfaces::Surfaces(Notes& notes, const Textures& textures) : notes_(notes), textures_(textures) {
  slots_.push_back({});
  slots_[0].surface = Surface{.color = {.color = {0.5, 0.5, 0.5}, .picture = {}, .place = {}}, .facets = {}};
}

std::uint32_t Surfaces::announce(const std::optional<std::string>& name, const std::string& kind, const Parameters& parameters) {
  if (std::find(old_kinds.begin(), old_kinds.end(), kind) != old_kinds.end()) {
    parameters.fail("the material '" + kind + "' is one of pbrt-v3: turn the scene into one of version 4 by pbrt --upgrade");
  }
  if (!name) {
    slots_.emplace_back();
    slots_.back().place = parameters.place();
    return static_cast<std::uint32_t>(slots_.size() - 1);
  }
  const std::uint32_t number = named(*name, parameters.place());
  if (kind.empty()) {
    parameters.fail("has no \"string type\", as each material that is named has one");
  }
  if (std::exchange(slots_[number].is_announced, true)) {
    parameters.fail("there is a material of this name already");
  }
  return number;
}

std::uint32_t Surfaces::named(const std::string& name, const Place& place) {
  const auto [found, is_new] = names_.try_emplace(name, static_cast<std::uint32_t>(slots_.size()));
  if (is_new) {
    slots_.emplace_back();
    slots_.back().name = name;
    slots_.back().place = place;
  }
  return found->second;
}

void Surfaces::make(std::uint32_t slot, const std::string& kind, const Parameters& parameters) {
  for (const char* const map : {"displacement", "normalmap"}) {
    const bool is_there = parameters.find(map, {texture, text, number}) != nullptr;
    notes_.count("materials with displacement or a map of normals, shown without", is_there ? 1 : 0);
  }
  if (kind == "mix") {
    const Mixture mixture = mixture_of(parameters);  // this may create slots for the names that it mixes
    slots_[slot].mixture = mixture;
  } else {
    slots_[slot].surface = surface_of(kind, parameters);
  }
}

Surfaces::Mixture Surfaces::mixture_of(const Parameters& parameters) {
  const Parameter* const names = parameters.find("materials", {text});
  if (names == nullptr || names->texts.size() != 2) {
    parameters.fail("a mixture is of two \"string materials\"");
  }
  notes_.count("mixtures of materials, shown as one with mean numbers");
  const double amount = std::clamp(textures_.number(parameters, "amount").value_or(0.5), 0.0, 1.0);
  return {named(names->texts[0], names->place), named(names->texts[1], names->place), amount};
}

/// Returns the roughness as in glTF: its square is alpha.
double Surfaces::roughness(const Parameters& parameters, const std::string& prefix, double fallback) const {
  const auto find = [&](const char* name) { return textures_.number(parameters, (prefix + name).c_str()); };
  const double both = find("roughness").value_or(fallback);
  const double u = std::max(find("uroughness").value_or(both), 0.0), v = std::max(find("vroughness").value_or(both), 0.0);
  notes_.count("materials that are rougher one way than the other, shown by the mean", u < v || v < u ? 1 : 0);
  const bool is_remapped = parameters.flag("remaproughness", true);
  const double rough = std::sqrt(u * v), alpha = is_remapped ? std::sqrt(rough) : rough;
  constexpr double smooth_alpha = 1e-3;  // the limit below which pbrt assumes a mirror
  return alpha < smooth_alpha ? 0 : std::clamp(std::sqrt(alpha), 0.0, 1.0);
}

double Surfaces::index(const Parameters& parameters, const char* name, double fallback) const {
  if (const Parameter* const found = parameters.find(name, {rgb, spectrum})) {
    return mean(color_of(*found, parameters, SpectrumUse::index));
  }
  return parameters.number(name, fallback);
}

Surface Surfaces::diffuse(const Parameters& parameters, const char* name, double fallback) const {
  return {.color = textures_.color(parameters, name, {fallback, fallback, fallback}, SpectrumUse::reflectance), .facets = {}};
}

Vec3d Surfaces::metal(const Parameters& parameters, const std::string& prefix, double below) const {
  const auto of = [&](const std::string& name) { return parameters.find(prefix + name, {texture, rgb, spectrum}); };
  const Parameter *const eta = of("eta"), *const k = of("k");
  const auto color = textures_.color(parameters, "reflectance", SpectrumUse::reflectance);
  if (color && (eta != nullptr || k != nullptr)) {
    parameters.fail("a metal has a reflectance, or eta and k, not both");
  }
  if (color) {
    const Vec3d share = clamped(color->color);
    return below == 1
               ? share
               : channels_of({1, 1, 1}, {k_of_reflectance(share.x), k_of_reflectance(share.y), k_of_reflectance(share.z)}, below);
  }
  const auto is_spectrum = [](const Parameter* one) { return one == nullptr || one->type == spectrum; };
  if (is_spectrum(eta) && is_spectrum(k)) {
    return metal_color(eta, k, below);
  }
  const auto part = [&](const char* name, double fallback) {
    return textures_.color(parameters, (prefix + name).c_str(), {fallback, fallback, fallback}, SpectrumUse::index).color;
  };
  return channels_of(part("eta", 1), part("k", 2), below);
}

Surface Surfaces::conductor(const Parameters& parameters, const std::string& prefix) const {
  Surface surface{.has_facets = true, .facets = {.metallic = 1}};
  surface.facets.roughness = roughness(parameters, prefix, 0);
  if (const auto color = textures_.color(parameters, "reflectance", SpectrumUse::reflectance)) {
    surface.color = *color;
  }
  surface.color.color = metal(parameters, prefix, 1);
  return surface;
}

/// Returns a metal with the colour of the light reflected by a smooth coat and, through both faces of the coat, by the metal.
Surface Surfaces::coated_conductor(const Parameters& parameters) const {
  notes_.count("coats of metals, shown in the metal's colour and roughness");
  Surface surface = conductor(parameters, "conductor.");
  const double coat = std::max(index(parameters, "interface.eta", 1.5), 1.0), face = straight_reflection(coat, 0);
  const auto through = [face](double share) { return face + (1 - face) * (1 - face) * share / (1 - share * face); };
  const Vec3d below = metal(parameters, "conductor.", coat);
  surface.color.color = {through(below.x), through(below.y), through(below.z)};
  return surface;
}

/// Light is reflected repeatedly between the diffuse base and the coat: of reflectance R, R (1 - f) / (1 - R f) emerges.
Surface Surfaces::coated(const Parameters& parameters) const {
  Surface surface = diffuse(parameters, "reflectance", 0.5);
  surface.has_facets = true;
  surface.facets.metallic = 0;
  surface.facets.roughness = roughness(parameters, "", 0);
  surface.facets.refraction_index = index(parameters, "eta", 1.5);
  Vec3d& color = surface.color.color;
  const double f = inner_reflection(surface.facets.refraction_index);
  if (surface.color.picture) {
    const double held = std::min(f * mean(color), coat_max);
    surface.color.picture->edges.coat = held;
    color = color * ((1 - f) / (1 - held));
  } else {
    color = clamped(color);
    color = {color.x * (1 - f) / (1 - color.x * f), color.y * (1 - f) / (1 - color.y * f), color.z * (1 - f) / (1 - color.z * f)};
  }
  return surface;
}

Surface Surfaces::glass(const Parameters& parameters, bool is_thin) const {
  Surface surface{.has_facets = true, .is_thin = is_thin, .facets = {.metallic = 0, .roughness = 0, .transmission = 1}};
  surface.facets.refraction_index = index(parameters, "eta", 1.5);
  if (!is_thin) {
    surface.facets.roughness = roughness(parameters, "", 0);
    notes_.count("rough glass, which is shown letting light through as smooth", surface.facets.roughness > 0 ? 1 : 0);
  }
  return surface;
}

Surface Surfaces::surface_of(const std::string& kind, const Parameters& parameters) const {
  if (kind == "diffuse") {
    return diffuse(parameters, "reflectance", 0.5);
  }
  if (kind == "coateddiffuse") {
    return coated(parameters);
  }
  if (kind == "conductor") {
    return conductor(parameters, "");
  }
  if (kind == "coatedconductor") {
    return coated_conductor(parameters);
  }
  if (kind == "dielectric" || kind == "thindielectric") {
    return glass(parameters, kind == "thindielectric");
  }
  if (kind == "interface" || kind == "none" || kind.empty()) {
    Surface surface;
    surface.is_drawn = false;
    return surface;
  }
  if (kind == "diffusetransmission") {
    notes_.count("materials that scatter light through, shown as opaque");
    parameters.find("transmittance", {texture, rgb, spectrum});
    Surface surface = diffuse(parameters, "reflectance", 0.25);
    surface.color.color = surface.color.color * parameters.number("scale", 1);
    return surface;
  }
  if (kind == "subsurface" || kind == "hair" || kind == "measured") {
    notes_.count("materials of kind '" + kind + "', shown as diffuse");
    const bool has_color = kind == "hair" && parameters.find("reflectance", {texture, rgb, spectrum}) == nullptr;
    return diffuse(parameters, has_color ? "color" : "reflectance", 0.5);
  }
  parameters.fail("there is no material of kind '" + clipped(kind, 40) + "' in pbrt-v4");
}

const Surface& Surfaces::settled(std::uint32_t number, int level, const Tokens& tokens) {
  constexpr int levels_max = 100;
  Slot& slot = slots_[number];
  if (slot.is_being_mixed || level > levels_max) {
    tokens.fail(slot.place, "the material \"" + clipped(slot.name, 60) + "\" is mixed of itself, or too deep");
  }
  if (!slot.surface && !slot.mixture) {
    tokens.fail(slot.place, "the material \"" + clipped(slot.name, 60) + "\" is not there: no MakeNamedMaterial has that name");
  }
  if (!slot.surface) {
    slot.is_being_mixed = true;
    const Surface first = settled(slot.mixture->first, level + 1, tokens),
                  second = settled(slot.mixture->second, level + 1, tokens);
    slot.surface = blended(first, second, slot.mixture->amount);
    slot.is_being_mixed = false;
  }
  return *slot.surface;
}

void Surfaces::settle(const Tokens& tokens) {
  for (std::uint32_t number = 0; number < slots_.size(); ++number) {
    settled(number, 0, tokens);
  }
}

FileMaterial Surfaces::material_of(const Surface& surface, const Vec3d& emission, double opacity) {
  FileMaterial result{.texture = surface.color.picture, .place = surface.color.place};
  if (result.texture) {
    result.texture->edges.alpha = TextureAlpha::said;
  }
  core::Material& material = result.material;
  if (!surface.has_facets) {
    material = apps::material_of(PhongSurface{.diffuse = surface.is_drawn ? clamped(surface.color.color) : Vec3d{},
                                              .specular = {},
                                              .emission = emission,
                                              .opacity = opacity,
                                              .illumination = std::nullopt});
    return result;
  }
  MetallicSurface facets = surface.facets;
  facets.base = clamped(surface.color.color);
  facets.emission = emission;
  facets.opacity = opacity;
  material = apps::material_of(facets);
  if (surface.is_thin) {  // transmitted light keeps its direction
    material.refraction_index = 1;
    material.specular = of_both_faces(material.specular);
    material.transmittance = 1 - material.specular;
    material.microfacets.reflectance = of_both_faces(material.microfacets.reflectance);
  }
  return result;
}

}  // namespace dmpc::apps::pbrt
