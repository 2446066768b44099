#include "apps/foreign/pbrt/spectra.h"

#include <algorithm>
#include <vector>

#include "apps/foreign/pbrt/affine.h"
#include "apps/foreign/pbrt/spectra_tables.h"
#include "apps/frontend/line/shown_text.h"
#include "core/base/elementary.h"

namespace dmpc::apps::pbrt {
namespace {

using core::Vec3d;

constexpr double first_nm = 380, last_nm = 780, nm_step = 1;  // of the observer

/// Interpolates linearly between values at intervals of `step`; constant beyond them.
double between(const std::vector<double>& numbers, double first, double step, double nm) {
  const double place = std::clamp((nm - first) / step, 0.0, static_cast<double>(numbers.size() - 1));
  const std::size_t at = std::min(static_cast<std::size_t>(place), numbers.size() - 2);
  const double share = place - static_cast<double>(at);
  return numbers[at] * (1 - share) + numbers[at + 1] * share;
}

Vec3d matching(double nm) {
  static const std::vector<double>&x = *tabulated("observer", "x"), &y = *tabulated("observer", "y"),
               &z = *tabulated("observer", "z");
  const auto of = [nm](const std::vector<double>& weights) { return between(weights, first_nm, 5, nm); };
  return {of(x), of(y), of(z)};
}

double daylight_at(double nm) {
  static const std::vector<double>& daylight = *tabulated("daylight", "D65");
  return between(daylight, first_nm, 10, nm);
}

/// IEC 61966-2-1.
constexpr std::array<Vec3d, 3> rgb_rows{{{3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}}};

Vec3d rgb_of(const Vec3d& xyz) { return {dot(rgb_rows[0], xyz), dot(rgb_rows[1], xyz), dot(rgb_rows[2], xyz)}; }

template <class Value>
Vec3d integral(const Value& value) {
  Vec3d sum;
  for (double nm = first_nm; nm <= last_nm; nm += nm_step) {
    sum = sum + matching(nm) * value(nm);
  }
  return sum;
}

Vec3d without_negative(const Vec3d& color) { return {std::max(color.x, 0.0), std::max(color.y, 0.0), std::max(color.z, 0.0)}; }

/// Normalizes to luminance 1.
Vec3d light_of(const Vec3d& xyz) {
  const Vec3d color = xyz.y > 0 ? without_negative(rgb_of(xyz * (1 / xyz.y))) : Vec3d{};
  const double bright = luminance(color);
  return bright > 0 ? color * (1 / bright) : Vec3d{};
}

/// Integrates under daylight, in which full reflectance is white.
template <class Value>
Vec3d reflectance_of(const Value& value) {
  static const Vec3d white = rgb_of(integral(daylight_at));
  const Vec3d color = rgb_of(integral([&](double nm) { return value(nm) * daylight_at(nm); }));
  return without_negative({color.x / white.x, color.y / white.y, color.z / white.z});
}

/// Planck's law, up to a factor.
double black_body(double nm, double kelvin) {
  constexpr double second_radiation_constant = 1.438777e7;  // nm K
  const double x = nm / 500;
  return 1 / (x * x * x * x * x * (core::exponential(second_radiation_constant / (nm * kelvin)) - 1));
}

/// Interpolates linearly between the points; 0 beyond them.
double value_at(const std::vector<double>& pairs, double nm) {
  std::size_t low = 0, high = pairs.size() / 2;  // index of the first point beyond nm
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    (pairs[2 * middle] > nm ? high : low) = pairs[2 * middle] > nm ? middle : middle + 1;
  }
  if (low == 0 || 2 * low == pairs.size()) {
    return low > 0 && pairs[2 * low - 2] == nm ? pairs[2 * low - 1] : 0;
  }
  const double *const before = &pairs[2 * low - 2], *const after = before + 2;
  return before[1] + (after[1] - before[1]) * (nm - before[0]) / (after[0] - before[0]);
}

/// Looks up named metals and glasses, and spectra given as pairs.
double value_of(const Parameter& parameter, double nm) {
  constexpr double first = 400, step = 20;
  if (parameter.texts.empty()) {
    return value_at(parameter.numbers, nm);
  }
  const std::vector<double>* const metal = tabulated("metal", parameter.texts[0]);
  const std::vector<double>* const glass = tabulated("glass", parameter.texts[0]);
  return metal != nullptr ? between(*metal, first, step, nm) : glass != nullptr ? glass->front() : 0;
}

/// Converts CIE chromaticity to XYZ with luminance 1.
Vec3d xyz_of(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

Vec3d blackbody_light(double kelvin) {
  return integral([&](double nm) { return black_body(nm, kelvin); });
}

Vec3d times(const std::array<Vec3d, 3>& rows, const Vec3d& v) { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }

/// Returns the white of daylight (CIE 15, today's radiation constant) or, below daylight's range, of a black body.
Vec3d white_of(double kelvin) {
  const double t = kelvin * (1.4388 / 1.4380);
  if (t < 4000) {
    return blackbody_light(t);
  }
  const double x = t <= 7000 ? ((-4.607e9 / t + 2.9678e6) / t + 0.09911e3) / t + 0.244063
                             : ((-2.0064e9 / t + 1.9018e6) / t + 0.24748e3) / t + 0.23704;
  return xyz_of(x, (-3 * x + 2.870) * x - 0.275);
}

void check_wavelengths(const Parameter& parameter, const Parameters& owner) {
  for (std::size_t i = 2; i < parameter.numbers.size(); i += 2) {
    if (!(parameter.numbers[i] > parameter.numbers[i - 2])) {
      owner.fail(parameter.place, "parameter \"" + clipped(parameter.name, 40) + "\": wavelengths do not rise");
    }
  }
}

}  // namespace

double luminance(const Vec3d& color) { return 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z; }

double straight_reflection(double n, double k) { return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k); }

