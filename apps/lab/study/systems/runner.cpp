#include "apps/lab/study/systems/runner.h"

#include <variant>

#include "apps/frontend/machine/drawn_machine.h"
#include "apps/frontend/table/filled_columns.h"
#include "apps/lab/study/engine/time_part_columns.h"
#include "apps/run/report.h"
#include "apps/run/run_strategy.h"

namespace dmpc::apps {
namespace {

double quotient(double part, double whole) { return whole == 0 ? 0 : part / whole; }

RunShares shares_of(const Account& account) {
  const auto percent = parts_of(account).percent();
  const auto share = [&](TimePart part) { return percent[static_cast<std::size_t>(part)] / 100; };
  return {share(TimePart::computing), share(TimePart::film_wait), share(TimePart::idle_at_end),
          account.virtual_time->host_busy_share()};
}

struct Figured {
  const Account& account;
  const MeasuredRun& run;

  double a_ray(std::uint64_t count) const {
    return quotient(static_cast<double>(count), static_cast<double>(account.operations.ray_count()));
  }
};

const FilledColumns<Figured>& figures() {
  static const FilledColumns<Figured> all = [] {
    FilledColumns<Figured> columns = {{{"virtual time", "s", 6}, [](const Figured& of) { return of.run.seconds; }}};
    add_time_parts(
        1, [](const Figured& of) { return std::optional(parts_of(of.account)); }, columns);
    columns.push_back({{"host busy", "%", 1}, [](const Figured& of) { return 100 * of.run.shares.host_busy; }});
    columns.push_back(
        {{"messages a ray", "", 3}, [](const Figured& of) { return of.a_ray(nodes::total(of.account.sent).packets); }});
    columns.push_back(
        {{"bytes a ray", "bytes", 1}, [](const Figured& of) { return of.a_ray(nodes::total(of.account.sent).bytes); }});
    return columns;
  }();
  return all;
}

double seconds_of(const Account& account) { return 1e-9 * static_cast<double>(account.virtual_time->total_ns); }

MeasuredRun measured_run(const Report& report) {
  const Account account = account_of(report);
  MeasuredRun run{.seconds = seconds_of(account),
                  .film_hash = account.film.hash(),
                  .memory_bytes = account.node_memory_max_bytes,
                  .shares = shares_of(account),
                  .figures = {}};
  if (const auto* const pages = std::get_if<svm::Report>(&report)) {
    run.in_flight = pages->plan.in_flight;
  } else {
    run.ray_batch = std::get<dataflow::Report>(report).plan.ray_batch;
  }
  run.figures = row_of(figures(), {account, run});
  return run;
}

Cell cell_or_none(const std::map<std::string, std::string>& texts, const char* option) {
  const auto found = texts.find(option);
  return found == texts.end() ? Cell() : Cell(found->second);
}

/// With what the run took where the setup leaves it open.
std::map<std::string, std::string> effective_options(const SystemSetup& setup, const std::optional<MeasuredRun>& run) {
  std::map<std::string, std::string> texts = option_texts(setup);
  const auto take = [&](const char* option, const std::optional<std::uint32_t>& number) {
    if (number && texts.contains(option)) {
      texts[option] = std::to_string(*number);
    }
  };
  if (run) {
    take("in-flight", run->in_flight);
    take("ray-batch", run->ray_batch);
  }
  return texts;
}

}  // namespace

std::vector<Column> figure_columns() { return heads_of(figures()); }

PictureSize SystemRunner::picture() const {
  const core::Camera& camera = runs_.settings().camera;
  return {camera.width(), camera.height(), camera.samples()};
}

StudyRun SystemRunner::rendered(const StructureAsked& asked) {
  if (asked.structure == core::Structure::grid && asked.page_size_bytes == runs_.database().page_size()) {
    return {{}, &runs_.database(), &runs_.settings()};
  }
  auto found = subjects_.find(asked);
  if (found == subjects_.end()) {
    core::BuildOptions build;
    build.structure = asked.structure;
    build.page_size_bytes = asked.page_size_bytes;
    build.voxels = asked.is_original ? core::article_voxels : core::usual_voxels;
    found = subjects_.emplace(asked, study_.build(build)).first;
  }
  return {{}, &found->second.database, &found->second.settings};
}

StudyRun SystemRunner::study_run(const SystemSetup& setup, std::optional<std::uint32_t> draw) {
  const MachineDescription& machine = priced_for(setup.asked.structure, study_.machine);
  StudyRun run = rendered(setup.asked);
  run.options = setup.options;
  choose_machine(run.options, draw ? drawn(machine, *draw) : machine.machine);
  return run;
}

std::vector<TimedSetup> SystemRunner::time(const std::vector<SystemSetup>& setups) {
  std::vector<StudyRun> wanted;
  for (const SystemSetup& setup : setups) {
    runs_.check();
    wanted.push_back(study_run(setup, std::nullopt));
  }
  std::vector<TimedSetup> timed(setups.size());
  try {
    runs_.run_side_by_side(wanted, [&](std::size_t i, const StudyOutcome& outcome) {
      timed[i].misfit = outcome.misfit;
      if (outcome.report) {
        timed[i].run = measured_run(*outcome.report);
      }
    });
  } catch (const NothingFits&) {
    // Other settings may fit, and rows without figures say that none does.
  }
  runs_.check();
  return timed;
}

std::vector<std::vector<double>> SystemRunner::time_draws(const std::vector<SystemSetup>& setups) {
  std::vector<StudyRun> wanted;
  for (std::uint32_t draw = 0; draw < study_.draws; ++draw) {
    for (const SystemSetup& setup : setups) {
      wanted.push_back(study_run(setup, draw));
    }
  }
  std::vector<std::vector<double>> seconds(study_.draws, std::vector<double>(setups.size()));
  runs_.run_side_by_side(wanted, [&](std::size_t i, const StudyOutcome& outcome) {
    seconds[i / setups.size()][i % setups.size()] = seconds_of(account_of(*outcome.report));
  });
  runs_.check();
  return seconds;
}

void SystemRunner::add_row(const char* table, const std::string& memory, const SystemSetup& setup, const TimedSetup& timed,
                           std::optional<std::uint32_t> ahead) {
  const std::map<std::string, std::string> options = effective_options(setup, timed.run);
  const std::optional<std::size_t> needed = timed.run ? std::optional(timed.run->memory_bytes) : std::nullopt;
  const std::optional<std::size_t> bytes =
      setup.options.computer.node_memory_bytes ? setup.options.computer.node_memory_bytes : needed;
  const double database_bytes = static_cast<double>(database(setup.asked).bytes().size());
  std::vector<Cell> row = {table,
                           memory,
                           std::uint64_t{setup.options.computer.node_count},
                           name_of(setup.system),
                           name_of(setup.asked.structure),
                           bytes ? Cell(std::uint64_t{*bytes}) : Cell(),
                           bytes ? Cell(100 * static_cast<double>(*bytes) / database_bytes) : Cell()};
  for (const char* const option : {"page-size", "in-flight", "work-donor", "resident", "backpressure", "ray-batch"}) {
    row.push_back(cell_or_none(options, option));
  }
  const std::string known = free_beforehand(setup.options);
  row.push_back(known.empty() ? Cell() : Cell(known));
  row.push_back(ahead ? Cell(std::uint64_t{*ahead}) : Cell());
  if (timed.run) {
    row.insert(row.end(), timed.run->figures.begin(), timed.run->figures.end());
  }
  row.resize(table_.columns().size());
  table_.add_row(std::move(row));
}

ComparedRow SystemRunner::compared(const SystemSetup& setup, const MeasuredRun& run, const std::string& search) const {
  ComparedRow row{setup.name(),
                  {study_.scene, study_.machine.machine.name, run.film_hash, setup.options.computer.node_count,
                   setup.options.computer.node_memory_bytes},
                  effective_options(setup, run),
                  search,
                  run.seconds};
  row.options["prices"] = priced_for(setup.asked.structure, study_.machine).machine.name;
  return row;
}

}  // namespace dmpc::apps
