#include "apps/lab/bench/precision/command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <ostream>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/option_values.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/table/filled_columns.h"
#include "apps/frontend/table/shown_rows.h"
#include "apps/frontend/table/table_files.h"
#include "apps/lab/bench/precision/precision.h"
#include "apps/lab/oracle/trial_line.h"
#include "apps/lab/study/engine/tabled_job.h"
#include "apps/scene/load_scene.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

constexpr int measured_side = 256, measured_depth = 5;

struct FamilyExpectation {
  const char* scene;
  double percent;
  const char* reason;
};

constexpr const char* by_mirrors = "mirrors multiply what rounding leaves at each bounce";
constexpr const char* by_steps = "colours lie next to a step of 8 bits";
constexpr const char* by_nothing = "nothing is rounded by a step of 8 bits";

constexpr std::array<FamilyExpectation, 11> family_expectations = {{{"balls-4", 99.92, by_mirrors},
                                                                    {"gears-4", 99.99, by_steps},
                                                                    {"jacks-1", 100, by_nothing},
                                                                    {"lattice-12", 99.96, by_mirrors},
                                                                    {"mount-6", 99.99, by_steps},
                                                                    {"rings-7", 99.92, by_mirrors},
                                                                    {"shells-5", 99.94, by_mirrors},
                                                                    {"sombrero-1", 100, by_nothing},
                                                                    {"teapot-12", 99.99, by_steps},
                                                                    {"tetra-6", 100, by_nothing},
                                                                    {"tree-11", 99.99, by_steps}}};

/// Parses "99.5": a number from 0 to 100.
double parse_expectation(const std::string& text) {
  return parse_within(text, "--expect", 0, 100, "a percentage from 0 to 100, such as 99.5");
}

Expectation usual_expectation() { return {99, "what is expected of any scene"}; }

constexpr int failed_status = 3;
/// Number of unexplained pixels of one scene that are described.
constexpr std::size_t errors_shown = 10;

/// Returns every family in its own size.
std::vector<std::string> all_families() { return core::mapped<std::string>(family_expectations, &FamilyExpectation::scene); }

TableFiles files_of(const PrecisionOptions& options) {
  OtherFiles others;
  for (const std::string& scene : options.scenes) {
    add_scene_file(scene, others.inputs);
  }
  return {options.table, {}, others};
}

double percent_equal(const Precision& precision) {
  return 100 * (1 - static_cast<double>(precision.differing_pixels) / static_cast<double>(precision.pixels));
}

struct PrecisionRow {
  const std::string& scene;
  const Precision& precision;
  const Expectation& expectation;

  bool is_explained() const { return precision.errors.empty(); }
  bool is_warned() const { return precision.causes[static_cast<std::size_t>(PixelCause::warned)] > 0; }
  /// The number that may differ is rounded up: in a small picture one may, even if the share is less than a whole one.
  bool is_expected() const {
    const double may_differ = (1 - expectation.percent / 100) * static_cast<double>(precision.pixels);
    return static_cast<double>(precision.differing_pixels) <= std::ceil(may_differ - 1e-9);
  }
  const char* verdict() const {
    return !is_explained()         ? (precision.is_by_paths ? "other mean" : "unexplained")
           : !is_expected()        ? "too few"
           : precision.is_by_paths ? "same mean"
           : is_warned()           ? "warned"
                                   : "explained";
  }
};

FilledColumns<PrecisionRow> precision_columns() {
  using Row = PrecisionRow;
  FilledColumns<Row> columns = {{{"scene"}, [](const Row& row) { return row.scene; }},
                                {{"primitives"}, [](const Row& row) { return row.precision.primitives; }},
                                {{"rays"}, [](const Row& row) { return row.precision.rays; }},
                                {{"equal pixels", "%", 4}, [](const Row& row) { return percent_equal(row.precision); }},
                                {{"RMSE", "1/255", 4}, [](const Row& row) { return 255 * row.precision.root_mean_square; }},
                                {{"largest", "1/255", 3}, [](const Row& row) { return 255 * row.precision.largest; }},
                                {{"differ"}, [](const Row& row) { return row.precision.differing_pixels; }}};
  for (std::size_t cause = 0; cause < pixel_cause_count; ++cause) {
    columns.push_back({{std::string(name_of(static_cast<PixelCause>(cause)))},
                       [cause](const Row& row) { return row.precision.causes[cause]; }});
  }
  columns.push_back({{"largest step", "", 2}, [](const Row& row) { return row.precision.largest_step; }});
  columns.push_back({{"expected", "%", 2}, [](const Row& row) { return row.expectation.percent; }});
  columns.push_back({{"verdict"}, [](const Row& row) { return std::string(row.verdict()); }});
  return columns;
}

