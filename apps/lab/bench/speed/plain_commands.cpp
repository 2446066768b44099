#include "apps/lab/bench/speed/plain_commands.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <string_view>

#include "apps/lab/bench/speed/matches.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// What a command takes to start, to load and to build is what it takes for this.
constexpr Resolution least_size{8, 8};
/// A busy moment in such a run would count for the picture.
constexpr int least_runs = 3;
constexpr const char* counters_name = "counters.json";

/// mpirun, as root, too, with more ranks than processors, none bound to one of them, and without looks for graphics cards. It has
/// a folder of its own: where two begin in one, the later may find the earlier's half made, and ends.
std::vector<std::string> mpirun_words(const std::filesystem::path& folder) {
  return {"TMPDIR=" + folder.string(),
          "OMPI_ALLOW_RUN_AS_ROOT=1",
          "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
          "OMPI_MCA_rmaps_base_oversubscribe=1",
          "OMPI_MCA_hwloc_base_binding_policy=none",
          "HWLOC_COMPONENTS=-gl,-opencl",
          "mpirun",
          "-n",
          std::to_string(PlainCommands::rank_count)};
}

}  // namespace

PlainCommands::PlainCommands(const std::filesystem::path& program, const std::string& scene, const Resolution& size,
                             const Interrupt& interrupt)
    : program_(program), scene_(scene), size_(size), interrupt_(interrupt) {}

Times PlainCommands::times_of(const PlainContender& contender, const Resolution& size) const {
  return time_process(program_, command_of(contender, scene_, size, picture()), interrupt_).times;
}

Times PlainCommands::least_times_of(const PlainContender& contender) const {
  Times least = times_of(contender, least_size);
  for (int more = 1; more < least_runs; ++more) {
    const Times times = times_of(contender, least_size);
    least = {std::min(least.wall_seconds, times.wall_seconds), std::min(least.processor_seconds, times.processor_seconds)};
  }
  return least;
}

std::vector<double> PlainCommands::figures_of_command(const PlainContender& contender) const {
  const Times least = least_times_of(contender), all = times_of(contender, size_);
  std::vector<double> figures = {all.wall_seconds - least.wall_seconds, all.processor_seconds - least.processor_seconds};
  for (double& figure : figures) {
    figure = figure > 0 ? figure : no_figure;
  }
  const std::vector<double> whole = figures_of(all);
  figures.insert(figures.end(), whole.begin(), whole.end());
  return figures;
}

/// Leaves its counters.
void PlainCommands::run(const PlainContender& contender, const Resolution& size, bool is_over_ranks) const {
  PlainContender asked = contender;
  asked.runner = is_over_ranks ? RunnerKind::mpi : contender.runner;
  std::vector<std::string> words = is_over_ranks ? mpirun_words(folder_ / "") : std::vector<std::string>();
  words.push_back(std::filesystem::canonical(program_).string());
  for (const std::string& argument : command_of(asked, scene_, size, picture())) {
    words.push_back(argument);
  }
  words.push_back("--stats=" + (folder_ / counters_name).string());
  time_process("env", words, interrupt_);
}

double PlainCommands::render_seconds(const PlainContender& contender, bool is_over_ranks) const {
  run(contender, size_, is_over_ranks);
  constexpr std::string_view key = "\"render\": ";  // of which the counters have one
  std::ostringstream text;
  text << std::ifstream(folder_ / counters_name).rdbuf();
  const std::string counters = text.str();
  const std::size_t at = counters.find(key);
  double seconds = 0;
  if (at != std::string::npos) {
    std::from_chars(counters.data() + at + key.size(), counters.data() + counters.size(), seconds);
  }
  if (!(seconds > 0)) {
    throw core::InputError("the counters of a render of " + scene_ + " were expected to say what its phase render took");
  }
  return seconds;
}

std::string PlainCommands::why_no_ranks() const {
  if (!program_on_path("mpirun")) {
    return "mpirun is not installed";
  }
  try {
    run(contender_named("dataflow on 2 nodes"), least_size, true);
    return "";
  } catch (const core::InputError& error) {
    return error.what();
  }
}

}  // namespace dmpc::apps
