// Which settings `bench error` measures: every knob of a render that trades time for error, turned by itself about a base point,
// and some together.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/scene/transport_options.h"
#include "core/picture/surfaces/path_step.h"

namespace dmpc::apps {

/// The last two turn two knobs together. By paths there are samples, adaptive, and the three before those, which are paths'
/// alone.
enum class Knob : std::uint8_t {
  samples,
  adaptive,
  cutoff,
  depth,
  tessellation,
  arithmetic,
  quality,
  bounces,
  roulette,
  emitters,
  adaptive_and_cutoff,
  adaptive_and_depth
};

/// As the command line and the table call it; those of two knobs have spaces.
const char* name_of(Knob knob);

/// "samples,depth"; two knobs that are turned together, too, follow from both being there. Throws core::UsageError for anything
/// that is none, listing those that there are.
std::set<Knob> parse_knobs(const std::string& text);

/// All that the scene and its family allow, of pictures by paths or of others.
std::set<Knob> all_knobs(bool are_by_paths = false);
/// Throws core::UsageError, listing those that there are, for knobs that such pictures do not have.
void check_knobs(const std::set<Knob>& knobs, bool are_by_paths);

/// All knobs of one render.
struct Setting {
  int samples = 16;                                      ///< per pixel; if they are refined, in the first pass
  double error = 0;                                      ///< core::RefinementOptions::error; 0: the same samples in all pixels
  double cutoff = 0;                                     ///< core::ShadeOptions::cutoff
  int depth = 8;                                         ///< PictureOptions::depth
  int tessellation = 0;                                  ///< core::SceneName::tessellation
  std::optional<int> bounces = std::nullopt;             ///< by paths: TransportOptions::bounces, in place of depth and cutoff
  int roulette_from = core::roulette_from;               ///< by paths: core::Transport::roulette_from
  std::uint32_t emitters = TransportOptions().emitters;  ///< by paths: the same

  bool operator==(const Setting&) const = default;
  bool is_refined() const { return error > 0; }
  bool is_by_paths() const { return bounces.has_value(); }
};

/// A place on a knob's curve. Several knobs may share a setting: the base point.
struct Point {
  Knob knob;
  std::string text;  ///< the knob's position, without commas: "16", "1/255", "t4"
  Setting setting;
};

struct SweepOptions {
  std::set<Knob> knobs;
  std::vector<int> tessellations;  ///< positions of that knob beside exact quadrics, above 0
  bool is_quick = false;           ///< fewer positions of each knob
  double error_least = 0;          ///< no refined picture is asked for a smaller error than this
  std::uint32_t emitters = 0;      ///< that the base point aims at; 0: there is nothing to turn
};

/// By knob, from the cheapest position of each to the base point's or beyond. `base` is exact: neither refined nor cut off nor
/// tessellated, and no depth, and no bounces, are above its own.
std::vector<Point> sweep(const Setting& base, const SweepOptions& options);

/// Powers of 2 by which a built-in scene can be tessellated into different scenes of at most a million primitives; none for
/// scenes without spheres and cones, tessellated ones, and files.
std::vector<int> tessellations_of(const std::string& scene, bool is_quick);

}  // namespace dmpc::apps