Table empty_table(const PrecisionOptions& options) {
  Table table("Precision of the picture in float against double precision: " + std::to_string(options.resolution.width) + "x" +
                  std::to_string(options.resolution.height) + " pixels, one sample a pixel, " +
                  (options.transport.is_by_paths() ? text_of(options.transport)
                                                   : "depth " + std::to_string(options.depth) + ", convention haines"),
              heads_of(precision_columns()));
  table.add_note("Pixels are compared in 8 bits with the sRGB curve; RMSE and largest are of linear light.");
  if (options.transport.is_by_paths()) {
    table.add_note(
        "Both use the same random numbers, so that nearly all pixels have the same light. Where rounding leads a path elsewhere, "
        "which is not explained, the pixel has another random value; the mean of all pixels is the same, within four standard "
        "errors.");
    return table;
  }
  table.add_note(
      "A pixel that differs is counted under the first cause that the two renderers meet when both follow it: two surfaces that "
      "nearly touch, a silhouette seen or shadowing, a hit at the end of a shadow ray, a surface that turns away from its light, "
      "total reflection, or only the rounding of colours. If a ray's answer is not exact, a ray next to it has that answer, at "
      "most 1/256 of a pixel away. Warned are pixels that are off by more, but not by more than a warning on stderr said "
      "before.");
  table.add_note(
      "Every ray, hit and answer of the renderer was checked separately: the largest step is the largest deviation of one of "
      "them, in units of rounding to float; " +
      std::to_string(static_cast<int>(StepAudit::steps_allowed)) + " are allowed.");
  return table;
}

void describe_errors(const PrecisionRow& row, Table& table) {
  const std::vector<std::string>& errors = row.precision.errors;
  for (std::size_t index = 0; index < std::min(errors_shown, errors.size()); ++index) {
    table.add_note((row.precision.is_by_paths ? "ANOTHER MEAN of " : "UNEXPLAINED in ") + row.scene + ", " + errors[index] + ".");
  }
  if (!row.is_expected()) {
    table.add_note("TOO FEW pixels of " + row.scene + " have the same 8 bits: " + fixed(percent_equal(row.precision), 4) +
                   " %, expected " + fixed(row.expectation.percent, 2) + " % (" + row.expectation.reason + ").");
  }
}

Precision measure(const PrecisionOptions& options, const std::string& name, const TableFiles& files, Interrupt& interrupt) {
  PictureOptions picture{.scene = name,
                         .resolution = options.resolution,
                         .depth = options.depth,
                         .scene_setup = options.scene_setup,
                         .transport = options.transport};
  if (options.transport.is_by_paths()) {
    picture.depth = options.transport.depth();
    picture.scene_setup.background =
        options.transport.sky ? std::optional(options.transport.sky->horizon) : options.scene_setup.background;
  }
  const core::Scene scene = load_scene_beside(picture, files.names());
  Progress progress(std::cerr, stderr_is_terminal(), name + " ", "rows");
  return measure_precision(
      scene, picture,
      {.progress = [&](std::uint64_t done, std::uint64_t rows) { progress.update(done, rows); }, .stop = interrupt.token()});
}

struct Outcome {
  std::uint64_t scenes = 0, pixels = 0, unexplained = 0, missed = 0;
  std::pair<bool, double> least{true, 100};  ///< whether it is explained, and the percentage of equal pixels
  std::string worst = {}, where = {};        ///< name of the scene with these

  bool is_right() const { return unexplained + missed == 0; }
  void count(const PrecisionRow& row) {
    ++scenes;
    pixels += row.precision.pixels;
    unexplained += row.precision.errors.size();
    missed += row.is_expected() ? 0 : 1;
    const std::pair reached(row.is_explained(), percent_equal(row.precision));
    if (reached < least) {
      least = reached;
      worst = reached.first ? fixed(reached.second, 4) + " % of pixels equal" : row.precision.errors.front();
      where = row.scene;
    }
  }
  Trial trial(bool is_by_paths) const {
    return {.tried = {{scenes, "scene"}, {pixels, "pixel"}},
            .failed = {{unexplained, is_by_paths ? "mean" : "unexplained pixel"}, {missed, "missed expectation"}},
            .worst = worst,
            .where = where};
  }
};

