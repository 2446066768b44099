// Light, reflectance and metals as pbrt's scenes name them, in linear sRGB.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "apps/foreign/pbrt/parameters.h"
#include "core/base/vec.h"

namespace dmpc::apps::pbrt {

/// A reflectance is the colour that white light comes back as; light that is not given as rgb has luminance 1, as pbrt-v4 scales
/// it; an index is a number per channel.
enum class SpectrumUse : std::uint8_t { reflectance, light, index };

/// Colour of an rgb, spectrum or blackbody parameter, by CIE's observer of 1931; reflectances under daylight (D65). A spectrum is
/// 0 beyond its points. Throws core::InputError, with its place, for numbers out of range, and for a light without light.
core::Vec3d color_of(const Parameter& parameter, const Parameters& owner, SpectrumUse use);
/// Whether pbrt-v4 knows a light, a metal or a glass by this name; else it is a file's.
bool is_named_spectrum(const std::string& name);

/// What a metal reflects straight ahead by its index eta + i k, below what has the index `below` (Fresnel).
double straight_reflection(double n, double k);
/// Metal's colour from spectra, wavelength by wavelength; copper's where there is none.
core::Vec3d metal_color(const Parameter* eta, const Parameter* k, double below);

/// Rows of what makes white of a light's temperature, in linear sRGB.
std::array<core::Vec3d, 3> white_balance(double kelvin);

double luminance(const core::Vec3d& color);

}  // namespace dmpc::apps::pbrt
