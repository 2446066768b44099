#include "apps/foreign/pbrt/spectra.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/edge/line/shown_text.h"
#include "core/base/elementary.h"

namespace dmpc::apps::pbrt {
namespace {

using core::Vec3d;

constexpr double first_nm = 360, last_nm = 830, step_nm = 5;

/// One half of a Gaussian to the left of its middle, another to the right.
double lobe(double nm, double middle, double left, double right) {
  const double t = (nm - middle) * (nm < middle ? left : right);
  return core::exponential(-0.5 * t * t);
}

Vec3d matching(double nm) {
  return {1.056 * lobe(nm, 599.8, 1 / 37.9, 1 / 31.0) + 0.362 * lobe(nm, 442.0, 1 / 16.0, 1 / 26.7) -
              0.065 * lobe(nm, 501.1, 1 / 20.4, 1 / 26.2),
          0.821 * lobe(nm, 568.8, 1 / 46.9, 1 / 40.5) + 0.286 * lobe(nm, 530.9, 1 / 16.3, 1 / 31.1),
          1.217 * lobe(nm, 437.0, 1 / 11.8, 1 / 36.0) + 0.681 * lobe(nm, 459.0, 1 / 26.0, 1 / 13.8)};
}

/// IEC 61966-2-1.
Vec3d rgb_of(const Vec3d& xyz) {
  return {3.2406 * xyz.x - 1.5372 * xyz.y - 0.4986 * xyz.z, -0.9689 * xyz.x + 1.8758 * xyz.y + 0.0415 * xyz.z,
          0.0557 * xyz.x - 0.2040 * xyz.y + 1.0570 * xyz.z};
}

template <class Value>
Vec3d integral(const Value& value) {
  Vec3d sum;
  for (double nm = first_nm; nm <= last_nm; nm += step_nm) {
    sum = sum + matching(nm) * value(nm);
  }
  return sum;
}

Vec3d without_negative(const Vec3d& color) { return {std::max(color.x, 0.0), std::max(color.y, 0.0), std::max(color.z, 0.0)}; }

/// Of luminance 1.
Vec3d light_of(const Vec3d& xyz) {
  const Vec3d color = xyz.y > 0 ? without_negative(rgb_of(xyz * (1 / xyz.y))) : Vec3d{};
  const double bright = luminance(color);
  return bright > 0 ? color * (1 / bright) : Vec3d{};
}

/// As what reflects all of each wavelength is white.
Vec3d reflectance_of(const Vec3d& xyz) {
  const Vec3d color = rgb_of(xyz), white = rgb_of(integral([](double /*nm*/) { return 1.0; }));
  return without_negative({color.x / white.x, color.y / white.y, color.z / white.z});
}

/// Planck's law, up to a factor.
double black_body(double nm, double kelvin) {
  constexpr double second_radiation_constant = 1.438777e7;  // nm K
  const double x = nm / 500;
  return 1 / (x * x * x * x * x * (core::exponential(second_radiation_constant / (nm * kelvin)) - 1));
}

/// Straight between its points, as the last beyond them.
double value_at(const std::vector<double>& pairs, double nm) {
  if (nm <= pairs[0]) {
    return pairs[1];
  }
  for (std::size_t i = 2; i < pairs.size(); i += 2) {
    if (nm <= pairs[i]) {
      const double share = (nm - pairs[i - 2]) / (pairs[i] - pairs[i - 2]);
      return pairs[i - 1] + (pairs[i + 1] - pairs[i - 1]) * share;
    }
  }
  return pairs.back();
}

/// At the wavelengths of red, green and blue.
Vec3d index_of(const std::vector<double>& pairs) { return {value_at(pairs, 630), value_at(pairs, 532), value_at(pairs, 465)}; }

struct NamedIndex {
  std::string_view name;
  Vec3d value;
};

/// At red, green and blue, as tables that renderers share have them; nobody has held them against measurements here. Of glasses
/// at the yellow line of sodium.
constexpr std::array<NamedIndex, 22> named_indices{
    {{"metal-Ag-eta", {0.155275, 0.116723, 0.138342}}, {"metal-Ag-k", {4.828384, 3.122506, 2.146966}},
     {"metal-Al-eta", {1.657460, 0.880369, 0.521229}}, {"metal-Al-k", {9.223869, 6.269523, 4.837001}},
     {"metal-Au-eta", {0.143119, 0.374957, 1.442479}}, {"metal-Au-k", {3.983160, 2.385721, 1.603215}},
     {"metal-Cu-eta", {0.200438, 0.924033, 1.102212}}, {"metal-Cu-k", {3.912949, 2.452848, 2.142188}},
     {"metal-CuZn-eta", {0.444, 0.527, 1.094}},        {"metal-CuZn-k", {3.695, 2.765, 1.829}},
     {"metal-MgO-eta", {1.735, 1.741, 1.751}},         {"metal-MgO-k", {0, 0, 0}},
     {"metal-TiO2-eta", {2.58, 2.66, 2.78}},           {"metal-TiO2-k", {0, 0, 0}},
     {"glass-BK7", {1.5168, 1.5168, 1.5168}},          {"glass-BAF10", {1.6700, 1.6700, 1.6700}},
     {"glass-FK51A", {1.4866, 1.4866, 1.4866}},        {"glass-LASF9", {1.8503, 1.8503, 1.8503}},
     {"glass-F5", {1.6034, 1.6034, 1.6034}},           {"glass-F10", {1.6231, 1.6231, 1.6231}},
     {"glass-F11", {1.6206, 1.6206, 1.6206}},          {"glass-SF11", {1.7847, 1.7847, 1.7847}}}};

Vec3d named(const std::string& name, const Parameter& parameter, const Parameters& owner, SpectrumUse use) {
  if (name.starts_with("stdillum-") || name.starts_with("illum-")) {
    return {1, 1, 1};
  }
  const auto found =
      std::find_if(named_indices.begin(), named_indices.end(), [&](const NamedIndex& one) { return one.name == name; });
  if (found == named_indices.end() || use != SpectrumUse::index) {
    owner.fail(parameter.place, "parameter \"" + clipped(parameter.name, 40) + "\": the spectrum '" + clipped(name, 60) +
                                    "' is not known here; write it as numbers, pairs of wavelength and value, or as rgb");
  }
  return found->value;
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

Vec3d straight_reflection(const Vec3d& eta, const Vec3d& k) {
  const auto channel = [](double n, double k_of) {
    return ((n - 1) * (n - 1) + k_of * k_of) / ((n + 1) * (n + 1) + k_of * k_of);
  };
  return {channel(eta.x, k.x), channel(eta.y, k.y), channel(eta.z, k.z)};
}

Vec3d copper_eta() { return named_indices[6].value; }
Vec3d copper_k() { return named_indices[7].value; }

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
    return light_of(integral([&](double nm) { return black_body(nm, kelvin); }));
  }
  if (!parameter.texts.empty()) {
    return named(parameter.texts[0], parameter, owner, use);
  }
  check_wavelengths(parameter, owner);
  if (use == SpectrumUse::index) {
    return index_of(parameter.numbers);
  }
  const Vec3d xyz = integral([&](double nm) { return value_at(parameter.numbers, nm); });
  return use == SpectrumUse::light ? light_of(xyz) : reflectance_of(xyz);
}

}  // namespace dmpc::apps::pbrt
