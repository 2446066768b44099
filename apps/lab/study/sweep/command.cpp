#include "apps/lab/study/sweep/command.h"

#include <algorithm>
#include <iostream>
#include <optional>
#include <utility>
#include <vector>

#include "apps/frontend/line/words.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/table/shown_rows.h"
#include "apps/frontend/table/table_files.h"
#include "apps/lab/figures/known_figures.h"
#include "apps/lab/study/engine/tabled_job.h"
#include "apps/lab/study/sweep/forecast.h"
#include "apps/lab/study/sweep/measure.h"
#include "apps/lab/study/sweep/table.h"
#include "apps/scene/load_scene.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr const char* sweep_data_file = "sweep.csv";

TableFiles files_of(const StudySweepOptions& options, const std::vector<SweepRun>& runs) {
  OtherFiles others;
  add_scene_file(options.settings.scene, others.inputs);
  return {options.table, {names_of(sweep_data_file, sweep_plots(options.settings, runs))}, others};
}

TableResult result_of(const StudySweepOptions& options, const std::vector<SweepRun>& runs,
                      const std::vector<SweepResult>& results, const std::optional<html::ForecastView>& forecast, bool is_whole) {
  Table table = sweep_table(options.settings, runs, results);
  if (!is_whole) {
    table.add_note("Ended before its time: rows are missing.");
  }
  return study_result({.title = "Study sweep of " + options.settings.scene,
                       .table = std::move(table),
                       .data_file = sweep_data_file,
                       .plots = sweep_plots(options.settings, runs),
                       .forecast = forecast},
                      options.table.format);
}

/// Declares the options of `render`, as words to be passed on.
void add_render_options(OptionSet& set, StudySweepOptions& options) {
  std::string group = sweepable_options().front().group;
  for (const OptionDescription& option : sweepable_options()) {
    if (option.group != group) {
      group = option.group;
      set.begin_group(group);
    }
    const std::string name = long_name_of(option);
    const auto take = [&options, name](const std::string& text) { options.settings.fixed.push_back(name + "=" + text); };
    if (option.value.empty()) {
      set.add_flag(name, options.flags[name], option.text);
    } else if (option.is_repeatable) {
      set.add_texts(name, option.value, take, option.text);
    } else {
      set.add_text(name, option.value, take, option.text);
    }
  }
}

void take_columns(const std::string& text, std::vector<std::string>& columns) {
  for (const std::string& word : words_between_commas(text, "--columns")) {
    const std::string figure = figure_meant(word, "--columns");
    if (std::find(columns.begin(), columns.end(), figure) != columns.end()) {
      throw core::UsageError("--columns=" + text + ": " + figure + " is there twice");
    }
    columns.push_back(figure);
  }
}

void add_sweep_options(OptionSet& set, SweepSettings& settings) {
  set.add_argument(
      "SCENE", [&settings](const std::string& text) { settings.scene = text; }, "A scene, as dmpc render takes it");
  set.add_texts(
      "--vary", "OPTION:VALUE,VALUE,...",
      [&settings](const std::string& text) { settings.variations.push_back(parse_variation(text)); },
      "An option of dmpc render and its values, of a flag on and off; given several times, all combinations are run");
  set.add_text(
      "--columns", "FIGURE,FIGURE,... [times and traffic]",
      [&settings](const std::string& text) { take_columns(text, settings.columns); },
      "What the table tells of each run, by the keys of --stats: pages.faults, or faults where there is no other");
  set.add_path("--runs", "FOLDER [none]", settings.kept,
               "Keep the counters of each run there, and the databases of large scenes, and do nothing twice: who was stopped "
               "goes on, who "
               "asks for more adds to it");
}

/// Runs last: flags become words, too, and something must vary.
void finish(StudySweepOptions& options) {
  for (const auto& [name, is_on] : options.flags) {
    if (is_on) {
      options.settings.fixed.push_back(name);
    }
  }
  if (options.settings.variations.empty()) {
    throw core::UsageError("there is nothing to vary: expected an option with its values, such as --vary=nodes:8,64");
  }
  for (const VariedOption& variation : options.settings.variations) {
    const std::vector<std::string>& columns = options.settings.columns;
    if (std::find(columns.begin(), columns.end(), variation.option.substr(2)) != columns.end()) {
      throw core::UsageError("--columns=" + variation.option.substr(2) + ": it varies, and so has a column of its own");
    }
  }
}

}  // namespace

void add_options(OptionSet set, StudySweepOptions& options) {
  add_sweep_options(set, options.settings);
  add_options(set, options.table, TableExtras::plots_and_report);
  set.add_quiet(options.quiet);
  set.begin_group("Of all runs");
  add_render_options(set, options);
  set.check_in_the_end([&options] { finish(options); });
  set.set_examples(
      "Examples:\n"
      "  dmpc study sweep rings-3-t1 --runner=virtual --vary=nodes:8,64 --vary=page-size:1KiB,4KiB\n"
      "  dmpc study sweep teapot-12 --nodes=16 --vary=strategy:svm,dataflow,forest --columns=packets.bytes,seconds.render\n"
      "  dmpc study sweep rings-4-t1 --runner=virtual --vary=cache-pages:16,64,256 --columns=faults,virtual_seconds \\\n"
      "      --runs=rings.runs --format=jsonl -o rings.jsonl\n"
      "Modelled machines run side by side, threads one after the other. Values that have commas have\n"
      "semicolons between: --vary='background:0,0,0;1,1,1'.");
}

int study_sweep_command(const StudySweepOptions& options, Interrupt& interrupt, std::ostream& output) {
  const std::vector<SweepRun> runs = sweep_runs(options.settings);
  const TableFiles files = files_of(options, runs);
  const OpenedFiles scene = scene_files(options.settings, runs.front());
  check_not_read(scene, files.names());
  ShownRows shown(shows_rows(options.table, options.quiet), std::cerr);
  std::vector<SweepResult> results;
  std::optional<html::ForecastView> forecast;
  const auto measure = [&] {
    Progress progress(std::cerr, stderr_is_terminal() && !options.quiet, "sweep: ", "runs");
    progress.update(0, runs.size());
    measure_sweep(options.settings, runs, scene, interrupt, [&](SweepResult result) {
      results.push_back(std::move(result));
      shown.show(sweep_table(options.settings, runs, results), options.settings.variations.size());
      progress.update(results.size(), runs.size());
    });
    if (options.table.report) {
      forecast = sweep_forecast(options.settings, results, interrupt);
    }
  };
  const int status = run_tabled(
      {.measure = measure, .has_findings = [&] { return !results.empty(); }},
      [&](bool is_whole) { return result_of(options, runs, results, forecast, is_whole); }, files, interrupt, output);
  check_any_fits(results);
  return status;
}

}  // namespace dmpc::apps
