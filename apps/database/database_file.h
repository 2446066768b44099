// A database as a file, beside the scene without its objects, and the words of the command line that made it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include "apps/database/section_file.h"
#include "apps/database/stored_choice.h"
#include "apps/frontend/system/opened_files.h"
#include "core/database/database.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Options that decide a database, each with its value as text; "no" if it is not given (apps/scene/database_facts.h).
using DatabaseFacts = std::vector<std::pair<std::string, std::string>>;

/// What a database was built from.
struct DatabaseOrigin {
  std::string scene;               ///< SCENE, as given
  std::vector<std::string> words;  ///< further options as given, and those of building as decided: "--up=z"
  DatabaseFacts facts;
  std::uint64_t source = 0;  ///< digest of the files that the scene was read from
};

/// A digest of the files' bytes; 0 if there are none.
std::uint64_t source_of(const OpenedFiles& files);

/// Whether SCENE is the path of such a file: it ends in .pages.
bool is_database_path(const std::string& scene);

/// `scene`: what is left of it, with Scene::stored. `output` reports errors.
void write_database(const DatabaseOrigin& origin, const core::Scene& scene, const core::Database& database, std::ostream& output);

/// An open file. Throws core::InputError as SectionFile does.
class DatabaseFile {
 public:
  explicit DatabaseFile(const std::filesystem::path& path);
  /// Refuses another file than was chosen.
  explicit DatabaseFile(const StoredChoice& chosen);

  /// Identifies the contents of the file.
  std::uint64_t digest() const { return file_.digest(); }
  DatabaseOrigin origin() const;
  core::Scene scene() const;
  core::Database database() const;
  [[noreturn]] void refuse(const std::string& what) const { file_.refuse(what); }

 private:
  SectionFile file_;
};

}  // namespace dmpc::apps
