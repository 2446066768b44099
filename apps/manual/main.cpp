// Writes the manual page, the completion script, the schema of --stats and the calls of the module for Python, when the program
// is built: dmpc_manual FOLDER.

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include "apps/edge/manual/completion.h"
#include "apps/edge/manual/man_page.h"
#include "apps/main/commands.h"
#include "apps/manual/python_module.h"
#include "apps/show/stats/schema.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text << std::flush;
  if (!stream) {
    throw core::InputError(path.string() + " cannot be written");
  }
}

void write_manual(const std::filesystem::path& folder) {
  const CommandDescription program = describe_command_line();
  std::filesystem::create_directories(folder);
  write(folder / "dmpc.1", man_page(program, "dmpc " DMPC_VERSION));
  write(folder / "dmpc.bash", bash_completion(program));
  write(folder / "stats.schema.json", stats_schema());
  write(folder / "calls.py", python_calls(program));
  write(folder / "study.py", python_studies(program));
  write(folder / "commas.py", python_commas(program));
}

}  // namespace

}  // namespace dmpc::apps

int main(int count, char** values) {
  if (count != 2) {
    std::cerr << "usage: dmpc_manual FOLDER" << std::endl;
    return 2;
  }
  try {
    dmpc::apps::write_manual(values[1]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "dmpc_manual: " << error.what() << std::endl;
    return 1;
  }
}
