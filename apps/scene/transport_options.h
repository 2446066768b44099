// Options of light transport.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "core/picture/surfaces/transport.h"
#include "core/record/record.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// The operand of --sky: one colour, a vertical gradient between two, or a picture.
struct SkyChoice {
  core::Vec3d horizon;
  std::optional<core::Vec3d> zenith;
  std::string file = {};  ///< picture file; if there is one, the colours are black

  bool is_picture() const { return !file.empty(); }
};

/// Returns the default sky of a mesh file: a studio, warm and bright above, dim and slightly blue around and below, so that round
/// shapes look round.
SkyChoice mesh_sky();

struct TransportOptions {
  core::TransportKind kind = core::TransportKind::whitted;
  int bounces = 8;                  ///< with path tracing: 0 to 254
  bool are_bounces_unasked = true;  ///< then the bounces of the scene's file are used
  std::optional<SkyChoice> sky;     ///< with path tracing; its horizon is also the scene's background
  /// Path tracing: the number of emitters, the most powerful ones, that are light-sampled; 0 to emitters_limit.
  std::uint32_t emitters = 1024;
  double clamp = 0;                    ///< with path tracing: core::ShadeOptions::clamp
  std::optional<double> light_radius;  ///< with path tracing, point lights are spheres of this radius, in scene units; above 0

  bool is_by_paths() const { return kind == core::TransportKind::paths; }
  /// Returns the last depth with hits, with path tracing: core::ShadeOptions::depth_max.
  int depth() const { return bounces + 1; }
  /// core::BuildOptions::emitters_max.
  std::uint32_t emitters_max() const { return is_by_paths() ? emitters : 0; }
};
inline constexpr std::uint32_t emitters_limit = 1'000'000;

/// Declares --transport, --bounces, --sky, --emitters, --light-radius and --clamp.
void add_options(OptionSet options, TransportOptions& transport);
/// Checks their combinations. Throws core::UsageError with advice.
void check(const OptionSet& options, const TransportOptions& transport);

/// Parses "0.5,0.5,0.5" or "1,1,1/0,0,1"; text with a letter that no number has is a file's path. Throws core::UsageError for
/// anything else, and for negative colours.
SkyChoice parse_sky(const std::string& text);
/// Returns text that parse_sky() reads as exactly these numbers.
std::string text_of(const SkyChoice& sky);
/// Returns "whitted" or "paths, 8 bounces, sky 1,1,1", for people and for files.
std::string text_of(const TransportOptions& transport);
/// Returns "whitted" or "paths".
const char* name_of(core::TransportKind kind);

/// Converts to the nodes' representation. `zenith` has unit length, in the world.
core::Transport transport_of(const TransportOptions& options, const core::Vec3d& zenith);

/// Numbers of emitters: light-sampled, not light-sampled, and possibly hidden by coplanar surfaces (core/database).
struct EmitterCounts {
  std::uint64_t emitters = 0, others = 0, covered = 0;
};
/// A note about emitters that are not light-sampled; empty if there are none, or there is no light sampling.
std::string emitters_text(const EmitterCounts& counts, const TransportOptions& options);

/// Returns a sentence about materials that amplify light, so that path-traced pictures are too bright; empty if there are none,
/// or nothing scatters.
std::string gain_text(const std::vector<core::Material>& materials, const TransportOptions& options);

}  // namespace dmpc::apps
