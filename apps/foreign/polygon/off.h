// OFF, as Geomview describes it (The Geometry Center), in text.
#pragma once

#include <string>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"

namespace dmpc::apps {

/// `[ST][C][N]OFF`, or no such word; the counts of vertices and faces; a vertex a line: x y z, a normal with N, 3 or 4 numbers of
/// a colour with C or, as others than Geomview write them, without; a face a line: a count, as many vertices, and perhaps 3 or 4
/// numbers of a colour. Colours are of 255 where any is beyond 1. `#` begins a remark. Refuses files in binary, of four
/// coordinates (4OFF) and of other dimensions (nOFF), by name. Throws core::InputError, with the line.
PlacedFile read_off(const std::string& path, SceneFiles& files);

}  // namespace dmpc::apps
