#include "apps/lab/study/sweep/kept_databases.h"

#include <algorithm>
#include <cctype>
#include <system_error>
#include <utility>

#include "apps/build/built_file.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/digest.h"
#include "apps/scene/database_facts.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

namespace fs = std::filesystem;

/// What of a scene's name a file's can have.
std::string plain_name(const std::string& scene) {
  std::string name = fs::path(scene).filename().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char letter) { return std::isalnum(letter) == 0 && letter != '-'; }, '_');
  return name.substr(0, 40);
}

}  // namespace

KeptDatabases::KeptDatabases(const SweepSettings& settings, const OpenedFiles& scene, std::function<void(const std::string&)> say)
    : folder_(settings.kept.value()),
      bytes_min_(settings.kept_database_bytes_min),
      source_(source_of(scene)),
      say_(std::move(say)) {}

fs::path KeptDatabases::file_of(const SweepRun& run) const {
  const RenderOptions& options = run.options;
  Digest digest;
  digest.add(std::string_view(options.picture.scene));
  for (const auto& [name, value] : database_facts(options.picture, options.database.build)) {
    digest.add(std::string_view(value));
  }
  digest.add(static_cast<std::uint64_t>(options.database.instances) << 1U | (options.picture.is_refined ? 1U : 0U));
  digest.add(std::string_view(options.database.why_copied));
  if (options.picture.scene_setup.camera) {  // the database is that of its distance
    digest.add(std::string_view(text_of(*options.picture.scene_setup.camera)));
  }
  return folder_ / (plain_name(options.picture.scene) + "-" + hash_text(digest.value()) + ".pages");
}

bool KeptDatabases::is_current(const fs::path& file) const {
  std::error_code none;
  if (!fs::exists(fs::symlink_status(file, none))) {
    return false;
  }
  try {
    if (DatabaseFile(file).origin().source == source_) {
      return true;
    }
    say_(file.string() + ": the scene has changed since; it is built again");
  } catch (const core::InputError& error) {
    say_(std::string(error.what()) + ": so it is");
  }
  fs::remove(file, none);
  return false;
}

void KeptDatabases::provide(const SweepRun& run) {
  if (run.options.picture.stored || run.options.frames.animation) {
    return;
  }
  const fs::path file = file_of(run);
  const auto [place, is_new] = is_there_.try_emplace(file, false);
  if (!is_new) {
    return;
  }
  place->second = is_current(file);
  if (!place->second) {
    const BuiltFile built =
        build_file({.picture = run.options.picture, .database = run.options.database, .output = file, .quiet = true},
                   [](const OpenedFiles&) {});
    if (built.subject.database.bytes().size() >= bytes_min_) {
      built.write(file, {.replaces = Replaces::name, .option = "--runs"});
      place->second = true;
    }
  }
}

std::vector<std::string> KeptDatabases::words_for(const SweepRun& run) const {
  std::vector<std::string> words = run.words;
  const auto found = run.options.picture.stored ? is_there_.end() : is_there_.find(file_of(run));
  if (found != is_there_.end() && found->second) {
    words.at(1) = found->first.string();
  }
  return words;
}

}  // namespace dmpc::apps