bool is_named_spectrum(const std::string& name) {
  return tabulated("light", name) != nullptr || tabulated("metal", name) != nullptr || tabulated("glass", name) != nullptr ||
         name == "metal-MgO-k" || name == "metal-TiO2-k";
}

Vec3d metal_color(const Parameter* eta, const Parameter* k, double below) {
  static const Parameter copper_eta{
      .type = ParameterType::spectrum, .name = "eta", .place = {}, .numbers = {}, .texts = {"metal-Cu-eta"}};
  static const Parameter copper_k{
      .type = ParameterType::spectrum, .name = "k", .place = {}, .numbers = {}, .texts = {"metal-Cu-k"}};
  const Parameter &n_of = eta != nullptr ? *eta : copper_eta, &k_of = k != nullptr ? *k : copper_k;
  return reflectance_of([&](double nm) { return straight_reflection(value_of(n_of, nm) / below, value_of(k_of, nm) / below); });
}

/// Von Kries adaptation in the Bradford space (K. M. Lam, 1985).
std::array<Vec3d, 3> white_balance(double kelvin) {
  const std::array<Vec3d, 3> cones{{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
  const Vec3d white = white_of(kelvin), from = times(cones, white * (1 / white.y)), to = times(cones, xyz_of(0.3127, 0.3290));
  const Transform cones_from_rgb = composed(Transform{cones, {}}, *inverse_of(Transform{rgb_rows, {}}));
  const Transform balanced = composed(scaling({to.x / from.x, to.y / from.y, to.z / from.z}), cones_from_rgb);
  return composed(*inverse_of(cones_from_rgb), balanced).rows;
}

Vec3d color_of(const Parameter& parameter, const Parameters& owner, SpectrumUse use) {
  constexpr double most = 1e12;
  const std::string what = "parameter \"" + clipped(parameter.name, 40) + "\"";
  const auto is_out = [](double value) { return !(value >= 0 && value <= most); };
  if (std::any_of(parameter.numbers.begin(), parameter.numbers.end(), is_out)) {
    owner.fail(parameter.place, what + " has a number that is below 0 or beyond 1e12");
  }
  if (parameter.type == ParameterType::rgb) {
    if (parameter.numbers.size() != 3) {
      owner.fail(parameter.place, what + " has more than one colour");
    }
    return triples(parameter.numbers)[0];
  }
  if (parameter.type == ParameterType::blackbody) {
    const double kelvin = parameter.numbers[0];
    if (parameter.numbers.size() != 1 || !(kelvin >= 500 && kelvin <= 1e6)) {
      owner.fail(parameter.place, what + ": expected one temperature from 500 to 1e6 K");
    }
    return light_of(blackbody_light(kelvin));
  }
  check_wavelengths(parameter, owner);
  const std::vector<double>* const named = parameter.texts.empty() ? nullptr : tabulated("light", parameter.texts[0]);
  if (named != nullptr && use != SpectrumUse::light) {
    owner.fail(parameter.place, what + ": '" + clipped(parameter.texts[0], 40) + "' is a light, and no " +
                                    (use == SpectrumUse::index ? "index" : "reflectance"));
  }
  const auto value = [&](double nm) { return value_of(parameter, nm); };
  if (use == SpectrumUse::index) {
    return {value(630), value(532), value(465)};  // wavelengths of red, green and blue
  }
  return use == SpectrumUse::reflectance ? reflectance_of(value)
                                         : light_of(named ? xyz_of(named->at(0), named->at(1)) : integral(value));
}

}  // namespace dmpc::apps::pbrt
