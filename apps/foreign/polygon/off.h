// OFF in text, as Geomview specifies it (The Geometry Center).
#pragma once

#include <string>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"

namespace dmpc::apps {

/// The format: an optional `[ST][C][N]OFF`; the numbers of vertices and faces; one vertex per line: x y z, a normal with N, and
/// 3 or 4 colour components with C or, as programs other than Geomview write them, without C; one face per line: a count, that
/// number of vertices, and optionally 3 or 4 colour components. Colours range to 255 if any component exceeds 1. `#` begins a
/// comment. Binary files, four coordinates (4OFF) and other dimensions (nOFF) are refused with a specific message. Throws
/// core::InputError, with the line.
PlacedFile read_off(const std::string& path, SceneFiles& files);

}  // namespace dmpc::apps
