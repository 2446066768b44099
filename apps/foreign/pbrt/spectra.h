// Emission, reflectance and metal spectra of pbrt scenes, converted to linear sRGB.
#pragma once

#include <array>
#include <string>

#include "apps/foreign/pbrt/parameters.h"
#include "core/base/vec.h"

namespace dmpc::apps::pbrt {

/// A reflectance becomes the colour of reflected white light. A light that is not given as rgb is scaled to luminance 1, as in
/// pbrt-v4. An index is converted to one number per channel.
enum class SpectrumUse : std::uint8_t { reflectance, light, index };

/// Converts an rgb, spectrum or blackbody parameter with the CIE 1931 observer; reflectances are seen under daylight (D65). A
/// spectrum is 0 outside its range. Throws core::InputError, with the position, for numbers out of range and dark lights.
core::Vec3d color_of(const Parameter& parameter, const Parameters& owner, SpectrumUse use);
/// Returns whether pbrt-v4 has a light, metal or glass spectrum of this name; otherwise it is a file name.
bool is_named_spectrum(const std::string& name);

/// Returns the Fresnel reflectance at normal incidence for the relative index n + i k.
double straight_reflection(double n, double k);
/// Returns a metal's colour, computed per wavelength, with copper for missing spectra. `below`: index of the medium outside.
core::Vec3d metal_color(const Parameter* eta, const Parameter* k, double below);

/// Returns the rows of the matrix that maps light of this temperature to white, in linear sRGB.
std::array<core::Vec3d, 3> white_balance(double kelvin);

double luminance(const core::Vec3d& color);

}  // namespace dmpc::apps::pbrt
