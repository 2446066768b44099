// Light, reflectance and metals as pbrt's scenes name them, in linear sRGB.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "apps/foreign/pbrt/parameters.h"
#include "core/base/vec.h"

namespace dmpc::apps::pbrt {

/// What a spectrum is meant for. A reflectance is what a white light comes back as; light that is no rgb has the luminance 1,
/// whatever its numbers, as pbrt-v4 scales it; an index is a number in each channel.
enum class SpectrumUse : std::uint8_t { reflectance, light, index };

/// Of an rgb, spectrum or blackbody parameter, by the matching functions of CIE 1931 as fits of Gaussians have them (C. Wyman,
/// P.-P. Sloan, P. Shirley, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions", JCGT 2013). Throws
/// core::InputError at its place for a name that nobody knows, and for numbers out of range.
core::Vec3d color_of(const Parameter& parameter, const Parameters& owner, SpectrumUse use);

/// What a metal reflects straight ahead, by its index eta + i k (Fresnel), channel by channel.
core::Vec3d straight_reflection(const core::Vec3d& eta, const core::Vec3d& k);
/// Of a metal by pbrt's name of its spectra, "metal-Cu-eta" and "metal-Cu-k".
core::Vec3d copper_eta();
core::Vec3d copper_k();

double luminance(const core::Vec3d& color);

}  // namespace dmpc::apps::pbrt
