// The built-in scenes: the Standard Procedural Databases of E. Haines ("A Proposal for Standard Graphics Environments", IEEE CG&A
// 7(11), 1987, and the SPD package 3.14), by the SPD's own names.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"

namespace dmpc::core {

/// What `family-size[-tN]` says.
struct SceneName {
  std::string family;    ///< balls gears jacks lattice mount rings shells sombrero teapot tetra tree
  int size = 1;          ///< 1 to size_max of the family
  int tessellation = 0;  ///< 0: true spheres, cones and cylinders; N: triangles, 12 N^2 a sphere and 8 N a cone

  /// In full, with the size: `teapot-12`, `rings-4-t1`.
  std::string text() const;
};

/// Reads `family`, `family-size`, `family-tN` or `family-size-tN`; a size not given is the SPD's default (teapot 12). Nothing if
/// the text does not begin with a family's name, or goes on with a dot or a slash (balls-4.nff), so that it is a file's name.
/// Throws InputError with what is allowed if the rest makes no sense or the scene is too large (more than 16,777,216 primitives).
std::optional<SceneName> find_scene_name(std::string_view text);

/// Parses a text that must be a built-in name: throws InputError, listing the families, if it is none. `others`: names of
/// families that the caller has besides, which are listed, too.
SceneName parse_scene_name(std::string_view text, std::span<const std::string> others = {});

/// Throws InputError unless the family exists, and size and tessellation lie in its ranges.
void check_scene_name(const SceneName& name);

/// One scene of each family, of its default size, in alphabetical order.
std::vector<SceneName> default_scenes();

/// The families in alphabetical order with their default sizes and ranges, a line each, for help texts.
std::string describe_scene_families();

/// How many objects the scene has: spheres, cones, polygons and patches. By formula, without making it. Tessellation changes
/// nothing for gears, sombrero, teapot and tetra, and is always 2 for jacks. Requires a name that check_scene_name accepts.
std::uint64_t primitive_count(const SceneName& name);

/// Sends the scene to `sink` in the order of the SPD's files (`b`, `v`, `l`s, then objects, with an `f` wherever the SPD writes
/// one), every number rounded to 6 significant digits as its files are. Throws InputError as check_scene_name does.
void generate_scene(const SceneName& name, SceneSink& sink);

/// Generates it in the full precision of the generators: for measuring them.
void generate_unrounded_scene(const SceneName& name, SceneSink& sink);

/// The scene as generate_scene sends it; its name is name.text().
Scene built_in_scene(const SceneName& name);

}  // namespace dmpc::core
