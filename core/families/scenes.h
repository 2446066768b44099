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

/// A parsed name `family-size[-tN]`.
struct SceneName {
  std::string family;    ///< balls gears jacks lattice mount rings shells sombrero teapot tetra tree
  int size = 1;          ///< 1 to size_max of the family
  int tessellation = 0;  ///< 0: true spheres, cones and cylinders; N: triangles, 12 N^2 per sphere and 8 N per cone

  /// The full name with the size: `teapot-12`, `rings-4-t1`.
  std::string text() const;
};

/// Parses `family`, `family-size`, `family-tN` or `family-size-tN`; the default size is the SPD's (teapot 12). Returns nothing
/// for a file name: a text that does not begin with a family's name, or continues with a dot or a slash (balls-4.nff). Throws
/// InputError with what is allowed if the rest is invalid or the scene is too large (more than 16,777,216 primitives).
std::optional<SceneName> find_scene_name(std::string_view text);

/// Parses a text that must be a built-in name: otherwise throws InputError that lists the families, and the names in `others`,
/// further families of the caller.
SceneName parse_scene_name(std::string_view text, std::span<const std::string> others = {});

/// Throws InputError unless the family exists and size and tessellation are in its ranges.
void check_scene_name(const SceneName& name);

/// One scene of each family at its default size, in alphabetical order.
std::vector<SceneName> default_scenes();

/// One line for each family, alphabetical, with its default size and ranges, for help texts.
std::string describe_scene_families();

/// The number of objects of the scene (spheres, cones, polygons and patches), by formula, without generating it. Tessellation
/// does not affect gears, sombrero, teapot and tetra, and is always 2 for jacks. Requires a name that check_scene_name accepts.
std::uint64_t primitive_count(const SceneName& name);

/// Sends the scene to `sink` in the order of the SPD's files (`b`, `v`, `l`s, then objects, with an `f` wherever the SPD writes
/// one). Every number is rounded to 6 significant digits, as in those files. Throws InputError as check_scene_name does.
void generate_scene(const SceneName& name, SceneSink& sink);

/// Generates the scene in the full precision of the generators, to measure them.
void generate_unrounded_scene(const SceneName& name, SceneSink& sink);

/// The scene that generate_scene sends; its name is name.text().
Scene built_in_scene(const SceneName& name);

}  // namespace dmpc::core
