#include "apps/edge/system/companion_path.h"

#include <unistd.h>

#include <system_error>

namespace dmpc::apps {

namespace fs = std::filesystem;

fs::path companion_path(const std::string& name, const std::string& installed, const std::string& what) {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::string places;
  for (const fs::path& place : {folder, folder / installed, folder / "../apps"}) {
    const fs::path file = place / name;
    if (!folder.empty() && ::access(file.c_str(), F_OK) == 0) {
      return file;
    }
    places += (places.empty() ? "" : ", ") + file.lexically_normal().string();
  }
  throw InstallationError(what + " is in none of its places (" + places + "): build or install dmpc as a whole");
}

}  // namespace dmpc::apps
