#include "apps/reader/file_access.h"

#include <algorithm>
#include <system_error>

#include "apps/frontend/system/resource_exhaustion.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace fs = std::filesystem;

namespace {

/// "http://...": what some programs would fetch.
bool is_address(const std::string& name) { return name.find("://") != std::string::npos; }

/// A folder of unknown name contains nothing.
bool is_below(const fs::path& path, const fs::path& folder) {
  return !folder.empty() && std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

FileAccess::FileAccess(const fs::path& scene, bool anywhere) : scene_(scene), anywhere_(anywhere) {
  const InputFile file = find_input_file(scene);
  std::error_code error;
  folders_ = {fs::canonical(fs::absolute(scene).parent_path(), error), file.resolved.parent_path()};
}

bool FileAccess::allows(const fs::path& resolved) const {
  return anywhere_ ||
         std::any_of(folders_.begin(), folders_.end(), [&](const fs::path& folder) { return is_below(resolved, folder); });
}

bool FileAccess::has(const fs::path& path) const {
  std::error_code error;
  const fs::path resolved = fs::canonical(path, error);
  return !error && is_ordinary_file(path) && (path == scene_ || allows(resolved));
}

InputFile FileAccess::open(const fs::path& path) {
  if (is_address(path.string()) && !is_ordinary_file(path)) {
    throw core::InputError(path.string() + " is an address, and only files are read");
  }
  std::error_code error;
  if (!fs::exists(path, error)) {
    throw core::InputError(path.string() + " is missing or cannot be opened");
  }
  try {
    InputFile file = find_input_file(path);
    if (path != scene_ && !allows(file.resolved)) {
      throw core::InputError("is not opened, since it lies neither beside nor below the scene, but at " + file.resolved.string() +
                             "; put it there, or allow every place by --files=anywhere");
    }
    open_input_file(file);
    opened_.add_resolved(file.resolved);
    return file;
  } catch (const ComputerCapacityError&) {
    throw;
  } catch (const core::InputError& error_found) {
    throw core::InputError(path.string() + " " + error_found.what());
  }
}

}  // namespace dmpc::apps
