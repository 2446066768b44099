// What decides a picture on the command line: the scene and how it is looked at. Shared by `render` and `check`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

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

/// In the first pass of a refined picture, where no path takes chances.
inline constexpr int refined_samples = core::first_refined_samples(core::ErrorKind::edges);

/// Names for choices of samples and, but by paths, cutoff, to be had without knowing them: draft shows within 5 of 255 steps, on
/// average, what the converged picture would, standard within 2.
enum class Quality : std::uint8_t { draft, standard };

struct QualityChoice {
  double error = 0;   ///< core::RefinementOptions::error
  double cutoff = 0;  ///< core::ShadeOptions::cutoff
};
/// The settings of a quality, unless options override them. The errors allow for an estimate that is too low by a fifth.
/// The cutoffs are the largest whose own error is below a quarter of an 8-bit step (standard) and one such step (draft) on the
/// SPD's scenes; `bench error` shows what all that costs and does.
QualityChoice choice_of(Quality quality);

/// To which samples are refined where no option says so, and as it is shown. An 8-bit step; by paths two and a half, about as
/// much as other path tracers stop at: there errors fall with little more than the root of the samples, so where surfaces see the
/// sky between others a step takes a thousand samples a pixel, a hundredth a sixth of them.
struct DefaultError {
  double error;
  const char* text;
};
DefaultError default_error(bool is_by_paths);

struct PictureOptions {
  std::string scene;                     ///< an NFF file, a mesh file or a built-in name
  std::optional<Resolution> resolution;  ///< the view's own if not given
  int samples = 1;                   ///< per pixel, 1 to 32768 (core/picture/film/film.h says why); if refined, in the first pass
  bool is_refined = false;           ///< --samples=auto
  bool presents_meshes = false;      ///< what a mesh file shows unless asked for follows below in add_options()
  bool is_refined_unasked = false;   ///< for that reason, to the default error
  bool is_by_paths_unasked = false;  ///< for that reason
  bool is_one_path_unasked = false;  ///< by paths, and nobody has said how many samples
  core::RefinementOptions refinement;  ///< its error is 0 unless the picture is refined
  int depth = 5;                       ///< hits of this depth cast shadow rays only; 1 to 255; by paths the transport's
  core::Convention convention = core::Convention::haines;
  double cutoff = 0;               ///< core::ShadeOptions::cutoff
  std::optional<Quality> quality;  ///< --quality, already in the fields above
  core::Skips skips;               ///< what is left out on the way to it
  SceneSetup scene_setup;          ///< how the scene is seen and lit, if not as it says itself
  TransportOptions transport;
};

/// The picture's depth, by paths that of the scene's file where nobody has asked for bounces.
int depth_of(const PictureOptions& picture, const core::Scene& scene);

/// Declares them. What presents_meshes is now decides of what they say, and of what a mesh file shows by default. Where no option
/// says how it is lit or by what transport: paths under mesh_sky(), or the sky that is asked for; else Whitted's transport. Both
/// to an error unless samples or a quality are asked for, which, as all that says how well it is rendered, change no light.
void add_options(OptionSet options, PictureOptions& picture);
/// Declares those of how light gets about, for commands that know of it. Behind the others.
void add_transport_options(OptionSet options, PictureOptions& picture);
/// Declares --no-skip.
void add_skip_option(OptionSet options, core::Skips& skips);
/// Declares those that neither are the scene nor trade error for time: --resolution, --depth and --convention.
void add_view_options(OptionSet options, PictureOptions& picture);

/// What the scene's film multiplies light by.
core::FilmScale film_scale_of(const PictureOptions& options, const core::Scene& scene);

/// No sample finds more light than this, in any channel: core::radiance_bound().
double radiance_bound(const PictureOptions& options, const core::Scene& scene);

/// What the nodes need beside the records.
core::RenderSettings render_settings(const PictureOptions& options, const core::Scene& scene, const core::Database& database);

/// "512x384"; each 1 to 65536, at most 2^28 pixels. Throws core::UsageError for anything else.
Resolution parse_resolution(std::string_view text);

}  // namespace dmpc::apps
