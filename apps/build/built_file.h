// A scene's database with all that its file has beside.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/database/database_file.h"
#include "apps/frontend/system/opened_files.h"
#include "apps/frontend/system/output_file.h"
#include "apps/scene/database_options.h"
#include "apps/scene/picture_options.h"
#include "apps/scene/subject.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

struct BuildRequest {
  PictureOptions picture;
  DatabaseOptions database;
  std::filesystem::path output;
  bool for_any_camera = false;     ///< with the pad of an eye as far away as any
  std::vector<std::string> words;  ///< the options given, for whoever reads the file
  bool quiet = false;
};

struct BuiltFile {
  DatabaseOrigin origin;
  core::Scene scene;  ///< what is left of it
  Subject subject;

  /// As a whole or not at all. Throws core::InputError if that fails.
  void write(const std::filesystem::path& path, const OutputFile::Settings& settings) const;
};

/// Loads and builds. `check(files)` is called with the files of the scene before it is built. Throws as load_scene() and
/// build_subject() do.
BuiltFile build_file(const BuildRequest& build, const std::function<void(const OpenedFiles&)>& check);

}  // namespace dmpc::apps
