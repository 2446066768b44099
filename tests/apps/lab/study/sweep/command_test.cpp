#include "apps/lab/study/sweep/command.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "apps/frontend/show/page/escaped.h"
#include "apps/lab/study/sweep/kept_runs.h"
#include "apps/lab/study/sweep/table.h"
#include "apps/main/commands.h"
#include "apps/show/page/forecast_view.h"
#include "core/base/expect.h"
#include "tests/support/complaint.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::sweep_command_test {

using apps::StudySweepOptions;
using Words = std::vector<std::string>;

namespace {

StudySweepOptions sweep_options(Words words) {
  words.insert(words.begin(), {"study", "sweep"});
  StudySweepOptions options = apps::parse_command_line(words).options<StudySweepOptions>();
  options.settings.program = DMPC_PROGRAM;
  return options;
}

StudySweepOptions tiny_sweep(const Words& more) {
  Words words = {"balls-1", "--resolution=8x8", "--runner=virtual", "--format=csv"};
  words.insert(words.end(), more.begin(), more.end());
  return sweep_options(words);
}

std::string swept(const StudySweepOptions& options) {
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK(apps::study_sweep_command(options, interrupt, output) == 0);
  return output.str();
}

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

/// A program that notes that it is called, and does what dmpc does.
std::filesystem::path counting_program(const TemporaryFolder& folder) {
  const std::filesystem::path path = folder / "counting";
  write_text(path, "#!/bin/sh\necho called >> '" + (folder / "calls").string() + "'\nexec " DMPC_PROGRAM " \"$@\"\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

std::string sweep_complaint(const Words& words) {
  return complaint_of<std::exception>([&] { swept(tiny_sweep(words)); });
}

}  // namespace

TEST_CASE("a sweep renders every combination and tells the figures asked for, alike when it is repeated") {
  const StudySweepOptions options =
      tiny_sweep({"--vary=nodes:1,3", "--vary=page-size:1KiB,4KiB", "--columns=faults,virtual_seconds"});
  const std::string table = swept(options);
  CHECK(table.starts_with("nodes,page-size (bytes),pages.faults,virtual_seconds.total (s)\n1,1024,0,"));
  CHECK(count(table, "\n") == 5);
  CHECK(swept(options) == table);
}

TEST_CASE("a sweep draws what it varies, with commas in names, too, in a folder and on a page") {
  const TemporaryFolder folder;
  StudySweepOptions options =
      tiny_sweep({"--vary=nodes:1,3", "--vary=strategy:svm,dataflow", "--columns=faults,virtual_seconds",
                  "--plots=" + (folder / "plots").string(), "--report=" + (folder / "page.html").string()});
  swept(options);
  const auto plots = apps::sweep_plots(options.settings, apps::sweep_runs(options.settings));
  REQUIRE(plots.size() == 2);
  for (const apps::Plot& plot : plots) {
    CHECK(file_text(folder / "plots" / (plot.name + ".json")).size() > 100);
    CHECK(contains(file_text(folder / "page.html"), "Plot: " + apps::html::escaped(plot.title)));
  }
}

TEST_CASE("the page of a sweep over caches alone has all its runs beside what one of them predicts") {
  const TemporaryFolder folder;
  const std::string page = folder / "page.html";
  const auto shown = [&](const Words& more) {
    Words words = {"balls-2", "--resolution=16x16", "--format=csv", "--page-size=512", "--report=" + page};
    words.insert(words.end(), more.begin(), more.end());
    swept(sweep_options(words));
    return apps::html::forecast_in(file_text(page), page);
  };
  const auto forecast = shown({"--runner=virtual", "--vary=cache-pages:4,2,1", "--vary=nodes:4"});
  REQUIRE(forecast.has_value());
  CHECK(forecast->cache_pages == 2);
  REQUIRE(forecast->runs.size() == 3);
  CHECK(forecast->runs[0].cache_pages == 4);
  CHECK(forecast->runs[0].total_ns < forecast->runs[2].total_ns);
  CHECK_FALSE(shown({"--runner=virtual", "--vary=cache-pages:1,2", "--vary=nodes:2,4"}).has_value());
  CHECK_FALSE(shown({"--runner=virtual", "--vary=nodes:2,4"}).has_value());
  CHECK_FALSE(shown({"--vary=cache-pages:1,2", "--nodes=2"}).has_value());
}

TEST_CASE("rows come as JSON lines, each an object of its own") {
  StudySweepOptions options = tiny_sweep({"--vary=nodes:1,3", "--columns=faults"});
  options.table.format = apps::TableFormat::json_lines;
  const std::string lines = swept(options);
  CHECK(lines.starts_with("{\"nodes\":1,\"pages.faults\":0}\n{\"nodes\":3,\"pages.faults\":"));
  CHECK(count(lines, "\n") == 2);
}

TEST_CASE("runs that are kept are not run again, and a larger sweep adds its own") {
  const TemporaryFolder folder;
  const std::string runs = "--runs=" + (folder / "runs").string();
  StudySweepOptions options = tiny_sweep({"--vary=nodes:1,3", runs});
  options.settings.program = counting_program(folder);
  const std::string table = swept(options);
  CHECK(count(file_text(folder / "calls"), "called") == 2);
  CHECK(swept(options) == table);
  CHECK(count(file_text(folder / "calls"), "called") == 2);
  StudySweepOptions larger = tiny_sweep({"--vary=nodes:1,2,3", runs});
  larger.settings.program = options.settings.program;
  swept(larger);
  CHECK(count(file_text(folder / "calls"), "called") == 3);
  CHECK(files_in(folder / "runs") == 3);
}

TEST_CASE("databases of large scenes are kept beside the counters, one for all runs that need it") {
  const TemporaryFolder folder;
  const Words words = {"--vary=page-size:1KiB,4KiB", "--vary=nodes:1,3", "--columns=faults,run_hash"};
  const std::string table = swept(tiny_sweep(words));
  const auto databases = [&] {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "runs")) {
      if (entry.path().extension() == ".pages") {
        found.push_back(entry.path());
      }
    }
    return found;
  };
  const auto keeping = [&](Words line) {
    line.push_back("--runs=" + (folder / "runs").string());
    StudySweepOptions options = tiny_sweep(line);
    options.settings.kept_database_bytes_min = 0;
    return swept(options);
  };
  CHECK(keeping(words) == table);
  CHECK(databases().size() == 2);
  const std::filesystem::path one = databases().front();
  const auto written = std::filesystem::last_write_time(one);
  keeping({"--vary=page-size:1KiB,4KiB", "--vary=nodes:2"});
  CHECK(databases().size() == 2);
  CHECK(std::filesystem::last_write_time(one) == written);
  write_text(one, "no database");
  keeping({"--vary=page-size:1KiB,4KiB", "--vary=nodes:4"});
  CHECK(databases().size() == 2);
  CHECK(file_text(one) != "no database");
}

