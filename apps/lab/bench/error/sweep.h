// The settings that `bench error` measures: every knob of a render that trades time for error, varied alone about a base point.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/scene/transport_options.h"
#include "core/picture/surfaces/path_step.h"

namespace dmpc::apps {

/// For paths there are samples, adaptive, and the last three, which only paths have.
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
  emitters
};

/// Returns the name on the command line and in the table.
const char* name_of(Knob knob);

/// Parses "samples,depth". Throws core::UsageError, which lists the known knobs, for anything else.
std::set<Knob> parse_knobs(const std::string& text);

/// Returns all knobs that the scene and its family allow, for pictures by paths or others.
std::set<Knob> all_knobs(bool are_by_paths = false);
/// Throws core::UsageError, which lists the known knobs, for knobs that such pictures do not have.
void check_knobs(const std::set<Knob>& knobs, bool are_by_paths);

struct Setting {
  int samples = 16;                                      ///< per pixel; with refinement, in the first pass
  double error = 0;                                      ///< core::RefinementOptions::error; 0: the same samples in all pixels
  double cutoff = 0;                                     ///< core::ShadeOptions::cutoff
  int depth = 8;                                         ///< PictureOptions::depth
  int tessellation = 0;                                  ///< core::SceneName::tessellation
  std::optional<int> bounces = std::nullopt;             ///< paths: TransportOptions::bounces, in place of depth and cutoff
  int roulette_from = core::roulette_from;               ///< paths: core::Transport::roulette_from
  std::uint32_t emitters = TransportOptions().emitters;  ///< paths: TransportOptions::emitters

  bool operator==(const Setting&) const = default;
  bool is_refined() const { return error > 0; }
  bool is_by_paths() const { return bounces.has_value(); }
};

/// A point on a knob's curve. Several knobs may share a setting: the base point.
struct Point {
  Knob knob;
  std::string text;  ///< the knob's position, without commas: "16", "1/255", "t4"
  Setting setting;
};

struct SweepOptions {
  std::set<Knob> knobs;
  std::vector<int> tessellations;  ///< positions of that knob in addition to exact quadrics, above 0
  bool is_quick = false;           ///< fewer positions of each knob, and of adaptive the smallest
  double error_least = 0;          ///< the smallest error requested of a refined picture
  std::uint32_t emitters = 0;      ///< sampled by the base point; 0: there is nothing to vary
};

/// Returns the points by knob, from the cheapest position of each to the base point's or beyond. `base` is exact: neither refined
/// nor cut off nor tessellated, and no point has a larger depth or more bounces.
std::vector<Point> sweep(const Setting& base, const SweepOptions& options);

/// Returns powers of 2 by which a built-in scene can be tessellated into different scenes of at most a million primitives; none
/// for scenes without spheres and cones, tessellated ones, and files.
std::vector<int> tessellations_of(const std::string& scene, bool is_quick);

}  // namespace dmpc::apps
