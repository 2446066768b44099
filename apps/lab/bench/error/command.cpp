#include "apps/lab/bench/error/command.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <iostream>
#include <set>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/system/python_program.h"
#include "apps/frontend/system/real_load.h"
#include "apps/frontend/table/table_files.h"
#include "apps/lab/bench/error/path_reference.h"
#include "apps/picture/image_file.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"
#include "core/families/scenes.h"

namespace dmpc::apps {
namespace {

constexpr std::uint32_t default_reference_side = 32;
/// A quick bench takes less than 20 s on two cores.
constexpr std::uint32_t quick_reference_side = 12;
constexpr Resolution quick_resolution{192, 192};
/// For paths, whose references have many more samples.
constexpr Resolution path_resolution{128, 128}, quick_path_resolution{64, 64};

/// Samples for path references, and fewer for a quick bench.
constexpr std::uint32_t path_reference_side = 128, quick_path_reference_side = 32;

constexpr std::uint64_t tessellated_primitives_max = 1'000'000;

using Words = std::vector<std::string>;

const Words& knobs_of(bool are_by_paths) {
  static const Words of_whitted = {"samples", "adaptive", "cutoff", "depth", "tessellation", "arithmetic", "quality"};
  static const Words of_paths = {"samples", "adaptive", "bounces", "emitters"};
  return are_by_paths ? of_paths : of_whitted;
}

bool is_among(const Words& words, const std::string& word) { return std::ranges::count(words, word) > 0; }

Words parse_knobs(const std::string& text) {
  Words knobs = words_between_commas(text, "--knobs");
  for (const std::string& word : knobs) {
    if (is_among(knobs_of(false), word) || is_among(knobs_of(true), word)) {
      continue;
    }
    Words all = knobs_of(false);
    all.insert(all.end(), knobs_of(true).begin(), knobs_of(true).end());
    const std::string meant = core::did_you_mean(word, all);
    throw core::UsageError("--knobs=" + text + ": expected some of " + joined(knobs_of(false), ",") + ", or by paths of " +
                           joined(knobs_of(true), ",") + ", with commas between them" + (meant.empty() ? "" : ".") + meant);
  }
  return knobs;
}

/// The number is even, since the reference has two halves.
std::uint32_t parse_reference_side(const std::string& text) {
  const std::uint32_t side = number_in<std::uint32_t>(text).value_or(0);
  if (side < 2 || side > 128 || side % 2 != 0) {
    throw core::UsageError("--reference-samples=" + text + ": expected an even number from 2 to 128");
  }
  return side;
}

/// What of a scene's name a file's can have, as in the program in Python.
std::string file_text(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char character) { return std::isalnum(character) == 0; }, '-');
  return text;
}

void check_scenes(const ErrorOptions& options, bool are_knobs_given) {
  if (options.scenes.empty()) {
    throw core::UsageError("SCENE: expected one or more");
  }
  std::set<std::string> names;
  for (const std::string& scene : options.scenes) {
    if (!names.insert(file_text(scene)).second) {
      throw core::UsageError("SCENE " + scene + ": there is another one with this name, and their outputs would clash");
    }
    if (are_knobs_given && is_among(options.knobs, "tessellation") && tessellations_of(scene, options.is_quick).empty()) {
      throw core::UsageError(
          "--knobs=tessellation: " + scene +
          " is no built-in scene of at most a million triangles that has exact spheres or cones to tessellate");
    }
  }
}

TableFiles files_of(const ErrorOptions& options) {
  OtherFiles others;
  std::vector<PlottedNames> plotted;
  for (const std::string& scene : options.scenes) {
    add_scene_file(scene, others.inputs);
    const std::string name = "error_" + file_text(scene);
    plotted.push_back({name + ".csv", {name, name + "_knobs"}});
  }
  return {options.table, plotted, others};
}

std::string light_text(const PictureOptions& picture) {
  return picture.transport.is_by_paths() ? ", " + text_of(picture.transport) : " at depth " + std::to_string(picture.depth);
}

std::string title_of(const ErrorOptions& options) {
  return "Error against time: about " + counted(static_cast<std::uint64_t>(options.picture.samples), "sample") + " a pixel" +
         light_text(options.picture) + ", convention " +
         (options.picture.convention == core::Convention::haines ? "haines" : "paper") + ", " +
         name_of(options.strategy.strategy) + " on " + counted(options.strategy.computer.node_count, "node") + ", " +
         counted(options.rounds, "round");
}

