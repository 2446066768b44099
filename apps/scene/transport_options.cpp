#include "apps/scene/transport_options.h"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/words.h"
#include "apps/scene/scene_setup.h"
#include "core/picture/surfaces/microfacet_lobes.h"

namespace dmpc::apps {
namespace {

using core::TransportKind;
using core::UsageError;

/// One less than under other skies.
constexpr int bounces_below_picture_max = 253;
constexpr const char* beside_sky =
    " does not go with --sky, nor with the default sky of a mesh without other light, since a sky is the background: give --sky "
    "alone, or --transport=whitted";
/// The threshold for a gain above 1, with tolerance for rounding.
constexpr double gain_min = 1 + 1e-6;

double parse_light_radius(const std::string& text) {
  return parse_within(text, "--light-radius", above_0, 1e15, "a length in the scene's units, above 0 and at most 1e15");
}

void refuse_each(const OptionSet& options, std::initializer_list<const char*> names, const std::string& why) {
  for (const char* const name : names) {
    if (options.is_given(name)) {
      throw UsageError(name + why);
    }
  }
}

void check_paths(const OptionSet& options, const TransportOptions& transport) {
  const std::string by_paths = options.is_given("--transport")
                                   ? " does not go with --transport=paths: "
                                   : " does not go with paths, the default of a mesh unless --transport=whitted is given: ";
  refuse_each(options, {"--depth"}, by_paths + "use --bounces");
  refuse_each(options, {"--cutoff"},
              by_paths + "paths that contribute little are ended by Russian roulette, which loses no light");
  refuse_each(options, {"--ambient"}, by_paths + "light from everywhere is a sky, use --sky");
  if (transport.sky) {
    refuse_each(options, {"--background"}, beside_sky);
    if (transport.sky->is_picture() && transport.bounces > bounces_below_picture_max) {
      throw UsageError("--bounces=" + std::to_string(transport.bounces) + ": with an environment map expected at most " +
                       std::to_string(bounces_below_picture_max) + ", as the last ray to it is one deeper");
    }
  }
}

/// Returns whether the text can only be colours, valid or not; other text is a file name.
bool is_of_numbers(const std::string& text) {
  std::string rest = text;
  for (const std::string_view word : {"nan", "inf"}) {
    for (std::size_t at = rest.find(word); at != std::string::npos; at = rest.find(word)) {
      rest.erase(at, word.size());
    }
  }
  return rest.find_first_not_of("0123456789+-.,/eE") == std::string::npos;
}

/// Returns the sum over all ways in which the material sends light on, each in its brightest channel.
double share_sent_on(const core::Material& material) {
  if (material.microfacets.are_there()) {
    return core::sent_on_straight(material);
  }
  const core::Vec3d& color = material.color;
  return material.diffuse * std::max({color.x, color.y, color.z}) + material.specular_max() * material.mirror +
         material.transmittance;
}

}  // namespace

SkyChoice mesh_sky() { return {.horizon = {0.25, 0.27, 0.3}, .zenith = core::Vec3d{1.6, 1.5, 1.4}}; }

SkyChoice parse_sky(const std::string& text) {
  if (!is_of_numbers(text)) {
    return {.horizon = {}, .zenith = {}, .file = text};
  }
  const std::vector<std::string> parts = words_between(text, '/');
  try {
    SkyChoice sky{.horizon = parse_color("--sky", parts.at(0)), .zenith = {}};
    if (parts.size() > 1) {
      sky.zenith = parse_color("--sky", parts[1]);
    }
    if (parts.size() <= 2) {
      return sky;
    }
  } catch (const UsageError&) {  // its message names only a part
  }
  throw UsageError(
      "--sky=" + text +
      ": expected a colour such as 1,1,1 or 0.5, of numbers from 0 to 1e30, HORIZON/ZENITH such as 1,1,1/0.2,0.4,1, or the file "
      "of a picture");
}

std::string text_of(const SkyChoice& sky) {
  return sky.is_picture() ? sky.file : text_of(sky.horizon) + (sky.zenith ? "/" + text_of(*sky.zenith) : "");
}

std::string text_of(const TransportOptions& transport) {
  const std::string name = name_of(transport.kind);
  return !transport.is_by_paths()
             ? name
             : name + ", " + counted(static_cast<std::uint64_t>(transport.bounces), "bounce") +
                   (transport.sky ? ", sky " + text_of(*transport.sky) : "") +
                   (transport.light_radius ? ", lights of radius " + shortest(*transport.light_radius) : "") +
                   (transport.clamp > 0 ? ", indirect light clamped to " + shortest(transport.clamp) : "");
}

const char* name_of(TransportKind kind) { return kind == TransportKind::paths ? "paths" : "whitted"; }

void add_options(OptionSet options, TransportOptions& transport) {
  options.add_choice<TransportKind>("--transport", transport.kind,
                                    {{"whitted", TransportKind::whitted}, {"paths", TransportKind::paths}},
                                    "whitted: mirror reflection and transmission only. paths: path tracing, which also scatters "
                                    "light between surfaces; more --samples reduce its noise");
  options.add_number("--bounces", transport.bounces, 0, 254, "8",
                     "Paths: how often indirect light is scattered from surface to surface; 0 is direct light only. A pbrt file "
                     "has its own number, which this option overrides");
  options.add_text(
      "--sky", "R,G,B|GREY[/R,G,B|GREY]|FILE [none]", [&transport](const std::string& text) { transport.sky = parse_sky(text); },
      "Paths: the radiance of rays that hit nothing, which lights the scene: one colour, or a gradient from the horizon to the "
      "zenith, or an environment map (EXR, HDR, ...) of all directions, twice as wide as high, with the zenith at its upper "
      "edge. The zenith is where the scene's up points (for a mesh --up, else the up of the file's view). The middle of the map "
      "lies along z if up is y, along x if up is z, along y if up is x; its left half lies to the left of a viewer who looks "
      "there");
  options.add_number("--emitters", transport.emitters, 0, emitters_limit, "1024",
                     "Paths: the number of emissive triangles and spheres for light sampling, the most powerful; others are "
                     "found by BSDF sampling alone, which gives the same light with more noise");
  options.add_text(
      "--light-radius", "R [points]",
      [&transport](const std::string& text) { transport.light_radius = parse_light_radius(text); },
      "Paths: turn point lights into spheres of this radius, in the scene's units, which are visible, fall off and cast soft "
      "shadows; in the middle of the scene they are as bright as the points were");
  options.add_text(
      "--clamp", "V [never]",
      [&transport](const std::string& text) {
        transport.clamp = parse_within(text, "--clamp", 1e-6, 1e30, "a radiance from 1e-6 to 1e30");
      },
      "Paths: scale down what a sample receives at once of light that more than one surface has sent on, such as a lamp's in a "
      "mirror's caustic, to V in its brightest channel, where white is 1. Less noise, and a darker picture");
}

void check(const OptionSet& options, const TransportOptions& transport) {
  if (transport.is_by_paths()) {
    return check_paths(options, transport);
  }
  if (transport.sky) {
    refuse_each(options, {"--background"}, beside_sky);
  }
  refuse_each(options, {"--bounces", "--sky", "--emitters", "--light-radius", "--clamp"}, " goes with --transport=paths");
}

core::Transport transport_of(const TransportOptions& options, const core::Vec3d& zenith) {
  core::Transport transport{.kind = options.kind};
  if (options.sky) {
    transport.has_sky = true;
    transport.has_gradient = options.sky->zenith.has_value();
    transport.zenith = core::Color(options.sky->zenith.value_or(core::Vec3d{}));
    transport.up = core::Vec3f(zenith);
  }
  return transport;
}

std::string emitters_text(const EmitterCounts& counts, const TransportOptions& options) {
  if (options.emitters_max() == 0) {
    return "";
  }
  const auto shine = [](std::uint64_t count) { return counted(count, "primitive") + (count == 1 ? " shines" : " shine"); };
  const std::string others =
      counts.others == 0 ? ""
                         : shine(counts.others) + " and " + (counts.others == 1 ? "is" : "are") +
                               " found by BSDF sampling alone, which is noisy: " +
                               (counts.emitters == options.emitters
                                    ? "--emitters=" + std::to_string(options.emitters) + " samples no more"
                                    : "cones, emitters a millionth as strong as others, and those that alpha partly removes");
  const std::string covered =
      counts.covered == 0
          ? ""
          : shine(counts.covered) +
                " in the plane of faces that show before: what these leave of that, if anything, is found by BSDF sampling alone";
  return others + (others.empty() || covered.empty() ? "" : "; ") + covered;
}

std::string gain_text(const std::vector<core::Material>& materials, const TransportOptions& options) {
  double most = 0;
  std::uint64_t count = 0;
  for (const core::Material& material : materials) {
    most = std::max(most, share_sent_on(material));
    count += share_sent_on(material) > gain_min ? 1 : 0;
  }
  return count == 0 || !options.is_by_paths()
             ? ""
             : counted(count, "material") + (count == 1 ? " sends" : " send") + " on more light than arrives, up to " +
                   rounded(most) + " times as much: with many bounces the picture is brighter than it can be";
}

}  // namespace dmpc::apps
