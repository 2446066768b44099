// A scene's database as a file in a folder, and command lines with it.
#pragma once

#include <string>
#include <vector>

#include "apps/build/command.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/program/commands.h"
#include "apps/run/render_options.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "tests/support/film_of.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests {

using Words = std::vector<std::string>;

/// As `dmpc build` does with the words behind it; returns the file.
inline std::string build_database_file(const TemporaryFolder& folder, Words words, const std::string& name = "scene.pages") {
  words.insert(words.begin(), "build");
  words.push_back("-o" + (folder / name).string());
  const auto build = apps::parse_command_line(apps::declare_renderer, words).options<apps::BuildRequest>();
  apps::build_file(build, [](const apps::OpenedFiles&) {}).write(build.output, {});
  return build.output.string();
}

inline apps::RenderOptions render_line(Words words) {
  words.insert(words.begin(), "render");
  words.emplace_back("-onone.png");
  return apps::parse_command_line(apps::declare_renderer, words).options<apps::RenderOptions>();
}

/// The subject of such a line, without messages.
inline apps::Subject subject_of_line(const Words& words) {
  const apps::RenderOptions options = render_line(words);
  return apps::build_subject_quietly(apps::load_scene(options.picture, apps::LoadNotes::silent), options.picture,
                                     options.database);
}

inline std::uint64_t film_hash(const apps::Subject& subject) {
  return film_of(subject.database, subject.settings.with_every_ray_traced()).hash();
}

}  // namespace dmpc::tests
