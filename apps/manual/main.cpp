// Writes what the command line declares, from which write.py makes manuals, and the schema of --stats, when the program is built:
// dmpc_manual_writer FOLDER.

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include "apps/frontend/line/description_json.h"
#include "apps/main/commands.h"
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

}  // namespace
}  // namespace dmpc::apps

int main(int count, char** values) {
  using namespace dmpc;
  if (count != 2) {
    std::cerr << "usage: dmpc_manual_writer FOLDER" << std::endl;
    return 2;
  }
  try {
    const std::filesystem::path folder = values[1];
    std::filesystem::create_directories(folder);
    apps::write(folder / "declared.json", apps::description_json(apps::describe_command_line(), DMPC_VERSION));
    apps::write(folder / "stats.schema.json", apps::stats_schema());
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "dmpc_manual_writer: " << error.what() << std::endl;
    return 1;
  }
}
