// How light gets about, on the command line.
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

/// What --sky says: one colour, or two between which it changes upwards; or a picture.
struct SkyChoice {
  core::Vec3d horizon;
  std::optional<core::Vec3d> zenith;
  std::string file = {};  ///< picture file; if there is one, the colours are black

  bool is_picture() const { return !file.empty(); }
};

/// Below which a mesh file is shown that nobody has lit: a studio, warm and bright above, dim and a little blue around and below,
/// so that what is round looks round.
SkyChoice mesh_sky();

struct TransportOptions {
  core::TransportKind kind = core::TransportKind::whitted;
  int bounces = 8;                  ///< by paths: 0 to 254
  bool are_bounces_unasked = true;  ///< then those that the scene's file says are taken
  std::optional<SkyChoice> sky;     ///< by paths; its horizon is the scene's background, too
  /// Path tracing: the number of emitters, the most powerful ones, that are light-sampled; 0 to emitters_limit.
  std::uint32_t emitters = 1024;
  std::optional<double> light_radius;  ///< by paths: point lights are spheres of this radius, in the scene's units; above 0

  bool is_by_paths() const { return kind == core::TransportKind::paths; }
  /// Hits at this depth are the last: core::ShadeOptions::depth_max. By paths.
  int depth() const { return bounces + 1; }
  /// core::BuildOptions::emitters_max.
  std::uint32_t emitters_max() const { return is_by_paths() ? emitters : 0; }
};
inline constexpr std::uint32_t emitters_limit = 1'000'000;

/// Declares --transport, --bounces, --sky, --emitters and --light-radius.
void add_options(OptionSet options, TransportOptions& transport);
/// What else goes with them. Throws core::UsageError that says what to do instead.
void check(const OptionSet& options, const TransportOptions& transport);

/// "0.5,0.5,0.5" or "1,1,1/0,0,1"; what has a letter that no number has is a file's path. Throws core::UsageError for anything
/// else, and for colours below 0.
SkyChoice parse_sky(const std::string& text);
/// What parse_sky() reads as these very numbers.
std::string text_of(const SkyChoice& sky);
/// "whitted" or "paths, 8 bounces, sky 1,1,1": as people read it, and as files have it.
std::string text_of(const TransportOptions& transport);
/// "whitted" or "paths".
const char* name_of(core::TransportKind kind);

/// As the nodes have it. `zenith`: of unit length, in the world.
core::Transport transport_of(const TransportOptions& options, const core::Vec3d& zenith);

/// A database's emitters that are light-sampled, those that are not, and those that coplanar surfaces may hide (core/database).
struct EmitterCounts {
  std::uint64_t emitters = 0, others = 0, covered = 0;
};
/// A note about emitters that are not light-sampled; empty if there are none, or there is no light sampling.
std::string emitters_text(const EmitterCounts& counts, const TransportOptions& options);

/// A sentence about materials that give more light than they get, of which a picture by paths shows more than there is; empty if
/// there is none, or nothing scatters.
std::string gain_text(const std::vector<core::Material>& materials, const TransportOptions& options);

}  // namespace dmpc::apps
