#include "apps/info/command.h"

#include <sys/resource.h>

#include <iostream>
#include <string>
#include <utility>

#include "apps/frontend/line/option_values.h"
#include "apps/frontend/system/output_file.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/system/stopwatch.h"
#include "apps/info/json.h"
#include "apps/info/record.h"
#include "apps/info/text.h"
#include "apps/run/instance_options.h"
#include "apps/run/strategy_options.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "svm/plan.h"

namespace dmpc::apps {

namespace {

std::uint64_t peak_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// Sets the options of a system that affect a forecast.
void settle(const OptionSet& options, InfoOptions& info) {
  StrategyOptions run;
  run.pages = info.pages;
  run.rays.balance = info.balance;
  settle_system(options, *info.system, run, info.database);
  settle_database(options, run.strategy, info.database);
  info.pages = run.pages;
  info.balance = run.strategy == Strategy::dataflow ? run.rays.balance : info.balance;
}

/// Forecasts from the subject alone, with progress on a terminal.
Forecast forecast_for(const InfoOptions& options, const Subject& subject) {
  Progress progress(std::cerr, !options.quiet && stderr_is_terminal(), "Cutting space:", "computers");
  return forecast(
      subject.database, subject.settings, options.node_counts, options.balance,
      [&](std::uint64_t done, std::uint64_t total) { progress.update(done, total); }, options.pages);
}

}  // namespace

void add_options(OptionSet options, InfoOptions& info) {
  add_options(options, info.picture);
  add_transport_options(options, info.picture);
  add_options(options, info.database);
  add_instance_option(options, info.database);
  options.begin_group("The forecast");
  options.add_text(
      "--nodes", "N,N,... [1,2,4,...,256]",
      [&info](const std::string& text) { info.node_counts = parse_different_numbers(text, "--nodes", nodes::node_count_max); },
      "Numbers of nodes for which memory is forecast");
  add_system_option(options, info.system);
  add_option(options, core::field_of<&svm::PageOptions::homes>(), info.pages);
  add_balance_options(options, info.balance);
  options.add_choice<InfoFormat>("--format", info.format, {{"text", InfoFormat::text}, {"json", InfoFormat::json}},
                                 "Text with tables, or a JSON object with stable keys");
  options.add_quiet(info.quiet);
  options.check_in_the_end([options, &info] {
    info.picture.is_one_path_unasked = false;  // nothing is rendered
    if (info.system) {
      settle(options, info);
    }
    settle_instances(options, {info.system}, info.database, info.picture.scene_setup.mesh);
    check_voxels(options, info.database.build);
    check_regions(options, info.balance);
  });
  options.set_examples(
      "Examples:\n"
      "  dmpc info rings-4-t1\n"
      "  dmpc info tetra-9 --system=pixel-machine\n"
      "  dmpc info model.glb --nodes=8,64 --page-size=4KiB\n"
      "  dmpc info grove-10 --instances=keep --nodes=64\n"
      "  dmpc info balls-4 --transport=paths --light-radius=0.5\n"
      "  dmpc info tetra-9 --nodes=16 --balance=subsampled --format=json > tetra.json\n"
      "Nothing is rendered, except that --balance=subsampled and moving need the regions that render would make: that takes as\n"
      "long as the picture of every 8x8th pixel.");
}

InfoRecord find_out(const InfoOptions& options) {
  InfoRecord record;
  record.system = options.system;
  Stopwatch stopwatch;
  core::Scene scene = load_scene(options.picture, options.quiet ? LoadNotes::silent : LoadNotes::said);
  record.load_seconds = stopwatch.lap();
  record.scene = figures_of(scene);
  stopwatch.lap();
  Subject subject = build_subject(std::move(scene), options.picture, options.database, true);
  record.build_seconds = stopwatch.lap();
  record.build_peak_bytes = peak_bytes();
  subject.database.forget_primitives();
  record.database = figures_of(subject.database, record.scene);
  record.loss = subject.loss;
  record.width = subject.settings.camera.width();
  record.height = subject.settings.camera.height();
  record.room = available_memory();
  record.forecast = forecast_for(options, subject);
  return record;
}

int info_command(const InfoOptions& options, Interrupt& interrupt, std::ostream& output) {
  const Interrupt::EndAtOnce end_at_once(interrupt);
  const InfoRecord record = find_out(options);
  output << (options.format == InfoFormat::json ? info_json(record) : info_text(record));
  finish_output(output, "the forecast");
  return 0;
}

}  // namespace dmpc::apps