TEST_CASE("counters that are kept are another run's where the program, an option or a file it reads is another") {
  const TemporaryFolder folder;
  write_text(folder / "a.nff",
             "v\nfrom 0 0 9\nat 0 0 0\nup 0 1 0\nangle 45\nhither 1\nresolution 8 8\nl 1 2 9\nf 1 0 0 1 0 0 0 0\n"
             "s 0 0 0 1\n");
  const std::string scene = folder / "a.nff";
  const auto key = [&](const Words& fixed, const std::filesystem::path& program) {
    apps::SweepSettings settings{
        .scene = scene, .fixed = fixed, .variations = {apps::parse_variation("nodes:2")}, .program = program};
    const auto runs = apps::sweep_runs(settings);
    return apps::KeptRuns(folder / "runs", program, apps::scene_files(settings, runs.front())).file_of(runs.front());
  };
  const auto plain = key({"--depth=2", "--samples=1"}, "/bin/true");
  CHECK(key({"--samples=1", "--depth=2"}, "/bin/true") == plain);
  CHECK(key({"--depth=3", "--samples=1"}, "/bin/true") != plain);
  CHECK(key({"--depth=2", "--samples=1"}, "/bin/false") != plain);
  write_text(folder / "a.nff", file_text(folder / "a.nff") + "s 1 0 0 1\n");
  CHECK(key({"--depth=2", "--samples=1"}, "/bin/true") != plain);
}

TEST_CASE("a damaged file among those that are kept is run again") {
  const TemporaryFolder folder;
  const StudySweepOptions options = tiny_sweep({"--vary=nodes:2", "--runs=" + (folder / "runs").string()});
  const std::string table = swept(options);
  for (const auto& entry : std::filesystem::directory_iterator(folder / "runs")) {
    write_text(entry.path(), "{\"format\": 1, ");
  }
  CHECK(swept(options) == table);
}

