// A scene by its name, built for a picture of one's own size.
#pragma once

#include <string>

#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"

namespace dmpc::tests {

inline apps::Subject small_subject(const std::string& scene, const apps::Resolution& resolution) {
  apps::PictureOptions picture;
  picture.scene = scene;
  picture.resolution = resolution;
  return apps::build_subject(apps::load_scene(picture), picture);
}

}  // namespace dmpc::tests
