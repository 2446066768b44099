#include "apps/scene/subject.h"

#include <iostream>
#include <utility>

#include "apps/line/number_text.h"
#include "apps/system/progress.h"
#include "core/scene/frame.h"

namespace dmpc::apps {

namespace {

core::Database build(core::Scene&& scene, core::BuildOptions options, const core::GridAxes& axes, bool shows_progress) {
  Progress progress(std::cerr, shows_progress && stderr_is_terminal(), "Building:", "primitives");
  options.axes = axes;
  options.progress = [&progress](std::uint64_t done, std::uint64_t total) { progress.update(done, total); };
  return core::build_database(std::move(scene), options);
}

}  // namespace

Subject build_subject(core::Scene scene, const PictureOptions& picture, const DatabaseOptions& options, bool shows_progress) {
  const core::GridAxes axes = options.axes == AxesChoice::screen ? core::screen_axes(scene.view) : core::world_axes;
  core::Database database = build(std::move(scene), options.build, axes, shows_progress);
  const core::RenderSettings settings = render_settings(picture, scene, database);
  if (database.dropped() > 0) {
    std::cerr << "dmpc: " << dropped_text(database.dropped()) << '\n';
  }
  if (database.duplicates() > 0) {
    std::cerr << "dmpc: " << duplicates_text(database.duplicates()) << '\n';
  }
  return {std::move(database), settings};
}

std::string dropped_text(std::uint64_t count) {
  return count == 0 ? "" : counted(count, "degenerate primitive") + (count == 1 ? " was" : " were") + " left out";
}

std::string duplicates_text(std::uint64_t count) {
  return count == 0 ? "" : counted(count, "triangle") + (count == 1 ? " was" : " were") + " left out: there twice";
}

}  // namespace dmpc::apps
