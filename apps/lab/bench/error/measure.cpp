#include "apps/lab/bench/error/measure.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <utility>

#include "apps/frontend/system/progress.h"
#include "apps/frontend/table/rounds.h"
#include "apps/lab/bench/error/path_reference.h"
#include "apps/lab/oracle/reference/picture.h"
#include "apps/lab/study/engine/timed_render.h"
#include "apps/picture/film_image.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"
#include "core/families/scenes.h"

namespace dmpc::apps {
namespace {

PictureOptions picture_of(PictureOptions picture, const Setting& setting) {
  picture.samples = setting.samples;
  picture.is_refined = setting.is_refined();
  picture.refinement.error = setting.error;
  picture.depth = setting.depth;
  picture.cutoff = setting.cutoff;
  if (setting.is_by_paths()) {
    picture.refinement.kind = core::ErrorKind::noise;
    picture.transport.bounces = *setting.bounces;
    picture.transport.are_bounces_unasked = false;
    picture.transport.emitters = setting.emitters;
    picture.depth = picture.transport.depth();
  }
  return picture;
}

/// The scene in all tessellations and with all numbers of sampled emitters, each built on first use.
class Scenes {
 public:
  Scenes(const std::string& name, const MeasureOptions& options)
      : picture_(options.picture), database_(usual_database(options.strategy.strategy)), outputs_(options.outputs) {
    picture_.scene = name;
    add(exact_);
  }

  struct Built {
    core::Scene scene;
    Subject subject;
  };
  const Built& of(const Setting& setting) {
    const Key key{setting.tessellation, setting.is_by_paths() ? setting.emitters : picture_.transport.emitters};
    return scenes_.contains(key) ? scenes_.at(key) : add(key);
  }
  const Built& exact() const { return scenes_.at(exact_); }

 private:
  /// Tessellation, and number of emitters.
  using Key = std::pair<int, std::uint32_t>;

  /// Notes are not repeated for a scene that was built with another number of sampled emitters.
  const Built& add(const Key& key) {
    PictureOptions picture = picture_;
    picture.transport.emitters = key.second;
    const bool is_there = key != exact_ && key.first == exact_.first;
    core::Scene scene = is_there ? exact().scene : load(key.first);
    Subject subject = is_there ? build_subject_quietly(scene, picture, database_) : build_subject(scene, picture, database_);
    return scenes_.emplace(key, Built{std::move(scene), std::move(subject)}).first->second;
  }
  core::Scene load(int tessellation) {
    if (tessellation == 0) {
      core::Scene scene = load_scene(picture_, LoadNotes::said, &opened_);
      check_not_read(opened_, outputs_);
      return scene;
    }
    core::SceneName name = core::parse_scene_name(picture_.scene);
    name.tessellation = tessellation;
    return core::built_in_scene(name);
  }

  PictureOptions picture_;
  DatabaseOptions database_;
  std::vector<NamedFile> outputs_;
  OpenedFiles opened_;
  Key exact_{0, picture_.transport.emitters};
  std::map<Key, Built> scenes_;
};

struct Rendered {
  Image picture;
  double seconds = 0;
  std::uint64_t rays = 0, samples = 0, film_hash = 0;
};

Image reference_image(const ReferencePicture& reference) {
  Image image(reference.width, reference.height);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    image.rgb[i] = static_cast<float>(reference.radiance[i / 3][i % 3]);
  }
  return image;
}

class Bench {
 public:
  Bench(const std::string& scene, const MeasureOptions& options, const Interrupt& interrupt, SceneResult& result)
      : options_(options), interrupt_(interrupt), result_(result), scenes_(scene, options) {
    const core::View& view = scenes_.exact().scene.view;
    const Resolution size = options.picture.resolution.value_or(Resolution{view.width, view.height});
    result_.scene = scene;
    result_.width = size.width;
    result_.height = size.height;
    result_.base = {.samples = options.picture.samples, .depth = options.picture.depth};
    if (options.picture.transport.is_by_paths()) {
      result_.base.bounces = options.picture.transport.bounces;
      result_.base.emitters = options.picture.transport.emitters;
      result_.emitters = scenes_.exact().subject.settings.header.emitter_count;
    }
    result_.reference_samples_a_side = options.reference.samples_a_side;
  }

  void measure() {
    find_reference();
    find_reference_picture();
    plan(true, result_.reference.own_error);
    for (Measurement& measurement : result_.measurements) {
      measure(measurement);
    }
    plan(false, least_error());
    Progress progress(std::cerr, stderr_is_terminal(), result_.scene + ":", "renders");
    const std::size_t count = result_.measurements.size();
    round_by_round(options_.rounds, count, [&](std::size_t round, std::size_t index) {
      progress.update(round * count + index, options_.rounds * count);
      if (result_.measurements[index].seconds.size() <= round) {
        measure(result_.measurements[index]);
      }
    });
  }

 private:
  /// Adaptive sampling is asked for no error that the reference cannot tell, or that uniform samples do not reach.
  double least_error() const {
    double least = std::numeric_limits<double>::infinity();
    for (const Measurement& measurement : result_.measurements) {
      least = is_told(result_, measurement) ? std::min(least, error_of(measurement)) : least;
    }
    return std::max(std::isfinite(least) ? least / curve_reach : 0, result_.reference.own_error);
  }

