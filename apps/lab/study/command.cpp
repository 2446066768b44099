#include "apps/lab/study/command.h"

#include <exception>
#include <iostream>
#include <optional>
#include <ostream>
#include <utility>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/machine/machines.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/table/shown_rows.h"
#include "apps/frontend/table/table_files.h"
#include "apps/lab/study/engine/tabled_job.h"
#include "apps/render/picture_identity.h"
#include "apps/run/render_record.h"
#include "apps/run/strategy_options.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"

namespace dmpc::apps {
namespace {

constexpr const char* data_file = "cache.csv";

TableFiles files_of(const StudyOptions& options) {
  std::vector<NamedFile> inputs;
  add_scene_file(options.picture, inputs);
  if (!options.machine_name.empty() && find_machine_preset(options.machine_name) == nullptr) {
    inputs.push_back({"--machine", options.machine_name});
  }
  return {options.table, {names_of(data_file, options.study.plots())}, {.inputs = std::move(inputs)}};
}

/// The subject, and the digest of its scene for a page.
struct Loaded {
  Subject subject;
  std::optional<std::uint64_t> scene_digest;
};

/// Here a signal ends the process at once.
Loaded load(const StudyOptions& options, const TableFiles& files, Interrupt& interrupt) {
  const Interrupt::EndAtOnce end_at_once(interrupt);
  OpenedFiles opened;
  core::Scene scene = load_scene(options.picture, LoadNotes::said, &opened);
  check_not_read(opened, files.names());
  const auto digest = options.table.report ? std::optional(scene_digest(scene)) : std::nullopt;
  return {build_subject(std::move(scene), options.picture, options.database, true), digest};
}

std::string samples_text(const PictureOptions& picture) {
  const std::string text = picture.is_refined
                               ? "samples refined to an error of " + fixed(255 * picture.refinement.error, 3) + "/255"
                               : std::to_string(picture.samples) + (picture.samples == 1 ? " sample" : " samples") + " a pixel";
  return picture.cutoff > 0 ? text + ", cutoff " + fixed(255 * picture.cutoff, 3) + "/255" : text;
}

/// Returns "depth 5", or the settings of paths.
std::string light_text(const PictureOptions& picture) {
  return picture.transport.is_by_paths() ? text_of(picture.transport) : "depth " + std::to_string(picture.depth);
}

/// Returns "structure extents, " or "structure voxels (article), ", nothing for the grid.
std::string structure_text(const core::BuildOptions& build) {
  using core::Structure;
  const std::string rule = build.structure == Structure::voxels ? " (" + text_of(build.voxels) + ")" : "";
  return build.structure == Structure::grid ? "" : std::string("structure ") + name_of(build.structure) + rule + ", ";
}

std::string title_of(const StudyOptions& options, const Subject& subject) {
  const PictureOptions& picture = options.picture;
  const core::Camera& camera = subject.settings.camera;
  return "Study cache of " + picture.scene + ": " + std::to_string(camera.width()) + "x" + std::to_string(camera.height()) +
         " pixels, " + samples_text(picture) + ", " + light_text(picture) + ", convention " +
         (picture.convention == core::Convention::haines ? "haines" : "paper") + ", record order " +
         name_of(options.database.build.record_order) + ", " + structure_text(options.database.build) +
         counted(subject.database.header().primitive_count, "primitive");
}

/// Adds what the machine lacks prices for, and the film.
void add_last_notes(const CacheStudy& study, const CacheRuns& runs, Table& table) {
  const std::string note = study.machine ? price_note(*study.machine, runs.database.structure()) : "";
  if (!note.empty()) {
    table.add_note(note + ".");
  }
  table.add_note(runs.film_hash
                     ? "Film of every run, " + std::to_string(runs.count) + " in all: " + hash_text(*runs.film_hash) + "."
                     : "No picture was rendered.");
}

TableResult result_of(const Table& table, const std::optional<std::uint64_t>& scene_digest,
                      const std::optional<std::uint64_t>& film_hash, const StudyOptions& options) {
  return study_result({.title = "Study cache of " + options.picture.scene,
                       .table = table,
                       .data_file = data_file,
                       .plots = options.study.plots(),
                       .conclusion = options.study.conclusion(table),
                       .facts = film_hash ? html::Facts{{"film", hash_text(*film_hash)}} : html::Facts{},
                       .scene_digest = scene_digest},
                      options.table.format);
}

/// If the study ends early, the table has the finished rows, and a note that others are missing.
void measure(const CacheStudy& study, CacheRuns& runs, Table& table) {
  try {
    study.measure(runs, table);
  } catch (const Interrupted&) {
    table.add_note("Interrupted: rows are missing.");
    throw;
  } catch (const std::exception&) {
    table.add_note("Ended by an error: rows are missing.");
    throw;
  }
}

}  // namespace

void add_options(OptionSet set, StudyOptions& options) {
  options.study.add_options(set, options.machine_name);
  add_options(set, options.picture);
  add_transport_options(set, options.picture);
  add_options(set, options.database);
  add_options(set, options.table, TableExtras::plots_and_report);
  set.add_quiet(options.quiet);
}

int study_command(const StudyOptions& asked, Interrupt& interrupt, std::ostream& output) {
  StudyOptions options = asked;
  const TableFiles files = files_of(options);
  options.study.load([&interrupt] { interrupt.check(); });
  const auto [subject, digest] = load(options, files, interrupt);
  Table table(title_of(options, subject), options.study.columns());
  for (std::string& note : options.study.notes(options.picture.scene)) {
    table.add_note(std::move(note));
  }
  ShownRows shown(shows_rows(options.table, options.quiet), std::cerr);
  table.set_listener([&shown](const Table& rows) { shown.show(rows); });
  CacheRuns runs{subject.database, subject.settings, interrupt, stderr_is_terminal()};
  const auto write = [&](bool is_whole, Attempts& attempts) {
    add_last_notes(options.study, runs, table);
    std::optional<Interrupt::EndAtOnce> end_at_once;
    if (is_whole) {
      interrupt.set_consequence(options.table.file ? "nothing was written" : "the table is incomplete");
      end_at_once.emplace(interrupt);
    }
    files.write(result_of(table, digest, runs.film_hash, options), output, std::cerr, attempts);
  };
  return run_tabled({.measure = [&] { measure(options.study, runs, table); },
                     .has_findings = [&] { return !table.rows().empty(); },
                     .write = write},
                    interrupt);
}

}  // namespace dmpc::apps
