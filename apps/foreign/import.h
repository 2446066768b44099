// Reads a file by Assimp, or glTF 2 by a reader of our own.
#pragma once

#include <optional>
#include <string>

#include "apps/foreign/mesh/imported_file.h"
#include "apps/foreign/mesh/scene_files.h"
#include "apps/formats/animation_moment.h"
#include "core/scene/instances.h"

namespace Assimp {
class Importer;
}

namespace dmpc::apps {

/// Makes the library ready, after which it opens nothing but through SceneFiles.
void prepare_import();

/// Leaves only readers of files with this ending, in small letters: where none of these takes a file, Assimp else asks all of
/// them whether they know its first bytes.
void keep_readers_of(const std::string& ending, Assimp::Importer& importer);

/// Reads meshes, materials, lights and cameras as the file has them, by a reader for files that end as it does. Throws
/// core::InputError with Assimp's own words if it cannot read the file, or if there is no mesh in it, std::bad_alloc if memory
/// ends. Nodes stand as they do at the moment of `animation`, if it is given: of glTF 2 alone, else core::InputError. `copies`:
/// what will become of what stands in several places, by which memory is reckoned.
ImportedFile import_file(const std::string& path, SceneFiles& files,
                         const std::optional<AnimationMoment>& animation = std::nullopt, core::Copies copies = core::Copies::put);

}  // namespace dmpc::apps
