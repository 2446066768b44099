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
  const core::RoundingLoss loss = core::find_rounding_loss(database, settings.camera);
  if (!loss.is_none()) {
    std::cerr << "dmpc: " << loss_text(loss) << '\n';
  }
  if (database.duplicates() > 0) {
    std::cerr << "dmpc: " << duplicates_text(database.duplicates()) << '\n';
  }
  return {std::move(database), settings, loss};
}

std::string dropped_text(std::uint64_t count) {
  return count == 0 ? "" : counted(count, "degenerate primitive") + (count == 1 ? " was" : " were") + " left out";
}

std::string loss_text(const core::RoundingLoss& loss) {
  std::string text;
  if (loss.collapsed > 0) {
    text = counted(loss.collapsed, "primitive") + (loss.collapsed == 1 ? " is" : " are") +
           " left out, too small beside the scene " + "to have a size in its coordinates: up to " +
           rounded(loss.collapsed_pixels) + " pixels across";
  }
  if (loss.moved > 0) {
    text += (text.empty() ? "" : "; ") + counted(loss.moved, "primitive") + " may be off by up to " + rounded(loss.moved_pixels) +
            " pixels, as coordinates are rounded beside something so large";
  }
  return text.empty() ? ""
                      : text + ": bring the scene's parts nearer to each other or nearer in size, or view it from farther away";
}

std::string duplicates_text(std::uint64_t count) {
  return count == 0 ? "" : counted(count, "triangle") + (count == 1 ? " was" : " were") + " left out: there twice";
}

}  // namespace dmpc::apps