TEST_CASE("what is kept is taken only if it is an ordinary file of counters with the figures asked for") {
  const TemporaryFolder folder;
  const StudySweepOptions options =
      tiny_sweep({"--vary=nodes:2", "--columns=faults,packets.bytes", "--runs=" + (folder / "runs").string()});
  const std::string table = swept(options);
  const std::filesystem::path entry = std::filesystem::directory_iterator(folder / "runs")->path(), victim = folder / "victim";
  const std::string whole = file_text(entry);
  const auto is_whole = [&] { return contains(file_text(entry), "\"film_hash\""); };
  write_text(entry, "{\"format\": 1, \"packets\": {\"bytes\": 7}}");
  CHECK(swept(options) == table);
  CHECK(is_whole());
  for (const std::string& text : {std::string("mine"), whole}) {
    write_text(victim, text);
    std::filesystem::remove(entry);
    std::filesystem::create_symlink(victim, entry);
    CHECK(swept(options) == table);
    CHECK(file_text(victim) == text);
    CHECK_FALSE(std::filesystem::is_symlink(entry));
  }
  std::filesystem::remove(entry);
  REQUIRE(::mkfifo(entry.c_str(), 0600) == 0);
  CHECK(swept(options) == table);
  std::filesystem::resize_file(entry, std::uintmax_t{3} << 30U);
  CHECK(swept(options) == table);
  CHECK(is_whole());
}

TEST_CASE("a combination without room has an empty row, and where none has room that is the error") {
  const std::string table = swept(tiny_sweep({"--vary=node-memory:1KiB,4MiB", "--nodes=2", "--columns=faults"}));
  CHECK(contains(table, "\n1024,\n4194304,"));
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK_THROWS_AS(apps::study_sweep_command(tiny_sweep({"--vary=node-memory:1KiB,2KiB", "--nodes=2"}), interrupt, output),
                  core::CapacityError);
}

TEST_CASE("what goes wrong is told before anything runs, with what was meant") {
  CHECK(contains(sweep_complaint({}), "there is nothing to vary"));
  CHECK(contains(sweep_complaint({"--vary=node:2"}), "Did you mean nodes?"));
  CHECK(contains(sweep_complaint({"--vary=nodes:2", "--columns=fautls"}), "Did you mean faults?"));
  CHECK(contains(sweep_complaint({"--vary=nodes:2", "--columns=faults,pages.faults"}), "there twice"));
  CHECK(contains(sweep_complaint({"--vary=runner:virtual", "--columns=runner"}), "has a column of its own"));
  CHECK(contains(sweep_complaint({"--vary=nodes:x"}), "with --nodes=x dmpc render would say: --nodes=x: expected"));
  CHECK(contains(sweep_complaint({"--vary=nodes:2", "--nodes=2"}), "given, and varied"));
}

TEST_CASE("values that have commas have semicolons between, and one alone a semicolon behind") {
  const std::string two = swept(tiny_sweep({"--vary=background:0,0,0;1,1,1", "--columns=rays.total"}));
  CHECK(contains(two, "\"0,0,0\","));
  CHECK(contains(two, "\"1,1,1\","));
  CHECK(count(two, "\n") == 3);
  CHECK(count(swept(tiny_sweep({"--vary=background:0,0,0;", "--columns=rays.total"})), "\n") == 2);
}

TEST_CASE("a run that fails ends the sweep with the combination, and the rows before it are written") {
  const TemporaryFolder folder;
  apps::Interrupt interrupt;
  std::ostringstream output;
  StudySweepOptions options = tiny_sweep({"--vary=nodes:1,2"});
  options.settings.program = folder / "failing";
  write_text(options.settings.program,
             "#!/bin/sh\ncase $* in *--nodes=2*) echo dmpc: too odd >&2; exit 1;; esac\nexec " DMPC_PROGRAM " \"$@\"\n");
  std::filesystem::permissions(options.settings.program, std::filesystem::perms::owner_all);
  CHECK_THROWS_WITH_AS(apps::study_sweep_command(options, interrupt, output), "the run with --nodes=2 failed: too odd",
                       core::InputError);
  CHECK(count(output.str(), "\n") == 2);
}

}  // namespace dmpc::tests::sweep_command_test
