#include "apps/lab/study/python/sweep.h"

#include <algorithm>
#include <ostream>
#include <string_view>
#include <utility>

#include "apps/database/database_file.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/system/output_file.h"
#include "apps/frontend/system/python_program.h"
#include "apps/frontend/table/table_files.h"
#include "apps/lab/study/python/python_study.h"
#include "apps/scene/load_scene.h"
#include "apps/show/stats/schema.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

using Runs = std::vector<SweepRun>;

/// Declares the options of `render`, as words to be passed on.
void add_render_options(OptionSet& set, SweepStudy& study) {
  std::string group = sweepable_options().front().group;
  for (const OptionDescription& option : sweepable_options()) {
    if (option.group != group) {
      group = option.group;
      set.begin_group(group);
    }
    const std::string name = option.names.back();
    if (option.value.empty()) {
      set.add_flag(name, study.is_set, option.text);
    } else if (option.is_repeatable) {
      set.add_texts(name, option.value, passed_on, option.text);
    } else {
      set.add_text(name, option.value, passed_on, option.text);
    }
  }
}

void add_sweep_options(OptionSet& set, SweepStudy& study) {
  set.add_argument(
      "SCENE", [&study](const std::string& text) { study.scene = text; }, "A scene, as dmpc render takes it");
  set.add_texts(
      "--vary", "OPTION:VALUE,VALUE,...",
      [&study](const std::string& text) { study.variations.push_back(parse_variation(text)); },
      "An option of dmpc render and its values, of a flag on and off; given several times, all combinations are run");
  set.add_text(
      "--columns", "FIGURE,FIGURE,... [times and traffic]",
      [](const std::string& text) { words_between_commas(text, "--columns"); },
      "What the table tells of each run, by the keys of --stats: pages.faults, or faults where there is no other");
  set.add_path("--runs", "FOLDER [none]", study.kept,
               "Keep the counters of each run there, and the databases of large scenes, and do nothing twice: who was stopped "
               "goes on, who asks for more adds to it");
  add_options(set, study.table, TableExtras::none);
  add_report_option(set, study.table.report, "with the table and its plots");
  set.add_path("--plots", "FOLDER", study.table.plots, "Write plots by Python's matplotlib to this folder, with their data");
  set.add_quiet(study.quiet);
}

/// Runs last: something must vary.
void finish(const OptionSet& set, SweepStudy& study) {
  if (study.variations.empty()) {
    throw core::UsageError("there is nothing to vary: expected an option with its values, such as --vary=nodes:8,64");
  }
  const auto name_of = [](const OptionDescription& option) { return option.names.back(); };
  study.words = set.given_words(core::mapped<std::string>(sweepable_options(), name_of));
  study.fixed = set.given_words({});
  std::erase_if(study.fixed, [&](const std::string& word) { return std::ranges::count(study.words, word) > 0; });
}

bool any(const Runs& runs, bool (*holds)(const RenderOptions&)) {
  return std::any_of(runs.begin(), runs.end(), [&](const SweepRun& run) { return holds(run.options); });
}

/// Their cost is wall clock time, so nothing else should run beside them.
bool are_timed_by_the_wall(const Runs& runs) {
  return any(runs, [](const RenderOptions& run) { return run.runner.kind != RunnerKind::virtual_time; });
}

/// Returns the figures that are useful for the runners and strategies of the runs.
std::vector<std::string> usual_columns(const Runs& runs) {
  const bool are_modelled = any(runs, [](const RenderOptions& run) { return run.runner.kind == RunnerKind::virtual_time; });
  std::vector<std::string> columns;
  for (const auto& [column, is_of_use] :
       {std::pair("virtual_seconds.total", are_modelled),
        {"seconds.render", are_timed_by_the_wall(runs)},
        {"rays.total", true},
        {"packets.sent", true},
        {"packets.bytes", true},
        {"pages.faults", any(runs, [](const RenderOptions& run) { return run.strategy == Strategy::svm; })},
        {"questions.rays_asked", any(runs, [](const RenderOptions& run) { return run.strategy == Strategy::forest; })},
        {"travel.messages_per_ray", any(runs, [](const RenderOptions& run) { return run.strategy == Strategy::dataflow; })}}) {
    if (is_of_use) {
      columns.emplace_back(column);
    }
  }
  return columns;
}

/// Returns a digest of the files from which the scene is read, none of which may be an output.
std::uint64_t checked_source(const SweepStudy& study, const Runs& runs) {
  std::vector<NamedFile> named;
  add_scene_file(study.scene, named);
  const TableFiles files(study.table, {}, {.inputs = named});
  OpenedFiles opened;
  if (!named.empty()) {
    load_scene(runs.front().options.picture, LoadNotes::silent, &opened);
  }
  check_not_read(opened, files.names());
  return source_of(opened);
}

/// Returns the path, for Python, of a nameless file: the schema of --stats, and for each run, with a 0 behind
/// each text and two behind all, what varies, its database's name ("-": none is kept) and words, and its line.
std::string plan_of(const Runs& runs, std::uint64_t source, bool keeps_databases) {
  std::string plan = stats_schema();
  for (const SweepRun& run : runs) {
    const SweepDatabase database = keeps_databases ? database_of(run, source) : SweepDatabase{"-", {}};
    plan += std::string(2, '\0') + run.varied + '\0' + database.name;
    for (const std::vector<std::string>* const words : {&database.words, &run.words}) {
      for (const std::string& word : *words) {
        plan += '\0' + word;
      }
    }
  }
  return file_for_python(plan);
}

}  // namespace

void add_options(OptionSet set, SweepStudy& study) {
  add_sweep_options(set, study);
  set.begin_group("Of all runs");
  add_render_options(set, study);
  set.check_in_the_end([set, &study] { finish(set, study); });
  set.set_examples(
      "Examples:\n"
      "  dmpc study sweep rings-3-t1 --runner=virtual --vary=nodes:8,64 --vary=page-size:1KiB,4KiB\n"
      "  dmpc study sweep teapot-12 --nodes=16 --vary=strategy:svm,dataflow,forest --columns=packets.bytes,seconds.render\n"
      "  dmpc study sweep rings-4-t1 --runner=virtual --vary=cache-pages:16,64,256 --columns=faults,virtual_seconds \\\n"
      "      --runs=rings.runs --format=jsonl -o rings.jsonl\n"
      "Modelled machines run side by side, threads one after the other. Values that have commas have\n"
      "semicolons between: --vary='background:0,0,0;1,1,1'.");
}

int study_sweep_command(const SweepStudy& study, std::ostream& output) {
  const Runs runs = sweep_runs(study);
  const std::uint64_t source = checked_source(study, runs);
  if (study.kept) {
    make_output_folder(*study.kept, "--runs");
  }
  std::vector<std::string> words = {
      "--plan=" + plan_of(runs, source, study.kept.has_value()), "--source=" + hash_text(source),
      "--usual=" + joined(usual_columns(runs), ","),
      "--title=Study sweep of " + study.scene + (study.fixed.empty() ? "" : ": ") + joined(study.fixed, " ")};
  if (are_timed_by_the_wall(runs)) {
    words.emplace_back("--timed");
  }
  words.insert(words.end(), study.words.begin(), study.words.end());
  words.push_back(study.scene);
  output.flush();
  become_python("sweeps.command", "study sweep", words);
}

}  // namespace dmpc::apps
