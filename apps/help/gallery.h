// Pictures of the built-in scenes, for who chooses one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/frontend/system/interrupt.h"
#include "apps/picture/image_file.h"

namespace dmpc::apps {

/// A scene as it looks.
struct ScenePicture {
  std::string name;
  Image image;
};

/// All of them side by side, in rows of six, each above its name. Requires pictures, all of one size.
Image contact_sheet(const std::vector<ScenePicture>& pictures);

/// Renders each of the scenes that `list scenes` names and that need no file, small, and writes SCENE.png of each and scenes.png,
/// their contact sheet, to the folder, which is made if there is none. Says how far it is where stderr is a terminal. What is
/// there is not written over: throws core::InputError, naming it, if a file has one of these names, before anything is rendered,
/// and Interrupted after a signal, with no file written unless all were rendered by then.
void write_gallery(const std::filesystem::path& folder, Interrupt& interrupt);

}  // namespace dmpc::apps
