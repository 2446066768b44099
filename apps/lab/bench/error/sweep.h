// Which settings `bench error` measures: every knob turned by itself about a base point, and some together.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/lab/bench/error/knob.h"
#include "apps/scene/transport_options.h"
#include "core/picture/path_step.h"

namespace dmpc::apps {

/// All knobs of one render.
struct Setting {
  int samples = 16;                                      ///< of every pixel; if they are refined, those of the first pass
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
