// The options that determine a picture: the scene and its view. Shared by `render` and `check`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "apps/database/stored_choice.h"
#include "apps/formats/resolution.h"
#include "apps/frontend/line/command_line.h"
#include "apps/scene/scene_setup.h"
#include "apps/scene/transport_options.h"
#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "core/picture/shade.h"
#include "core/scene/scene.h"
#include "core/trace/skips.h"

namespace dmpc::apps {

/// The samples of the first pass of a refined picture with a transport other than paths.
inline constexpr int refined_samples = core::first_refined_samples(core::ErrorKind::edges);

/// Presets of the number of samples and, except with path tracing, of the cutoff. On average draft is within 5 of 255 steps of
/// the converged picture, good within 2.
enum class Quality : std::uint8_t { draft, good };

struct QualityChoice {
  double error = 0;   ///< core::RefinementOptions::error
  double cutoff = 0;  ///< core::ShadeOptions::cutoff
};
/// Returns the settings of a quality, unless options override them. The errors allow for an estimate that is a fifth too low. The
/// cutoffs are the largest ones whose own error on the SPD's scenes is below a quarter of an 8-bit step (good) or one such
/// step (draft); `bench error` shows their cost and effect.
QualityChoice choice_of(Quality quality);

/// The default target error of refinement, in displayed values: one 8-bit step; with path tracing 2.5 steps, about where other
/// path tracers stop. There errors decrease little faster than the root of the number of samples, so where surfaces see the sky
/// between others one step takes a thousand samples per pixel, but a hundredth takes a sixth of them.
struct DefaultError {
  double error;
  const char* text;
};
DefaultError default_error(bool is_by_paths);

/// A skip that is not the picture's, beside core::all_skips.
inline constexpr struct {
  const char *name, *what;
} equal_frames{
    "equal-frames",
    "a frame that equals the one before it is a copy of its picture, unless heat maps are asked for (render --frames)"};

struct PictureOptions {
  std::string scene;                     ///< an NFF file, a mesh file or a built-in name
  std::optional<StoredChoice> stored;    ///< in place of the scene, of which it was built
  std::optional<Resolution> resolution;  ///< the view's own if not given
  int samples = 1;                       ///< per pixel, 1 to 32768 (see core/picture/film/film.h); if refined, in the first pass
  bool is_refined = false;               ///< --samples=auto
  bool presents_meshes = false;          ///< selects the defaults of mesh files described at add_options() below
  bool is_refined_unasked = false;       ///< refined to the default error because of presents_meshes
  bool is_by_paths_unasked = false;      ///< path tracing because of presents_meshes
  bool is_one_path_unasked = false;      ///< path tracing without a given number of samples
  bool is_one_ray_unasked = false;       ///< one ray a pixel because neither samples nor a quality are given
  core::RefinementOptions refinement;    ///< its error is 0 unless the picture is refined
  int depth = 5;  ///< hits of this depth cast shadow rays only; 1 to 255; with path tracing the transport's
  core::Convention convention = core::Convention::haines;
  double cutoff = 0;               ///< core::ShadeOptions::cutoff
  std::optional<Quality> quality;  ///< --quality, already applied to the fields above
  core::Skips skips;               ///< the enabled skips (core/trace/skips.h)
  bool skips_equal_frames = true;  ///< of frames: one that equals the frame before it is not rendered
  SceneSetup scene_setup;          ///< changes to the scene's own view and lights
  TransportOptions transport;
};

/// Returns the depth of the picture. With path tracing it is that of the scene's file unless an option sets the bounces.
int depth_of(const PictureOptions& picture, const core::Scene& scene);

/// Sets the scene, or the database in place of it. Throws as DatabaseFile.
void take_scene(PictureOptions& picture, const std::string& scene);

/// Declares all options. The current value of presents_meshes determines some help texts and the defaults of mesh files: if no
/// option sets the lighting or the transport, path tracing under mesh_sky() or the requested sky, else Whitted's transport. Both
/// are refined to an error unless samples or a quality are given; options of rendering quality do not change the light.
void add_options(OptionSet options, PictureOptions& picture);
/// Declares the options of light transport, for commands that support it. Call it after the others.
void add_transport_options(OptionSet options, PictureOptions& picture);
/// Declares --resolution, --depth and --convention, which neither choose the scene nor trade error for time.
void add_view_options(OptionSet options, PictureOptions& picture);

/// Returns the factor by which the film scales radiance.
core::FilmScale film_scale_of(const PictureOptions& options, const core::Scene& scene);

/// Returns an upper bound on the radiance of any sample, in any channel: core::radiance_bound().
double radiance_bound(const PictureOptions& options, const core::Scene& scene);

/// Returns what the nodes need besides the records.
core::RenderSettings render_settings(const PictureOptions& options, const core::Scene& scene, const core::Database& database);

/// Parses "512x384"; each side 1 to 65536, at most 2^28 pixels. Throws core::UsageError for anything else.
Resolution parse_resolution(std::string_view text);

}  // namespace dmpc::apps
