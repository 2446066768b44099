#include "apps/lab/study/command.h"

#include <exception>
#include <iostream>
#include <optional>
#include <ostream>
#include <type_traits>
#include <utility>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/machine/machines.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/table/shown_rows.h"
#include "apps/frontend/table/table_files.h"
#include "apps/lab/study/engine/tabled_job.h"
#include "apps/lab/study/runs.h"
#include "apps/render/picture_identity.h"
#include "apps/run/render_record.h"
#include "apps/run/strategy_options.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "core/database/conversion.h"
#include "core/families/scenes.h"

namespace dmpc::apps {
namespace {

/// Returns the name of the pictures' data file in their folder.
std::string data_file_of(const std::string& study) { return study + ".csv"; }

TableFiles files_of(const StudyOptions& options) {
  std::vector<NamedFile> inputs;
  add_scene_file(options.picture, inputs);
  if (!options.machine_name.empty() && find_machine_preset(options.machine_name) == nullptr) {
    inputs.push_back({"--machine", options.machine_name});
  }
  const PlottedNames plotted =
      std::visit([](const auto& study) { return names_of(data_file_of(study.name), study.plots()); }, options.study);
  return {options.table, {plotted}, {.inputs = std::move(inputs)}};
}

/// The subject, and the digest of its scene for a page.
struct Loaded {
  Subject subject;
  std::optional<std::uint64_t> scene_digest;
  std::optional<core::Scene> scene;  ///< for a study that builds other databases from it
  core::View view;                   ///< the scene's own
  core::Box bounds;                  ///< in the world's coordinates
};

/// Here a signal ends the process at once.
Loaded load(const StudyOptions& options, const TableFiles& files, Interrupt& interrupt) {
  const Interrupt::EndAtOnce end_at_once(interrupt);
  OpenedFiles opened;
  core::Scene scene = load_scene(options.picture, LoadNotes::said, &opened);
  check_not_read(opened, files.names());
  const auto digest = options.table.report ? std::optional(scene_digest(scene)) : std::nullopt;
  const bool is_kept = std::holds_alternative<FramesStudy>(options.study);
  auto kept = is_kept ? std::optional(scene) : std::nullopt;
  const core::View view = scene.view;
  const core::Box bounds = core::bounds_of(scene, core::Parallel(0));
  return {build_subject(std::move(scene), options.picture, options.database, true), digest, std::move(kept), view, bounds};
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

std::string title_of(const std::string& study, const StudyOptions& options, const Subject& subject) {
  const PictureOptions& picture = options.picture;
  const core::Camera& camera = subject.settings.camera;
  return "Study " + study + " of " + picture.scene + ": " + std::to_string(camera.width()) + "x" +
         std::to_string(camera.height()) + " pixels, " + samples_text(picture) + ", " + light_text(picture) + ", convention " +
         (picture.convention == core::Convention::haines ? "haines" : "paper") + ", record order " +
         name_of(options.database.build.record_order) + ", " + structure_text(options.database.build) +
         counted(subject.database.header().primitive_count, "primitive");
}

std::string film_note(const StudyRuns& runs) {
  if (!runs.film_hash()) {
    return "No picture was rendered.";
  }
  return "Film of every run, " + std::to_string(runs.count()) + " in all: " + hash_text(*runs.film_hash()) + ".";
}

/// Identify another study of the same subject.
struct Marks {
  std::optional<std::uint64_t> scene_digest;
  std::optional<std::uint64_t> film_hash;
};

template <class OneStudy>
TableResult result_of(const OneStudy& study, const Table& table, const Marks& marks, const StudyOptions& options) {
  return study_result({.title = "Study " + std::string(OneStudy::name) + " of " + options.picture.scene,
                       .table = table,
                       .data_file = data_file_of(OneStudy::name),
                       .plots = study.plots(),
                       .conclusion = study.conclusion(table),
                       .facts = marks.film_hash ? html::Facts{{"film", hash_text(*marks.film_hash)}} : html::Facts{},
                       .scene_digest = marks.scene_digest},
                      options.table.format);
}

template <class OneStudy>
Table empty_table(const OneStudy& study, const StudyOptions& options, const Subject& subject) {
  Table table(title_of(OneStudy::name, options, subject), study.columns());
  for (std::string& note : study.notes(options.picture.scene)) {
    table.add_note(std::move(note));
  }
  return table;
}

/// If the study ends early, the table has the finished rows, and a note that others are missing.
template <class OneStudy>
void measure(const OneStudy& study, StudyRuns& runs, Table& table) {
  try {
    study.measure(runs, table);
  } catch (const Interrupted&) {
    table.add_note("Interrupted: rows are missing.");
    throw;
  } catch (const NothingFits&) {
    throw;
  } catch (const std::exception&) {
    table.add_note("Ended by an error: rows are missing.");
    throw;
  }
}

/// A study that also asks questions gets the scene from which to build their tree.
void give_scene(FramesStudy& study, const core::Scene& scene, const StudyOptions& options) {
  study.build_tree = [&scene, &options] {
    const core::BuildOptions usual = usual_database(Strategy::forest).build;
    DatabaseOptions tree = options.database;
    tree.build.structure = usual.structure;
    tree.build.record_order = usual.record_order;
    tree.build.page_size_bytes = usual.page_size_bytes;
    return build_subject_quietly(scene, options.picture, tree);
  };
}

/// Returns the exit status.
template <class OneStudy>
int carry_out(OneStudy study, const StudyOptions& options, const TableFiles& files, Interrupt& interrupt, std::ostream& output) {
  const auto check = [&interrupt] { interrupt.check(); };
  if constexpr (requires { study.load(check); }) {
    study.load(check);
  }
  const auto [subject, digest, scene, view, bounds] = load(options, files, interrupt);
  if constexpr (std::is_same_v<OneStudy, FramesStudy>) {
    give_scene(study, *scene, options);
    study.own_view = view;
    study.bounds = bounds;
  }
  Table table = empty_table(study, options, subject);
  ShownRows shown(shows_rows(options.table, options.quiet), std::cerr);
  table.set_listener([&shown](const Table& rows) { shown.show(rows); });
  StudyRuns runs(subject.database, subject.settings, {std::cerr, stderr_is_terminal()}, interrupt);
  const auto write = [&](bool is_whole, Attempts& attempts) {
    runs.add_price_notes(table);
    table.add_note(film_note(runs));
    std::optional<Interrupt::EndAtOnce> end_at_once;
    if (is_whole) {
      interrupt.set_consequence(options.table.file ? "nothing was written" : "the table is incomplete");
      end_at_once.emplace(interrupt);
    }
    files.write(result_of(study, table, {digest, runs.film_hash()}, options), output, std::cerr, attempts);
  };
  return run_tabled(
      {.measure = [&] { measure(study, runs, table); }, .has_findings = [&] { return !table.rows().empty(); }, .write = write},
      interrupt);
}

}  // namespace

void add_options(OptionSet set, StudyOptions& options) {
  std::visit([&](auto& study) { study.add_options({set, options.machine_name, options.database}); }, options.study);
  add_options(set, options.picture);
  add_transport_options(set, options.picture);
  add_options(set, options.database);
  add_options(set, options.table, TableExtras::plots_and_report);
  set.add_quiet(options.quiet);
}

int study_command(const StudyOptions& options, Interrupt& interrupt, std::ostream& output) {
  const TableFiles files = files_of(options);
  return std::visit([&](const auto& study) { return carry_out(study, options, files, interrupt, output); }, options.study);
}

}  // namespace dmpc::apps