/// The default knobs, size and reference depend on the transport and on --quick. Options that are given take precedence.
void choose_defaults(const OptionSet& set, ErrorOptions& options) {
  PictureOptions& picture = options.picture;
  const bool are_by_paths = picture.transport.is_by_paths();
  options.knobs = set.is_given("--knobs") ? options.knobs : knobs_of(are_by_paths);
  for (const std::string& knob : options.knobs) {
    if (!is_among(knobs_of(are_by_paths), knob)) {
      throw core::UsageError("--knobs=" + knob + (are_by_paths ? " does not go" : " goes") +
                             " with --transport=paths: expected some of " + joined(knobs_of(are_by_paths), ","));
    }
  }
  if (!set.is_given("--resolution") && options.is_quick) {
    picture.resolution = are_by_paths ? quick_path_resolution : quick_resolution;
  } else if (!set.is_given("--resolution") && are_by_paths) {
    picture.resolution = path_resolution;
  }
  std::uint32_t& side = options.reference.samples_a_side;
  if (!set.is_given("--reference-samples")) {
    side = are_by_paths ? (options.is_quick ? quick_path_reference_side : path_reference_side)
                        : (options.is_quick ? quick_reference_side : default_reference_side);
  }
  if (are_by_paths && !std::has_single_bit(side)) {
    throw core::UsageError("--reference-samples=" + std::to_string(side) + ": by paths expected a power of two from 2 to 128");
  }
  picture.transport.are_bounces_unasked = false;
  picture.depth = are_by_paths ? picture.transport.depth() : picture.depth;
}

/// Returns the options given, with those that the program in Python always needs.
Words words_of(const OptionSet& set, const ErrorOptions& options) {
  const PictureOptions& picture = options.picture;
  const auto number = [](auto value) { return std::to_string(value); };
  std::vector<std::pair<std::string, std::string>> chosen = {{"--knobs", joined(options.knobs, ",")},
                                                             {"--samples", number(picture.samples)},
                                                             {"--reference-samples", number(options.reference.samples_a_side)},
                                                             {"--transport", name_of(picture.transport.kind)},
                                                             {"--strategy", name_of(options.strategy.strategy)},
                                                             {"--nodes", number(options.strategy.computer.node_count)},
                                                             {"--repeat", number(options.rounds)}};
  if (picture.transport.is_by_paths()) {
    chosen.insert(chosen.end(),
                  {{"--bounces", number(picture.transport.bounces)}, {"--emitters", number(picture.transport.emitters)}});
  } else {
    chosen.emplace_back("--depth", number(picture.depth));
  }
  if (picture.resolution) {
    chosen.emplace_back("--resolution", number(picture.resolution->width) + "x" + number(picture.resolution->height));
  }
  Words names, words;
  for (const auto& [name, value] : chosen) {
    names.push_back(name);
    words.push_back(name + "=" + value);
  }
  const Words given = set.given_words(names);
  words.insert(words.end(), given.begin(), given.end());
  return words;
}

std::string file_of(const Image& image) { return file_for_python(encoded_picture("picture.exr", image)); }

/// Computes the references of one scene.
class ReferenceMaker {
 public:
  /// `picture` has a resolution.
  ReferenceMaker(const core::Scene& scene, const PictureOptions& picture, const ErrorOptions& options, const Interrupt& interrupt)
      : scene_(scene),
        picture_(picture),
        options_(options),
        interrupt_(interrupt),
        subject_(build_subject_quietly(scene, picture, usual_database(options.strategy.strategy))) {}

  /// Returns figures by name, and files of pictures: the reference, half the difference of its halves, and with the knob
  /// `arithmetic` the base point in double precision, sample by sample.
  std::string figures() const {
    const Reference found = reference();
    Words files = {file_of(found.picture), file_of(found.difference)};
    if (is_among(options_.knobs, "arithmetic")) {
      files.push_back(file_of(in_double()));
    }
    const std::vector<int> tessellations = tessellations_of(picture_.scene, options_.is_quick);
    return "width=" + std::to_string(found.picture.width) + " height=" + std::to_string(found.picture.height) +
           " rays=" + std::to_string(found.rays) + " seconds=" + shortest(found.seconds) +
           " own_error=" + shortest(found.own_error) + " own_relative=" + shortest(found.own_relative_mean_square) +
           " emitters=" + std::to_string(subject_.settings.header.emitter_count) +
           " tessellations=" + joined(tessellations, ",", [](int n) { return std::to_string(n); }) +
           " pictures=" + joined(files, ",");
  }

 private:
  Reference reference() const {
    Progress progress(std::cerr, stderr_is_terminal(), "reference of " + picture_.scene + ":", "rows");
    const std::uint32_t side = options_.reference.samples_a_side;
    return picture_.transport.is_by_paths()
               ? path_reference(subject_.database, subject_.settings, side * side, attendance(progress))
               : reference_for(scene_, picture_, options_.reference, attendance(progress));
  }

