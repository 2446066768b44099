// Reads glTF 2.
#pragma once

#include <optional>
#include <string>

#include "apps/foreign/mesh/imported_file.h"
#include "apps/foreign/mesh/scene_files.h"
#include "apps/formats/animation_moment.h"
#include "core/scene/instances.h"

namespace dmpc::apps {

/// Meshes, materials, lights and cameras as the file has them. Nodes stand as they do at the moment of `animation`, if it is
/// given. `copies`: what will become of what stands in several places, by which memory is reckoned.
ImportedFile import_gltf(const std::string& path, SceneFiles& files,
                         const std::optional<AnimationMoment>& animation = std::nullopt, core::Copies copies = core::Copies::put);

}  // namespace dmpc::apps