  /// Plans uniform samples, or the other knobs.
  void plan(bool is_uniform, double error_least) {
    SweepOptions options{
        .knobs = options_.knobs, .is_quick = options_.is_quick, .error_least = error_least, .emitters = result_.emitters};
    std::erase_if(options.knobs, [&](Knob knob) { return (knob == Knob::samples) != is_uniform; });
    if (options.knobs.contains(Knob::tessellation)) {
      options.tessellations = tessellations_of(result_.scene, options.is_quick);
    }
    add_points(sweep(result_.base, options));
  }

  /// The base point is measured first, if there is any point: others are compared with its picture.
  void add_points(const std::vector<Point>& points) {
    auto& all = result_.measurements;
    if (all.empty() && std::ranges::find(points, result_.base, &Point::setting) != points.end()) {
      all.push_back({.setting = result_.base});
    }
    for (const Point& point : points) {
      result_.points.push_back(point);
      const auto found = std::ranges::find(all, point.setting, &Measurement::setting);
      result_.measurement_of.push_back(static_cast<std::size_t>(found - all.begin()));
      if (found == all.end()) {
        all.push_back({.setting = point.setting});
      }
    }
  }

  void find_reference() {
    Progress progress(std::cerr, stderr_is_terminal(), "reference of " + result_.scene + ":", "rows");
    const PictureOptions picture = picture_of(options_.picture, result_.base);
    if (result_.base.is_by_paths()) {
      const std::uint32_t side = options_.reference.samples_a_side;
      result_.reference =
          path_reference(scenes_.exact().subject.database, settings_of(result_.base), side * side, attendance(progress));
    } else {
      result_.reference = reference_for(scenes_.exact().scene, picture, options_.reference, attendance(progress));
    }
  }

  Attendance attendance(Progress& progress) const {
    return {.progress = [&progress](std::uint64_t done, std::uint64_t all) { progress.update(done, all); },
            .stop = interrupt_.token()};
  }

  /// Renders the base point in double precision, sample by sample, if requested.
  void find_reference_picture() {
    if (!options_.knobs.contains(Knob::arithmetic)) {
      return;
    }
    Progress progress(std::cerr, stderr_is_terminal(), result_.scene + " in double precision:", "rows");
    const ReferenceScene scene = reference_scene(scenes_.exact().scene);
    const ReferenceCamera camera(scenes_.exact().scene.view, result_.width, result_.height, scene.bounds);
    const ReferenceFinder finder(scene, camera.start());
    const auto pattern = SamplePattern::of_product(static_cast<std::uint32_t>(result_.base.samples));
    const core::RenderSettings settings = settings_of(result_.base);
    reference_ = reference_image(render_accurately(scene, finder, camera, pattern, settings.shade, attendance(progress)));
  }

  core::RenderSettings settings_of(const Setting& setting) {
    const Scenes::Built& built = scenes_.of(setting);
    core::RenderSettings settings = render_settings(picture_of(options_.picture, setting), built.scene, built.subject.database);
    settings.shade.transport.roulette_from = static_cast<std::uint8_t>(setting.roulette_from);
    return settings;
  }

  Rendered render(const Setting& setting) {
    const TimedRender one =
        render_timed(options_.strategy, scenes_.of(setting).subject.database, settings_of(setting), interrupt_);
    const Account account = account_of(one.report);
    return {.picture = image_of(account.film),
            .seconds = one.times.processor_seconds,
            .rays = account.operations.ray_count(),
            .samples = account.film.samples(),
            .film_hash = account.film.hash()};
  }

  void measure(Measurement& measurement) {
    const Rendered rendered = render(measurement.setting);
    if (measurement.is_done()) {
      core::expect(rendered.film_hash == measurement.film_hash, "a setting has one film in all rounds");
    } else {
      measurement.rays = rendered.rays;
      measurement.samples = rendered.samples;
      measurement.film_hash = rendered.film_hash;
      judge(measurement, rendered.picture);
    }
    measurement.seconds.push_back(rendered.seconds);
    if (measurement.seconds.size() == 1 && options_.reported) {
      options_.reported(result_);
    }
  }

  void judge(Measurement& measurement, const Image& picture) {
    const Setting& setting = measurement.setting;
    if (setting == result_.base) {
      base_ = picture;
      if (reference_) {
        result_.arithmetic = measure_error(picture, *reference_);
      }
    }
    measurement.error = measure_error(picture, result_.reference.picture);
    measurement.squares = square_errors(picture, result_.reference);
    if (base_ && !setting.is_by_paths() && !setting.is_refined() && setting.samples == result_.base.samples) {
      measurement.deterministic = measure_error(picture, *base_);
    }
  }

  const MeasureOptions& options_;
  const Interrupt& interrupt_;
  SceneResult& result_;
  Scenes scenes_;
  std::optional<Image> reference_, base_;
};

}  // namespace

std::string file_text(const std::string& text) {
  std::string safe = text;
  std::replace_if(
      safe.begin(), safe.end(), [](unsigned char character) { return std::isalnum(character) == 0; }, '-');
  return safe;
}

void measure_scene(const std::string& scene, const MeasureOptions& options, const Interrupt& interrupt, SceneResult& result) {
  Bench(scene, options, interrupt, result).measure();
  result.reference.picture = result.reference.difference = {};
}

}  // namespace dmpc::apps