  Image in_double() const {
    Progress progress(std::cerr, stderr_is_terminal(), picture_.scene + " in double precision:", "rows");
    const ReferenceScene doubled = reference_scene(scene_);
    const ReferenceCamera camera(scene_.view, picture_.resolution->width, picture_.resolution->height, doubled.bounds);
    const ReferenceFinder finder(doubled, camera.start());
    const auto pattern = SamplePattern::of_product(static_cast<std::uint32_t>(picture_.samples));
    const ReferencePicture found =
        render_accurately(doubled, finder, camera, pattern, subject_.settings.shade, attendance(progress));
    Image image(found.width, found.height);
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
      image.rgb[i] = static_cast<float>(found.radiance[i / 3][i % 3]);
    }
    return image;
  }

  Attendance attendance(Progress& progress) const {
    return {.progress = [&progress](std::uint64_t done, std::uint64_t all) { progress.update(done, all); },
            .stop = interrupt_.token()};
  }

  const core::Scene& scene_;
  const PictureOptions& picture_;
  const ErrorOptions& options_;
  const Interrupt& interrupt_;
  Subject subject_;
};

/// Messages about the scene are left to the build of its database, in Python.
std::string reference_figures(const std::string& name, const ErrorOptions& options, const std::vector<NamedFile>& outputs,
                              const Interrupt& interrupt) {
  PictureOptions picture = options.picture;
  picture.scene = name;
  OpenedFiles opened;
  const core::Scene scene = load_scene(picture, LoadNotes::silent, &opened);
  check_not_read(opened, outputs);
  picture.resolution = picture.resolution.value_or(Resolution{scene.view.width, scene.view.height});
  return ReferenceMaker(scene, picture, options, interrupt).figures();
}

/// Declares the options for what is varied and what is not.
void add_turned_options(OptionSet set, ErrorOptions& options) {
  set.add_text(
      "--knobs", "NAME,NAME,... [all]", [&](const std::string& text) { options.knobs = parse_knobs(text); },
      "Knobs to turn, one at a time: samples, adaptive (sampling), cutoff, depth, tessellation, arithmetic, quality (draft, "
      "default). By paths: samples, adaptive, bounces and emitters (the number of those for light sampling)");
  set.add_flag("--quick", options.is_quick,
               "Fewer positions of each knob and, unless given, 192x192 pixels and 12 x 12 samples per pixel of the "
               "reference: less than 20 s");
  set.add_number("--repeat", options.rounds, 1, 1000, "3", "Number of rounds; everything is rendered and timed in each");
  set.add_number("--samples", options.picture.samples, 2, 4096, std::to_string(options.picture.samples),
                 "Samples per pixel where they are not the knob");
}

}  // namespace

ErrorOptions::ErrorOptions() {
  picture.samples = 16;
  picture.depth = 8;
  strategy.strategy = Strategy::replicated;
  strategy.computer.node_count = core_count();
}

void add_options(OptionSet set, ErrorOptions& options) {
  set.add_arguments(
      "SCENE", [&options](const std::string& text) { options.scenes.push_back(text); },
      "NFF or mesh files, or built-in scenes such as teapot-12, rings-3, tetra-6");
  add_turned_options(set, options);
  add_options(set, options.picture.scene_setup);
  add_view_options(set, options.picture);
  add_transport_options(set, options.picture);
  set.add_text(
      "--reference-samples",
      "N, even, 2..128 [" + std::to_string(default_reference_side) + ", by paths " + std::to_string(path_reference_side) + "]",
      [&options](const std::string& text) { options.reference.samples_a_side = parse_reference_side(text); },
      "N x N samples per pixel of the reference");
  add_strategy_option(set, options.strategy.strategy);
  set.add_number("--nodes", options.strategy.computer.node_count, 1, nodes::node_count_max,
                 std::to_string(options.strategy.computer.node_count), "Nodes that render");
  add_options(set, options.table, TableExtras::plots);
  set.add_quiet(options.quiet);
  set.set_examples(
      "Examples:\n"
      "  dmpc bench error teapot-12 --quick\n"
      "  dmpc bench error rings-3 balls-3 --knobs=samples,adaptive --plots=plots -o error.md\n"
      "  dmpc bench error balls-3 --transport=paths --bounces=4 --sky=1 --light-radius=1 --quick\n"
      "  dmpc bench error shells-3 --knobs=depth,cutoff --repeat=1 --format=csv -o shells.csv\n"
      "By paths pictures have 128x128 pixels by default, 64x64 with --quick, and references 32 x 32 samples with --quick.\n"
      "The reference and the base point have the given depth; the other depths are smaller.");
  set.check_in_the_end([set, &options] {
    choose_defaults(set, options);
    check_scenes(options, set.is_given("--knobs"));
    check_together(set, options.strategy);
    options.words = words_of(set, options);
  });
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

int bench_error_command(const ErrorOptions& options, Interrupt& interrupt, std::ostream& output) {
  const TableFiles files = files_of(options);
  Words words = options.words;
  words.push_back("--load=" + fixed(machine_load(), 1));
  words.push_back("--title=" + title_of(options));
  for (const std::string& scene : options.scenes) {
    words.push_back("--reference=" + reference_figures(scene, options, files.names(), interrupt));
  }
  words.insert(words.end(), options.scenes.begin(), options.scenes.end());
  output.flush();
  become_python("errors.command", "bench error", words);
}

}  // namespace dmpc::apps
