#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/system/progress.h"
#include "apps/frontend/system/stopwatch.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"
#include "apps/lab/study/engine/timed_render.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"
#include "core/picture/camera/background.h"
#include "core/trace/work.h"

namespace dmpc::apps {
namespace {

using core::Skip;
using core::Skips;

/// With fewer nodes no region is empty.
constexpr std::uint32_t page_nodes = 2, ray_nodes = 64;

struct Cutoff {
  const char* name;
  double value;
};
constexpr std::array traced_cutoffs{Cutoff{"cutoff 1/1024", 1.0 / 1024}, Cutoff{"cutoff 1/255", 1.0 / 255}};

struct Variant {
  Strategy strategy = Strategy::svm;
  Skips skips;
  double cutoff = 0;
};

double error_between(const core::Film& film, const core::Film& other) {
  const auto pixels = static_cast<std::uint32_t>(film.pixel_count());
  double squares = 0;
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    const core::Vec3d off = film.radiance(pixel) - other.radiance(pixel);
    squares += dot(off, off);
  }
  return std::sqrt(squares / (3.0 * pixels));
}

class AblationBench {
 public:
  AblationBench(const std::string& scene, const SpeedSettings& settings, const Interrupt& interrupt,
                std::vector<Comparison>& results)
      : scene_(scene),
        interrupt_(interrupt),
        results_(results),
        matches_(results),
        subject_(settings.subject_of(SpeedPart::ablation, scene)) {}

  void measure(std::size_t rounds) {
    const std::size_t by_pages = add({}), by_rays = add({.strategy = Strategy::dataflow});
    compare("without all skips", add({.skips = core::no_skips()}), by_pages);
    for (const Skip& skip : core::all_skips) {
      const bool is_of_rays = skip.is_on == &Skips::empty_regions;
      compare(std::string("without ") + skip.name,
              add({.strategy = is_of_rays ? Strategy::dataflow : Strategy::svm, .skips = without(skip)}),
              is_of_rays ? by_rays : by_pages);
    }
    std::vector<std::size_t> cut;
    for (const Cutoff& cutoff : traced_cutoffs) {
      compare(std::string("without ") + cutoff.name, by_pages, cut.emplace_back(add({.cutoff = cutoff.value})));
    }
    for (const std::size_t again : {by_pages, by_rays}) {
      const Variant variant = variants_[again];
      compare("the same again", add(variant), again);
      render(variant);  // the first render in a process takes longer
    }
    Progress progress(std::cerr, stderr_is_terminal(), scene_ + " without skips:", "renders");
    matches_.measure(rounds, progress);
    for (std::size_t i = 0; i < cut.size(); ++i) {
      Comparison error = comparison_of("error", "with " + std::string(traced_cutoffs[i].name), Strategy::svm, "root mean square");
      error.baseline = "1/255";
      results_.push_back(error.once(error_between(*films_[cut[i]], *films_[by_pages]), 1.0 / 255));
    }
  }

 private:
  struct Rendered {
    double seconds, work;  ///< processor seconds; counted operations, weighted by prices
    core::Film film;
  };

  std::size_t add(const Variant& variant) {
    variants_.push_back(variant);
    films_.emplace_back();
    return matches_.add([this, number = variants_.size() - 1] {
      const Rendered rendered = render(variants_[number]);
      films_[number] = rendered.film;
      core::expect(variants_[number].cutoff > 0 || rendered.film.hash() == films_.front()->hash(),
                   "an exact skip changes no film");
      return std::vector{rendered.seconds, rendered.work};
    });
  }

  void compare(const std::string& subject, std::size_t without, std::size_t with) {
    const Strategy strategy = variants_[with].strategy;
    matches_.compare(without, with, comparison_of("render", subject, strategy, "s of processors"));
    matches_.compare(without, with, comparison_of("counted work", subject, strategy, "ps"), 1);
  }

  Comparison comparison_of(const char* what, const std::string& subject, Strategy strategy, const char* unit) const {
    return {.part = SpeedPart::ablation,
            .scene = scene_,
            .what = what,
            .threads = strategy == Strategy::dataflow ? ray_nodes : page_nodes,
            .subject = subject,
            .baseline = std::string("with it, ") + name_of(strategy),
            .unit = unit};
  }

  Rendered render(const Variant& variant) const {
    core::RenderSettings settings = subject_.settings;
    settings.skips = variant.skips;
    settings.shade.cutoff = variant.cutoff;
    DoubleStopwatch stopwatch;
    settings.background =
        variant.skips.background ? core::find_background(subject_.database, settings.camera) : core::BackgroundTiles();
    const double to_prepare = stopwatch.lap().processor_seconds;
    const StrategyOptions options{.strategy = variant.strategy,
                                  .computer = {.node_count = variant.strategy == Strategy::dataflow ? ray_nodes : page_nodes}};
    const TimedRender one = render_timed(options, subject_.database, settings, interrupt_);
    const Account account = account_of(one.report);
    return {to_prepare + one.times.processor_seconds, static_cast<double>(core::work_of(account.operations)), account.film};
  }

  std::string scene_;
  const Interrupt& interrupt_;
  std::vector<Comparison>& results_;
  Matches matches_;
  Subject subject_;
  std::vector<Variant> variants_;  ///< the first two with all skips on
  std::vector<std::optional<core::Film>> films_;
};

}  // namespace

void measure_ablation(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results) {
  for (const std::string& scene : settings.scenes_of(SpeedPart::ablation)) {
    AblationBench(scene, settings, interrupt, results).measure(settings.rounds_of(SpeedPart::ablation));
  }
}

}  // namespace dmpc::apps
