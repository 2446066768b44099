// The formats of polygons that readers of our own read.
#pragma once

#include <optional>
#include <string>

#include "apps/foreign/mesh/polygon_file.h"
#include "apps/foreign/mesh/scene_files.h"

namespace dmpc::apps {

/// By the file's ending; nothing if no reader of ours knows it. Throws core::InputError, with the line or byte, for what the file
/// may not say, std::bad_alloc if memory ends.
std::optional<PolygonFile> read_polygon_file(const std::string& path, SceneFiles& files);

}  // namespace dmpc::apps
