#include "apps/mesh/named_file.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace dmpc::apps {

namespace fs = std::filesystem;

namespace {

/// "%20" as a blank: glTF names files by addresses.
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

}  // namespace

std::vector<fs::path> files_meant(const fs::path& folder, const std::string& name) {
  std::string path = name;
  std::replace(path.begin(), path.end(), '\\', '/');
  std::vector<fs::path> found;
  std::error_code error;
  for (const fs::path& candidate : {folder / path, folder / decoded_address(path), folder / fs::path(path).filename()}) {
    if (fs::is_regular_file(candidate, error)) {
      found.push_back(candidate);
    }
  }
  return found;
}

}  // namespace dmpc::apps
