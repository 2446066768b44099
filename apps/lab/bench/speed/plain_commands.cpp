#include "apps/lab/bench/speed/plain_commands.h"

#include <algorithm>

#include "apps/lab/bench/speed/matches.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// What a command takes to start, to load and to build is what it takes for this.
constexpr Resolution least_size{8, 8};

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

Times PlainCommands::times_of(const PlainContender& contender, const Resolution& size, bool is_over_ranks) const {
  PlainContender asked = contender;
  asked.runner = is_over_ranks ? RunnerKind::mpi : contender.runner;
  std::vector<std::string> arguments = command_of(asked, scene_, size, picture());
  if (!is_over_ranks) {
    return time_process(program_, arguments, interrupt_).times;
  }
  std::vector<std::string> words = mpirun_words(folder_ / "");
  words.push_back(std::filesystem::canonical(program_).string());
  words.insert(words.end(), arguments.begin(), arguments.end());
  return time_process("env", words, interrupt_).times;
}

std::vector<double> PlainCommands::figures(const PlainContender& contender, bool is_over_ranks) const {
  const Times least = times_of(contender, least_size, is_over_ranks), all = times_of(contender, size_, is_over_ranks);
  std::vector<double> figures =
      figures_of({all.wall_seconds - least.wall_seconds, all.processor_seconds - least.processor_seconds});
  const std::vector<double> whole = figures_of(all);
  figures.insert(figures.end(), whole.begin(), whole.end());
  return figures;
}

std::vector<double> PlainCommands::figures_of_command(const PlainContender& contender) const { return figures(contender, false); }
std::vector<double> PlainCommands::figures_over_ranks(const PlainContender& contender) const { return figures(contender, true); }

std::string PlainCommands::why_no_ranks() const {
  if (!program_on_path("mpirun")) {
    return "mpirun is not installed";
  }
  try {
    times_of(contender_named("dataflow on 2 nodes"), least_size, true);
    return "";
  } catch (const core::InputError& error) {
    return error.what();
  }
}

}  // namespace dmpc::apps
