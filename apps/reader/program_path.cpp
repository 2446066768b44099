#include "apps/reader/program_path.h"

#include <unistd.h>

#include <system_error>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace fs = std::filesystem;

fs::path reader_program(const std::string& name) {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::string places;
  for (const fs::path& place : {folder, folder / "../libexec/dmpc", folder / "../apps"}) {
    const fs::path program = place / name;
    if (::access(program.c_str(), X_OK) == 0) {
      return program;
    }
    places += (places.empty() ? "" : ", ") + program.lexically_normal().string();
  }
  throw core::InternalError("the program " + name + ", which reads foreign files for dmpc, is in none of its places (" + places +
                            "): build or install dmpc as a whole");
}

}  // namespace dmpc::apps
