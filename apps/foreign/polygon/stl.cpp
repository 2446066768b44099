#include "apps/foreign/polygon/stl.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "apps/edge/system/byte_order_mark.h"
#include "apps/foreign/polygon/stl_binary.h"
#include "apps/foreign/polygon/stl_text.h"
#include "apps/foreign/polygon/whole_file.h"

namespace dmpc::apps {
namespace {

bool begins_with_solid(std::string_view text) {
  constexpr std::string_view solid = "solid";
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text.size() >= solid.size() &&
         std::equal(solid.begin(), solid.end(), text.begin(), [](char a, unsigned char b) { return a == std::tolower(b); });
}

/// Without bytes that text has not, but behind its end.
bool is_text(std::string_view file) {
  const std::string_view text = file.substr(0, file.find('\0'));
  const bool is_whole = text.size() == file.size() || text.find("endsolid") != std::string_view::npos;
  return begins_with_solid(without_mark(file)) && is_whole && !is_whole_stl_binary(file);
}

}  // namespace

PlacedFile read_stl(const std::string& path, SceneFiles& files) {
  return read_whole(path, files, [](std::string_view file, ReadingProgress& progress) {
    return is_text(file) ? read_stl_text(without_mark(file), progress) : read_stl_binary(file, progress);
  });
}

}  // namespace dmpc::apps
