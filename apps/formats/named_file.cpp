#include "apps/formats/named_file.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <system_error>

#include "apps/frontend/line/small_letters.h"

namespace dmpc::apps {
namespace {

namespace fs = std::filesystem;

std::string with_slashes(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

/// "C:\art\wood.png" as "/art/wood.png".
fs::path without_windows(const std::string& windows_name) {
  const std::string name = with_slashes(windows_name);
  const bool has_drive = name.size() > 1 && name[1] == ':' && std::isalpha(static_cast<unsigned char>(name[0])) != 0;
  return has_drive ? name.substr(2) : name;
}

/// What is called so in `folder`, whatever the case of its letters: the first by name if there are several.
fs::path entry_of(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) {
    return folder / name;
  }
  const std::string wanted = in_small_letters(name);
  fs::path found;
  for (fs::directory_iterator entries(folder, error), end; !error && entries != end; entries.increment(error)) {
    const fs::path& path = entries->path();
    if (in_small_letters(path.filename().string()) == wanted && (found.empty() || path < found)) {
      found = path;
    }
  }
  return found;
}

/// `relative` below `folder`, each part in whatever case; nothing if it is not there or leads out of the folder.
fs::path below(const fs::path& folder, const fs::path& relative) {
  fs::path at = folder.empty() ? fs::path(".") : folder;
  for (const fs::path& part : relative) {
    if (part == "." || part.empty()) {
      continue;
    }
    const bool leads_out = part == ".." || part.is_absolute();
    const fs::path next = leads_out ? fs::path() : entry_of(at, part.string());
    if (next.empty()) {
      return {};
    }
    at = next;
  }
  return at;
}

std::vector<fs::path> candidates(const fs::path& folder, const std::string& name) {
  const fs::path plain = without_windows(name), decoded = without_windows(decoded_address(name));
  std::vector<fs::path> paths = {folder / name, folder / decoded_address(name)};
  for (const fs::path& spelling : {plain, decoded}) {
    paths.push_back(below(folder, spelling));
  }
  for (const fs::path& spelling : {plain, decoded}) {
    paths.push_back(below(folder, spelling.filename()));
    paths.push_back(below(folder, "textures" / spelling.filename()));
  }
  return paths;
}

}  // namespace

std::vector<fs::path> files_meant(const fs::path& folder, const std::string& name) {
  std::vector<fs::path> files;
  for (const fs::path& path : candidates(folder, name)) {
    std::error_code error;
    const fs::path normal = path.lexically_normal();
    if (!path.empty() && fs::is_regular_file(path, error) &&
        std::none_of(files.begin(), files.end(), [&](const fs::path& known) { return known.lexically_normal() == normal; })) {
      files.push_back(path);
    }
  }
  return files;
}

bool is_under_other_name(const fs::path& folder, const std::string& name, const fs::path& path) {
  const auto is_said = [&](const fs::path& said) { return path.lexically_normal() == (folder / said).lexically_normal(); };
  return !is_said(name) && !is_said(decoded_address(name)) && !is_said(with_slashes(name));
}

std::string decoded_address(const std::string& text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned letter = 0;
    const char* const digits = text.data() + i + 1;
    const bool is_coded =
        text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, letter, 16).ptr == digits + 2;
    decoded += is_coded ? static_cast<char>(letter) : text[i];
    i += is_coded ? 2 : 0;
  }
  return decoded;
}

}  // namespace dmpc::apps
