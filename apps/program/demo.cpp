#include "apps/program/demo.h"

#include <iostream>
#include <string>
#include <vector>

#include "apps/frontend/line/words.h"
#include "apps/frontend/system/scratch_folder.h"
#include "apps/program/commands.h"

namespace dmpc::apps {

void add_options(OptionSet options, DemoOptions& demo) {
  options.add_quiet(demo.quiet);
  options.set_examples("Examples:\n  dmpc demo");
}

int demo_command(const DemoOptions& options, Interrupt& interrupt, std::ostream& output) {
  std::vector<std::string> line{"render",      "teapot-12",        "--nodes=8",     "--cache-pages=16",
                                "--samples=4", "--runner=virtual", "--machine=hdr", "--serve"};
  const auto with_files = [&line](const std::string& folder) {
    std::vector<std::string> words = line;
    words.insert(words.end(), {"--report=" + folder + "teapot.html", "-o", folder + "teapot.png"});
    return words;
  };
  std::cerr << "dmpc: this is dmpc " << joined(with_files(""), " ") << '\n';
  if (options.quiet) {
    line.emplace_back("--quiet");
  }
  const ScratchFolder folder;
  return parse_command_line(declare_renderer, with_files((folder / "").string())).run(interrupt, output);
}

}  // namespace dmpc::apps
