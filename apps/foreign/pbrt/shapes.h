// Shapes of a pbrt scene, in their own coordinates.
#pragma once

#include <optional>
#include <string>

#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"
#include "apps/foreign/pbrt/parameters.h"

namespace dmpc::apps::pbrt {

/// Converts a Shape statement; returns nothing, and counts it, for a kind that is not shown (curves). Throws core::InputError,
/// with the position, for invalid indices, mismatched counts, numbers out of range, kinds that pbrt-v4 does not have, and
/// missing or unreadable files. With `has_pictures` a texture may need texture coordinates.
std::optional<PlacedShape> shape_of(const std::string& kind, const Parameters& parameters, const Tokens& tokens,
                                    SceneFiles& files, Notes& notes, bool has_pictures);

}  // namespace dmpc::apps::pbrt
