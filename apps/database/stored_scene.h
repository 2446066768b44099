// A scene without its objects and texels, which its database has, as bytes and back.
#pragma once

#include <string>
#include <string_view>

#include "core/scene/scene.h"

namespace dmpc::apps {

/// What is left of a scene that has become a database, with Scene::stored.
std::string packed_scene(const core::Scene& scene);

/// Throws core::InputError for anything that packed_scene() does not make: a number out of its range, an index of nothing.
core::Scene unpacked_scene(std::string_view bytes);

}  // namespace dmpc::apps
