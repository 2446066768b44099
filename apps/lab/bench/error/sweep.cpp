#include "apps/lab/bench/error/sweep.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <utility>

#include "apps/frontend/line/words.h"
#include "apps/scene/picture_options.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"
#include "core/families/scenes.h"

namespace dmpc::apps {
namespace {

constexpr std::array<const char*, 10> knob_names = {"samples",    "adaptive", "cutoff",  "depth",    "tessellation",
                                                    "arithmetic", "quality",  "bounces", "roulette", "emitters"};
constexpr const char *whitted_knobs = "samples,adaptive,cutoff,depth,tessellation,arithmetic,quality",
                     *path_knobs = "samples,adaptive,bounces,roulette,emitters";

Knob knob_of(const std::string& word, const std::string& text) {
  const auto* const found = std::find(knob_names.begin(), knob_names.end(), word);
  if (found == knob_names.end()) {
    const std::vector<std::string> all(knob_names.begin(), knob_names.end());
    const std::string meant = core::did_you_mean(word, all);
    throw core::UsageError("--knobs=" + text + ": expected some of " + whitted_knobs + ", or by paths of " + path_knobs +
                           ", with commas between them" + (meant.empty() ? "" : ".") + meant);
  }
  return static_cast<Knob>(found - knob_names.begin());
}

/// A number as written for readers.
struct Named {
  const char* text;
  double value;
};

constexpr std::array<Named, 10> errors = {{{"64/255", 64.0 / 255},
                                           {"32/255", 32.0 / 255},
                                           {"16/255", 16.0 / 255},
                                           {"8/255", 8.0 / 255},
                                           {"4/255", 4.0 / 255},
                                           {"2/255", 2.0 / 255},
                                           {"1/255", 1.0 / 255},
                                           {"1/510", 1.0 / 510},
                                           {"1/1020", 1.0 / 1020},
                                           {"1/2040", 1.0 / 2040}}};
/// A quick sweep has so many of them.
constexpr std::ptrdiff_t quick_errors = 5;
constexpr std::array<Named, 6> cutoffs = {
    {{"1/64", 1.0 / 64}, {"1/255", 1.0 / 255}, {"1/512", 1.0 / 512}, {"1/1024", 1.0 / 1024}, {"1/4096", 1.0 / 4096}, {"0", 0}}};
constexpr std::array bounce_counts = {0, 1, 2, 3, 4, 6, 8, 12, 16, 32, 64, 128};
/// First hits at which paths may end at random. The last is beyond all.
constexpr std::array<Named, 5> roulettes = {
    {{"from hit 1", 1}, {"from hit 2", 2}, {"from hit 3", 3}, {"from hit 5", 5}, {"never", 255}}};
constexpr std::array depths = {1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 16, 24, 32, 64, 128};

constexpr std::uint64_t tessellated_primitives_max = 1'000'000;

/// Collects the points of one sweep. A quick sweep leaves out every other position, but never the last one.
class Sweep {
 public:
  Sweep(const Setting& base, const SweepOptions& options) : base_(base), options_(options) {}

  void add(Knob knob) {
    switch (knob) {
      case Knob::samples:
        return add_samples();
      case Knob::adaptive:
        return add_errors();
      case Knob::cutoff:
        return add_each(cutoffs, [&](const Named& cutoff) { add(knob, cutoff.text, turned(&Setting::cutoff, cutoff.value)); });
      case Knob::depth:
        return add_up_to(base_.depth, depths, [&](int depth) { add(knob, depth, turned(&Setting::depth, depth)); });
      case Knob::tessellation:
        return add_tessellations();
      case Knob::arithmetic:
        return add(Knob::arithmetic, "float", base_);
      case Knob::quality:
        add(Knob::quality, "draft", with_quality(Quality::draft));
        return add(Knob::quality, "good", with_quality(Quality::good));
      case Knob::bounces:
        return add_up_to(*base_.bounces, bounce_counts,
                         [&](int bounces) { add(knob, bounces, turned(&Setting::bounces, std::optional(bounces))); });
      case Knob::roulette:
        return add_each(roulettes, [&](const Named& first) {
          add(knob, first.text, turned(&Setting::roulette_from, static_cast<int>(first.value)));
        });
      case Knob::emitters:
        return add_emitters();
    }
  }

  std::vector<Point> points;

 private:
  void add(Knob knob, const std::string& text, const Setting& setting) { points.push_back({knob, text, setting}); }
  void add(Knob knob, std::integral auto position, const Setting& setting) { add(knob, std::to_string(position), setting); }

  /// Returns the base point with one of its knobs changed.
  template <class Position>
  Setting turned(Position Setting::*knob, Position position) const {
    Setting setting = base_;
    setting.*knob = position;
    return setting;
  }

