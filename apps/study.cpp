#include "apps/study.h"

#include <iostream>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/distinct_files.h"
#include "apps/load_scene.h"
#include "apps/machines.h"
#include "apps/output_file.h"
#include "apps/plot_program.h"
#include "apps/progress.h"
#include "apps/stats.h"
#include "apps/study_runs.h"
#include "apps/subject.h"
#include "core/scenes.h"

namespace dmpc::apps {
namespace {

void check_output(const StudyOptions& options) {
  if (!options.output) {
    return;
  }
  std::vector<NamedFile> inputs;
  if (!core::find_scene_name(options.picture.scene)) {
    inputs.push_back({"SCENE", options.picture.scene});
  }
  if (!options.machine_name.empty() && find_machine_preset(options.machine_name) == nullptr) {
    inputs.push_back({"--machine", options.machine_name});
  }
  check_distinct(inputs, {{"-o", *options.output}});
  check_output_path(*options.output, "-o");
}

void make_plot_folder(const StudyOptions& options) {
  if (options.plots) {
    make_output_folder(*options.plots, "--plots");
  }
}

/// A signal ends the process here and now.
Subject load(const StudyOptions& options, Interrupt& interrupt) {
  const Interrupt::EndAtOnce end_at_once(interrupt);
  return build_subject(load_scene(options.picture), options.picture, options.database);
}

std::string title_of(const std::string& study, const StudyOptions& options, const Subject& subject) {
  const PictureOptions& picture = options.picture;
  const core::Camera& camera = subject.settings.camera;
  return "Study " + study + " of " + picture.scene + ": " + std::to_string(camera.width()) + "x" +
         std::to_string(camera.height()) + " pixels, " + std::to_string(picture.samples) +
         (picture.samples == 1 ? " sample" : " samples") + " a pixel, depth " + std::to_string(picture.depth) + ", convention " +
         (picture.convention == core::Convention::haines ? "haines" : "paper") + ", grid axes " + name_of(options.database.axes) +
         ", record order " + name_of(options.database.record_order) + ", " +
         std::to_string(subject.database.header().primitive_count) + " primitives";
}

std::string film_note(const StudyRuns& runs) {
  if (!runs.film_hash()) {
    return "No picture was rendered.";
  }
  return "Film of every run, " + std::to_string(runs.count()) + " in all: " + hash_text(*runs.film_hash()) + ".";
}

/// Complaints go to stderr: a picture is an extra.
void draw_plots(const Table& table, const std::vector<Plot>& plots, const std::filesystem::path& folder) {
  const std::string data_file = "study.csv";
  OutputFile file(folder / data_file);
  file.write(text_of(table, TableFormat::csv));
  file.commit();
  std::set<std::string> complaints;
  for (const Plot& plot : plots) {
    const auto outcome = draw(plot, table, folder, data_file);
    if (outcome && !outcome->is_drawn && complaints.insert(sentence_on(*outcome)).second) {
      std::cerr << "dmpc: " << sentence_on(*outcome) << std::endl;
    }
  }
}

void write(Table& table, const std::vector<Plot>& plots, const StudyRuns& runs, const StudyOptions& options,
           std::ostream& output) {
  table.add_note(film_note(runs));
  if (options.plots) {
    draw_plots(table, plots, *options.plots);
  }
  const std::string text = text_of(table, options.format);
  if (options.output) {
    OutputFile file(*options.output);
    file.write(text);
    file.commit();
  } else {
    output << text;
    finish_output(output, "the table");
  }
}

template <class OneStudy>
Table empty_table(const OneStudy& study, const StudyOptions& options, const Subject& subject) {
  Table table(title_of(OneStudy::name, options, subject), study.columns());
  for (std::string& note : study.notes(options.picture.scene)) {
    table.add_note(std::move(note));
  }
  return table;
}

template <class OneStudy>
void carry_out(const OneStudy& study, const StudyOptions& options, Interrupt& interrupt, std::ostream& output) {
  const Subject subject = load(options, interrupt);
  Table table = empty_table(study, options, subject);
  StudyRuns runs(subject.database, subject.settings, {std::cerr, stderr_is_terminal(), study.run_count()}, interrupt);
  try {
    study.measure(runs, table);
    interrupt.set_consequence(options.output ? "nothing was written" : "the table is incomplete");
    const Interrupt::EndAtOnce end_at_once(interrupt);
    write(table, study.plots(), runs, options, output);
  } catch (const Interrupted&) {
    if (!table.rows().empty()) {
      interrupt.set_consequence("the table has the rows finished before");
      table.add_note("Interrupted: rows are missing.");
      write(table, study.plots(), runs, options, output);
    }
    throw;
  }
}

}  // namespace

int study_command(const StudyOptions& options, Interrupt& interrupt, std::ostream& output) {
  check_output(options);
  make_plot_folder(options);
  std::visit([&](const auto& study) { carry_out(study, options, interrupt, output); }, options.study);
  return 0;
}

}  // namespace dmpc::apps
