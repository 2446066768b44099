#include "apps/lab/study/decades/command.h"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>

#include "apps/frontend/system/companion_path.h"

namespace dmpc::apps {
namespace {

/// Debian's Python first: it is the one for which packages bring modules.
constexpr std::array<const char*, 2> pythons = {"/usr/bin/python3", "python3"};

/// Says which package has what is missing.
constexpr const char* driver = R"(import sys
packages = {"dmpc": "python3-dmpc", "numpy": "python3-numpy", "pandas": "python3-pandas", "OpenImageIO": "python3-openimageio",
            "matplotlib": "python3-matplotlib"}
try:
    from dmpc.decades import command
except ModuleNotFoundError as error:
    package = packages.get(error.name.split(".")[0], error.name)
    sys.exit(f"dmpc: study decades needs Python's module {error.name}: apt-get install {package}"
             + (", or set PYTHONPATH to apps/python of the sources" if package == "python3-dmpc" else ""))
sys.exit(command.main(sys.argv[1:]))
)";

}  // namespace

void add_options(OptionSet set, DecadesOptions& options) {
  const auto pass = [&words = options.words](const char* name) {
    return [&words, name](const std::string& value) { words.push_back(std::string(name) + "=" + value); };
  };
  set.add_required("--output,-o", "FOLDER", pass("--output"), "Folder of the page, its pictures, and the counters of all runs");
  set.add_text(
      "--part", "plan|run|page [run]", pass("--part"),
      "plan: measure what a run of each kind costs and print how many there are. run: make what the folder lacks, and the "
      "page. page: the page of what the folder has");
  set.add_flag("--quick", options.is_quick, "Fewer cells, scenes and draws: 4 minutes on two cores, where all take 90");
  set.add_text("--jobs", "1..256 [all cores]", pass("--jobs"), "Runs at a time");
  set.set_examples(
      "Examples:\n"
      "  dmpc study decades --quick -o decades\n"
      "  dmpc study decades -o decades\n"
      "Needs Python with numpy, pandas, OpenImageIO and matplotlib.");
}

int study_decades_command(const DecadesOptions& options, std::ostream& output) {
  output.flush();
  std::vector<std::string> line = {"python3", "-X", "utf8", "-c", driver};
  line.insert(line.end(), options.words.begin(), options.words.end());
  if (options.is_quick) {
    line.emplace_back("--quick");
  }
  std::vector<char*> words;
  for (std::string& word : line) {
    words.push_back(word.data());
  }
  words.push_back(nullptr);
  ::setenv("DMPC", std::filesystem::read_symlink("/proc/self/exe").replace_filename("dmpc").c_str(), 0);
  for (const char* const python : pythons) {
    ::execvp(python, words.data());
  }
  throw InstallationError("study decades needs Python: apt-get install python3-dmpc python3-matplotlib");
}

}  // namespace dmpc::apps
