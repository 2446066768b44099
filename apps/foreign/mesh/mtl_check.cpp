#include "apps/foreign/mesh/mtl_check.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

#include "apps/foreign/mesh/trimmed.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::string_view keyword = "map_kd";
/// Of a name, with the options before it; Assimp holds no more.
constexpr std::size_t name_bytes_max = 1023;

bool is_map(std::string_view line) {
  return line.size() >= keyword.size() &&
         std::equal(keyword.begin(), keyword.end(), line.begin(),
                    [](char known, unsigned char letter) { return known == std::tolower(letter); }) &&
         (line.size() == keyword.size() || std::isspace(static_cast<unsigned char>(line[keyword.size()])) != 0);
}

}  // namespace

std::string check_mtl(const std::string& path, std::string_view file) {
  std::size_t nameless = 0, first = 0;
  for (std::size_t number = 1; !file.empty(); ++number) {
    const std::size_t end = std::min(file.find('\n'), file.size());
    if (const std::string_view line = trimmed(file.substr(0, end)); is_map(line)) {
      const std::size_t name_bytes = trimmed(line.substr(keyword.size())).size();
      if (name_bytes > name_bytes_max) {
        throw core::InputError(path + " names a texture in " + std::to_string(name_bytes) + " bytes in line " +
                               std::to_string(number) + "; expected at most " + std::to_string(name_bytes_max));
      }
      first = name_bytes == 0 && nameless++ == 0 ? number : first;
    }
    file.remove_prefix(std::min(end + 1, file.size()));
  }
  return nameless == 0 ? ""
                       : path + ": map_Kd names no file in line " + std::to_string(first) +
                             (nameless == 1 ? "" : " and " + std::to_string(nameless - 1) + " others") +
                             ": there the plain colour is shown";
}

}  // namespace dmpc::apps
