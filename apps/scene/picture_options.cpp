#include "apps/scene/picture_options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <vector>

#include "apps/database/database_file.h"
#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/parsed_number.h"
#include "apps/scene/load_scene.h"
#include "core/base/expect.h"
#include "core/picture/camera/frame_settings.h"
#include "core/picture/film/film_scale.h"

namespace dmpc::apps {

namespace {

constexpr int samples_max = 32768;

void take_samples(PictureOptions& picture, std::string_view text) {
  picture.is_refined = text == "auto";
  if (picture.is_refined) {
    picture.samples = refined_samples;
    return;
  }
  picture.samples = number_in<decltype(picture.samples)>(text).value_or(0);
  if (picture.samples < 1 || picture.samples > samples_max) {
    throw core::UsageError("--samples=" + std::string(text) + ": expected a whole number from 1 to 32768, or auto");
  }
}

/// `name` is one of all_skips, equal-frames or "all".
void switch_off(PictureOptions& picture, const std::string& name) {
  for (const core::Skip& skip : core::all_skips) {
    picture.skips.*skip.is_on = picture.skips.*skip.is_on && name != skip.name && name != "all";
  }
  picture.skips_equal_frames = picture.skips_equal_frames && name != equal_frames.name && name != "all";
}

void add_skip_option(OptionSet options, PictureOptions& picture) {
  std::vector<std::string> names;
  std::string table;
  const auto add = [&](const char* name, const char* what) {
    names.emplace_back(name);
    table += "\n" + std::string(name) + ": " + what;
  };
  for (const core::Skip& skip : core::all_skips) {
    add(skip.name, skip.what);
  }
  add(equal_frames.name, equal_frames.what);
  names.emplace_back("all");
  options.add_words(
      "--no-skip", names, [&picture](const std::string& name) { switch_off(picture, name); },
      "Disable an optimization that skips work which a scene does not need; the picture stays the same, to the last bit:" +
          table);
}

void apply_quality(const OptionSet& options, PictureOptions& picture) {
  if (!picture.quality) {
    return;
  }
  const QualityChoice choice = choice_of(*picture.quality);
  if (!options.is_given("--samples")) {
    take_samples(picture, "auto");
  }
  picture.cutoff = options.is_given("--cutoff") ? picture.cutoff : choice.cutoff;
  if (picture.is_refined && !options.is_given("--error")) {
    picture.refinement.error = choice.error;
  }
}

/// Options of lighting, except of path tracing alone. Each overrides the default lighting; quality and background do not.
constexpr std::array said_of_light{"--transport", "--light", "--fill", "--ambient", "--convention"};

/// Returns the first of these options that is given, or nothing.
const char* light_said(const OptionSet& options) {
  const auto* const said = std::ranges::find_if(said_of_light, [&](const char* name) { return options.is_given(name); });
  return said == said_of_light.end() ? nullptr : *said;
}

/// A complete scene's own sky is the default.
std::optional<SkyChoice> sky_of(const PictureOptions& picture) {
  return picture.transport.sky ? picture.transport.sky : is_below_own_sky(picture.scene) ? own_sky(picture.scene) : mesh_sky();
}

/// Rare light, such as that of a small lamp by two diffuse bounces, would ask for thousands in a few pixels.
constexpr std::uint32_t samples_max_of_meshes = 256;

void present_mesh(const OptionSet& options, PictureOptions& picture) {
  if (!picture.presents_meshes || !is_mesh(picture.scene)) {
    return;
  }
  const bool is_said = light_said(options) != nullptr;
  if (!is_said) {
    picture.is_by_paths_unasked = true;
    picture.transport.kind = core::TransportKind::paths;
    picture.transport.sky = sky_of(picture);
  }
  if (!options.is_given("--samples-max")) {
    picture.refinement.samples_max = samples_max_of_meshes;
  }
  const bool are_paths_asked_for = is_said && picture.transport.is_by_paths();
  if (!are_paths_asked_for && !options.is_given("--samples") && !picture.quality) {
    take_samples(picture, "auto");
    picture.is_refined_unasked = !options.is_given("--error");
  }
}

/// The cutoff of a quality applies only to transports without random choices.
void refine_paths(PictureOptions& picture) {
  picture.cutoff = 0;
  if (picture.is_refined) {
    constexpr std::uint32_t least = core::least_refined_samples(core::ErrorKind::noise);
    picture.refinement.kind = core::ErrorKind::noise;
    picture.samples = core::first_refined_samples(core::ErrorKind::noise);
    if (picture.refinement.samples_max < least) {
      throw core::UsageError("--samples-max=" + std::to_string(picture.refinement.samples_max) + ": by paths expected at least " +
                             std::to_string(least) + ", from which the error can be estimated; or give --transport=whitted");
    }
  }
}

/// Refuses --sky for a mesh if an option overrides the default lighting by paths; the error names that option.
void check_presented(const OptionSet& options, const PictureOptions& picture) {
  if (!picture.presents_meshes || !is_mesh(picture.scene) || !picture.transport.sky || picture.transport.is_by_paths() ||
      options.is_given("--transport") || options.is_given("--background")) {
    return;
  }
  if (const char* const said = light_said(options)) {
    throw core::UsageError(std::string("--sky goes with --transport=paths, which is the default of a mesh only if ") + said +
                           " is not given: give --transport=paths, too");
  }
}

/// With path tracing one number limits the rays' depth, and the background is the sky's horizon.
void settle_transport(const OptionSet& options, PictureOptions& picture) {
  const bool are_paths_its_own = picture.transport.is_by_paths() && is_below_own_sky(picture.scene);
  picture.transport.sky = are_paths_its_own ? sky_of(picture) : picture.transport.sky;
  check_presented(options, picture);
  check(options, picture.transport);
  if (!picture.transport.is_by_paths()) {
    return;
  }
  refine_paths(picture);
  picture.depth = picture.transport.depth();
  picture.transport.are_bounces_unasked = !options.is_given("--bounces");
  picture.is_one_path_unasked = picture.samples == 1 && !options.is_given("--samples");
  if (picture.transport.sky && !is_own_sky(picture)) {
    picture.scene_setup.background = picture.transport.sky->horizon;
  }
}

void check_refinement(const OptionSet& options, PictureOptions& picture) {
  for (const char* option : {"--error", "--samples-max"}) {
    if (!picture.is_refined && options.is_given(option)) {
      throw core::UsageError(std::string(option) + " goes with --samples=auto");
    }
  }
  if (picture.is_refined && picture.refinement.error == 0) {
    picture.refinement.error = default_error(picture.transport.is_by_paths()).error;
  }
}

/// A sample of a refined picture covers half of the pixel's sides, since the error estimate detects differences between samples,
/// but not the blur that all of them share.
double pixel_share(const PictureOptions& picture) { return picture.is_refined ? 0.5 : 1; }

/// Returns the transport for bounds of radiance, for which any grid will do.
core::Transport light_of(const PictureOptions& picture) { return transport_of(picture.transport, {0, 0, 1}); }

}  // namespace

DefaultError default_error(bool is_by_paths) {
  return is_by_paths ? DefaultError{1.0 / 100, "1/100"} : DefaultError{1.0 / 255, "1/255"};
}

QualityChoice choice_of(Quality quality) {
  return quality == Quality::draft ? QualityChoice{4.0 / 255, 1.0 / 64} : QualityChoice{1.0 / 255, 1.0 / 255};
}

void take_scene(PictureOptions& picture, const std::string& scene) {
  picture.scene = scene;
  picture.stored.reset();
  if (is_database_path(scene)) {
    const DatabaseFile file(scene);
    picture.scene = file.origin().scene;
    picture.stored = StoredChoice{scene, file.digest()};
  }
}

void add_options(OptionSet options, PictureOptions& picture) {
  options.add_argument(
      "SCENE", [&picture](const std::string& text) { take_scene(picture, text); },
      "An NFF file, a pbrt-v4 scene, a mesh file (obj, ply, stl, gltf, glb, ...), a built-in scene such as teapot-12, "
      "rings-4-t1, tetra-9, or a database that dmpc build has written (.pages), with the options that it was built with");
  add_options(options, picture.scene_setup);
  add_view_options(options, picture);
  options.add_text(
      "--samples", picture.presents_meshes ? "1..32768|auto [1, of a mesh file auto]" : "1..32768|auto [1]",
      [&picture](const std::string& text) { take_samples(picture, text); },
      "Samples per pixel; auto: as many as --error requires");
  options.add_text(
      "--error", "E [1/255, by paths 1/100]",
      [&picture](const std::string& text) { picture.refinement.error = parse_share(text, "--error"); },
      "With --samples=auto: the estimated root mean square error of the linear picture at which the render stops");
  options.add_number("--samples-max", picture.refinement.samples_max, 2, 32768,
                     picture.presents_meshes ? "4096, of a mesh file 256" : "4096",
                     "With --samples=auto: the most samples per pixel");
  options.add_text(
      "--cutoff", "C [0]", [&picture](const std::string& text) { picture.cutoff = parse_share(text, "--cutoff", true); },
      "Do not trace rays that can contribute less than C to their sample; 0 is exact");
  options.add_choice<Quality>("--quality", picture.quality, {{"draft", Quality::draft}, {"good", Quality::good}},
                              picture.presents_meshes ? "one ray a pixel, of a mesh file --samples=auto" : "one ray a pixel",
                              "Set --samples=auto, --error and, except with paths, --cutoff for a quick preview, or for a good "
                              "picture. Options that are given take precedence");
  add_skip_option(options, picture);
  options.check_in_the_end([options, &picture] {
    apply_quality(options, picture);
    present_mesh(options, picture);
    picture.is_one_ray_unasked = !options.is_given("--samples") && !picture.is_refined;
    check_refinement(options, picture);
  });
}

void add_transport_options(OptionSet options, PictureOptions& picture) {
  add_options(options, picture.transport);
  options.check_in_the_end([options, &picture] { settle_transport(options, picture); });
}

void add_view_options(OptionSet options, PictureOptions& picture) {
  const std::optional<Resolution>& size = picture.resolution;
  const std::string usual = size ? std::to_string(size->width) + "x" + std::to_string(size->height) : "the scene's";
  options.add_text(
      "--resolution", "WxH [" + usual + "]", [&picture](const std::string& text) { picture.resolution = parse_resolution(text); },
      "Width and height of the picture in pixels");
  options.add_number("--depth", picture.depth, 1, 255, std::to_string(picture.depth),
                     "Maximum depth of reflections and refractions; 1 is the primary ray alone");
  options.add_choice<core::Convention>("--convention", picture.convention,
                                       {{"haines", core::Convention::haines}, {"paper", core::Convention::paper}},
                                       "Lights that get shadow rays: those that the surface faces, or all");
}

int depth_of(const PictureOptions& picture, const core::Scene& scene) {
  TransportOptions transport = picture.transport;
  if (!transport.is_by_paths() || !transport.are_bounces_unasked || !scene.bounces) {
    return picture.depth;
  }
  transport.bounces = *scene.bounces;
  return transport.depth();
}

core::FilmScale film_scale_of(const PictureOptions& options, const core::Scene& scene) {
  const std::uint32_t samples = options.is_refined ? options.refinement.samples_max : static_cast<std::uint32_t>(options.samples);
  return core::film_scale_for(scene, depth_of(options, scene), samples, light_of(options));
}

double radiance_bound(const PictureOptions& options, const core::Scene& scene) {
  // A ray from the eye corresponds to a reflected ray one hit earlier.
  return core::radiance_bound(scene, depth_of(options, scene) + 1, light_of(options));
}

core::RenderSettings render_settings(const PictureOptions& options, const core::Scene& scene, const core::Database& database) {
  const Resolution size = options.resolution.value_or(Resolution{scene.view.width, scene.view.height});
  const core::Camera camera(scene.view, database.header().frame, size.width, size.height, options.samples);
  const core::RenderSettings settings{.header = database.header(),
                                      .camera = camera,
                                      .shade = {.convention = options.convention,
                                                .depth_max = depth_of(options, scene),
                                                .clamp = static_cast<float>(options.transport.clamp),
                                                .cutoff = options.cutoff,
                                                .radiance_bound = core::radiance_bound(scene, depth_of(options, scene)),
                                                .pixel_share = database.records().textured > 0 ? pixel_share(options) : 0,
                                                .first_samples = static_cast<std::uint32_t>(options.samples),
                                                .film_scale = film_scale_of(options, scene),
                                                .transport = transport_of(options.transport, zenith_of(scene))},
                                      .refinement = options.refinement,
                                      .skips = options.skips};
  return core::seen_by(camera, settings, database);
}

Resolution parse_resolution(std::string_view text) {
  Resolution size;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    const auto pixels = std::int64_t{size.width} * size.height;
    if (height.ec == std::errc() && height.ptr == end && size.width >= 1 && size.height >= 1 && size.width <= 65536 &&
        size.height <= 65536 && pixels <= picture_pixels_max) {
      return size;
    }
  }
  throw core::UsageError("--resolution=" + std::string(text) +
                         ": expected WIDTHxHEIGHT such as 512x384, each 1 to 65536 and at most 268435456 pixels in all");
}

}  // namespace dmpc::apps