/// Pictures of another size or depth than measured, or with another view or lights, have the usual expectation.
Expectation expected_of(const std::string& scene, const PrecisionOptions& options) {
  const bool is_as_measured = options.resolution.width == measured_side && options.resolution.height == measured_side &&
                              options.depth == measured_depth && options.scene_setup.is_as_scene() &&
                              !options.transport.is_by_paths();
  return options.expected ? Expectation{*options.expected, "by --expect"}
         : is_as_measured ? expectation_of(scene)
                          : usual_expectation();
}

void measure_all(const PrecisionOptions& options, const std::vector<std::string>& scenes, const TableFiles& files,
                 Interrupt& interrupt, Table& table, Outcome& outcome) {
  for (const std::string& scene : scenes) {
    interrupt.check();
    const Precision precision = measure(options, scene, files, interrupt);
    const Expectation expectation = expected_of(scene, options);
    const PrecisionRow row{scene, precision, expectation};
    table.add_row(row_of(precision_columns(), row));
    describe_errors(row, table);
    outcome.count(row);
  }
}

}  // namespace

Expectation expectation_of(const std::string& scene) {
  const auto* const found = std::find_if(family_expectations.begin(), family_expectations.end(),
                                         [&](const FamilyExpectation& family) { return family.scene == scene; });
  return found == family_expectations.end() ? usual_expectation() : Expectation{found->percent, found->reason};
}

void add_options(OptionSet set, PrecisionOptions& options) {
  set.add_arguments(
      "SCENE", [&options](const std::string& text) { options.scenes.push_back(text); },
      "NFF files, mesh files or built-in scenes; all families if none is given");
  set.add_text(
      "--resolution", "WxH [256x256]", [&options](const std::string& text) { options.resolution = parse_resolution(text); },
      "Width and height of the pictures in pixels");
  set.add_number("--depth", options.depth, 1, 255, "5", "Maximum depth of reflections and refractions");
  set.add_text(
      "--expect", "PERCENT", [&options](const std::string& text) { options.expected = parse_expectation(text); },
      "Exit with status 3 if fewer pixels have the same 8 bits. The default is 99, and for pictures of the families what was "
      "measured");
  add_options(set, options.scene_setup);
  add_options(set, options.transport);
  set.check_in_the_end([set, &options] {
    check(set, options.transport);
    if (options.transport.sky && options.transport.sky->is_picture()) {
      throw core::UsageError("--sky: there is no environment map in double precision: expected a sky of colours");
    }
  });
  add_options(set, options.table, TableExtras::none);
  set.add_quiet(options.quiet);
  set.set_examples(
      "Examples:\n"
      "  dmpc bench precision\n"
      "  dmpc bench precision teapot-12 balls-4 --resolution=512x512\n"
      "  dmpc bench precision mine.nff --format=csv -o mine.csv\n"
      "  dmpc bench precision model.glb --camera=4,3,5/0,0,0 --light=10,20,10\n"
      "  dmpc bench precision hall.nff --expect=98.5\n"
      "  dmpc bench precision balls-4 --transport=paths --sky=1 --bounces=3\n"
      "The last line summarizes what was tried, what failed, the worst case and where it is.\n"
      "The exit status is 3 if rounding does not explain why a pixel differs, or if fewer pixels than expected have the same\n"
      "8 bits.");
}

int bench_precision_command(const PrecisionOptions& options, Interrupt& interrupt, std::ostream& output) {
  const TableFiles files = files_of(options);
  const std::vector<std::string> scenes = options.scenes.empty() ? all_families() : options.scenes;
  Table table = empty_table(options);
  ShownRows shown(shows_rows(options.table, options.quiet), std::cerr);
  table.set_listener([&shown](const Table& rows) { shown.show(rows); });
  Outcome outcome;
  const auto result = [&](bool is_whole) -> TableResult {
    if (!is_whole) {
      table.add_note("Ended before its time: scenes are missing.");
    }
    table.add_note(line_of(outcome.trial(options.transport.is_by_paths())));
    return {.text = text_of(table, options.table.format)};
  };
  const int status = run_tabled({.measure = [&] { measure_all(options, scenes, files, interrupt, table, outcome); },
                                 .has_findings = [&] { return !table.rows().empty(); },
                                 .consequence = "the table has the scenes measured before"},
                                result, files, interrupt, output);
  return outcome.is_right() ? status : failed_status;
}

}  // namespace dmpc::apps
