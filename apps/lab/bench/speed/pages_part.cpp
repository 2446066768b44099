#include <algorithm>
#include <iostream>
#include <string>
#include <variant>

#include "apps/edge/system/progress.h"
#include "apps/lab/bench/speed/parts.h"
#include "apps/lab/study/engine/timed_render.h"
#include "apps/lab/study/paper/data.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

const PaperScene& row_of(const std::string& scene) {
  const auto found =
      std::find_if(paper_scenes.begin(), paper_scenes.end(), [&](const PaperScene& row) { return scene == row.scene; });
  core::expect(found != paper_scenes.end(), "the article has the scene");
  return *found;
}

/// Different pages that a pixel reads, on average.
double pages_a_pixel(const Subject& subject, const Interrupt& interrupt) {
  StrategyOptions options;
  options.computer.node_count = 1;
  options.pages.count_pages = true;
  const Report report = render_timed(options, subject.database, subject.settings, interrupt).report;
  const std::uint64_t pages = std::get<svm::Report>(report).pages().distinct_pages;
  return static_cast<double>(pages) / subject.settings.camera.pixel_count();
}

Comparison comparison(const std::string& scene, const char* what, const char* unit, double here, double there) {
  return {.part = SpeedPart::pages,
          .scene = scene,
          .what = what,
          .threads = 0,
          .subject = "here",
          .rival = "article of 1994",
          .unit = unit,
          .figures = {{here}, {there}}};
}

}  // namespace

void measure_pages(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  const std::vector<std::string> scenes = settings.scenes_of(SpeedPart::pages);
  Progress progress(std::cerr, stderr_is_terminal(), "pages:", "scenes");
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    interrupt.check();
    progress.update(i, scenes.size());
    PictureOptions picture = settings.picture_of(SpeedPart::pages, scenes[i]);
    picture.convention = core::Convention::paper;
    picture.skips.background = false;
    const Subject subject = build_subject(settings.load(picture), picture);
    const PaperScene& row = row_of(scenes[i]);
    const double kilobytes = static_cast<double>(subject.database.bytes().size()) / 1024;
    const double pages = pages_a_pixel(subject, interrupt);
    results.push_back(comparison(scenes[i], "database", "KB", kilobytes, static_cast<double>(row.database_kilobytes)));
    results.push_back(comparison(scenes[i], "distinct pages a pixel", "", pages, row.pages_a_pixel));
  }
}

}  // namespace dmpc::apps
