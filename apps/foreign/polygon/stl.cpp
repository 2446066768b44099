#include "apps/foreign/polygon/stl.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "apps/edge/system/byte_order_mark.h"
#include "apps/foreign/polygon/indexed_mesh.h"
#include "apps/foreign/polygon/stl_binary.h"
#include "apps/foreign/polygon/stl_text.h"

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

PolygonFile read_stl(const std::string& path, SceneFiles& files) {
  const std::unique_ptr<FileBytes> bytes = files.open(path);
  const std::string_view file = text_of(*bytes);
  ReadingProgress progress(files, file.size());
  PolygonFile result = is_text(file) ? read_stl_text(without_mark(file), progress) : read_stl_binary(file, progress);
  check_has_faces(result);
  return result;
}

}  // namespace dmpc::apps
