// The options that decide a database, as text: a stored one stands for a scene if all are those that it was built with.
#pragma once

#include <string>

#include "apps/database/database_file.h"
#include "apps/scene/database_options.h"
#include "apps/scene/picture_options.h"

namespace dmpc::apps {

/// `built`: after decisions that depend on the scene.
DatabaseFacts database_facts(const PictureOptions& picture, const core::BuildOptions& built);

/// The first fact that `asked` has otherwise than `stored`, as a sentence; empty if there is none.
std::string difference_of(const DatabaseFacts& asked, const DatabaseFacts& stored);

/// The options of `built`, as words of a command line.
std::vector<std::string> words_of(const core::BuildOptions& built);

/// Whether it is an option of those.
bool is_of_building(const std::string& word);

/// SCENE stands for the options that a stored database was built with; --system decides those of building.
CommandLine::Standing standing_of_scene();

/// The database of a scene that is stored, which picture.stored names. Throws core::InputError as DatabaseFile does, and
/// core::UsageError if it was built with other options, for eyes nearer than this view's, or, for a refined picture, without
/// copies of base meshes.
core::Database stored_database(const core::Scene& scene, const PictureOptions& picture, const core::BuildOptions& built);

}  // namespace dmpc::apps