  template <class Positions, class Add>
  void add_each(const Positions& positions, const Add& add_one) const {
    const std::size_t last = positions.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      if (!options_.is_quick || (last - i) % 2 == 0) {
        add_one(positions[i]);
      }
    }
  }

  Setting refined(const Named& error) const {
    Setting setting = base_;
    setting.samples = base_.is_by_paths() ? core::first_refined_samples(core::ErrorKind::noise) : refined_samples;
    setting.error = error.value;
    return setting;
  }
  Setting with_quality(Quality quality) const {
    Setting setting = base_;
    setting.samples = refined_samples;
    setting.error = choice_of(quality).error;
    setting.cutoff = choice_of(quality).cutoff;
    return setting;
  }

  /// Adds the positions below `last`, and `last`.
  template <class Positions, class Add>
  void add_up_to(int last, const Positions& all, const Add& add_one) const {
    std::vector<int> positions(all.begin(), std::lower_bound(all.begin(), all.end(), last));
    positions.push_back(last);
    add_each(positions, add_one);
  }

  void add_errors() {
    const auto* const end =
        std::ranges::partition_point(errors, [&](const Named& error) { return error.value >= options_.error_least; });
    for (const auto* error = options_.is_quick ? std::max(end - quick_errors, errors.begin()) : errors.begin(); error != end;
         ++error) {
      add(Knob::adaptive, error->text, refined(*error));
    }
  }

  void add_samples() {
    std::set<int> counts = options_.is_quick ? std::set{1, 4, 16, 32, 64} : std::set{1, 4, 16, 32, 64, 256};
    if (base_.is_by_paths()) {
      counts.insert(256);
    }
    counts.insert(base_.samples);
    for (const int count : counts) {
      add(Knob::samples, count, turned(&Setting::samples, count));
    }
  }

  /// Adds no emitters, some of the most powerful, and all that the base point samples.
  void add_emitters() {
    if (options_.emitters == 0) {
      return;
    }
    add(Knob::emitters, "none", turned(&Setting::emitters, 0U));
    for (std::uint32_t count = 1; count < options_.emitters && !options_.is_quick; count *= 4) {
      add(Knob::emitters, count, turned(&Setting::emitters, count));
    }
    add(Knob::emitters, options_.emitters, base_);
  }

  void add_tessellations() {
    for (const int tessellation : options_.tessellations) {
      add(Knob::tessellation, "t" + std::to_string(tessellation), turned(&Setting::tessellation, tessellation));
    }
    if (!options_.tessellations.empty()) {
      add(Knob::tessellation, "exact", base_);
    }
  }

  const Setting& base_;
  const SweepOptions& options_;
};

}  // namespace

const char* name_of(Knob knob) { return knob_names[static_cast<std::size_t>(knob)]; }

std::set<Knob> parse_knobs(const std::string& text) {
  std::set<Knob> knobs;
  for (const std::string& word : words_between_commas(text, "--knobs")) {
    knobs.insert(knob_of(word, text));
  }
  return knobs;
}

std::set<Knob> all_knobs(bool are_by_paths) { return parse_knobs(are_by_paths ? path_knobs : whitted_knobs); }

void check_knobs(const std::set<Knob>& knobs, bool are_by_paths) {
  const std::set<Knob> all = all_knobs(are_by_paths);
  for (const Knob knob : knobs) {
    if (!all.contains(knob)) {
      throw core::UsageError(std::string("--knobs=") + name_of(knob) + (are_by_paths ? " does not go" : " goes") +
                             " with --transport=paths: expected some of " + (are_by_paths ? path_knobs : whitted_knobs));
    }
  }
}

std::vector<Point> sweep(const Setting& base, const SweepOptions& options) {
  core::expect(!base.is_refined() && base.cutoff == 0 && base.tessellation == 0, "the base point is exact");
  Sweep result(base, options);
  for (const Knob knob : options.knobs) {
    result.add(knob);
  }
  return std::move(result.points);
}

std::vector<int> tessellations_of(const std::string& scene, bool is_quick) {
  auto name = core::find_scene_name(scene);
  if (!name || name->tessellation > 0) {
    return {};
  }
  std::vector<int> found;
  std::uint64_t before = core::primitive_count(*name);
  for (int n = 1; n <= (is_quick ? 2 : 16); n *= 2) {
    name->tessellation = n;
    try {
      core::check_scene_name(*name);
    } catch (const core::InputError&) {
      break;
    }
    const std::uint64_t count = core::primitive_count(*name);
    if (count == before || count > tessellated_primitives_max) {
      break;
    }
    before = count;
    found.push_back(n);
  }
  return found;
}

}  // namespace dmpc::apps
