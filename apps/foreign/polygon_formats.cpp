#include "apps/foreign/polygon_formats.h"

#include <array>

#include "apps/foreign/mesh/file_ending.h"
#include "apps/foreign/obj/reader.h"
#include "apps/foreign/polygon/off.h"
#include "apps/foreign/polygon/ply.h"
#include "apps/foreign/polygon/stl.h"

namespace dmpc::apps {
namespace {

using PolygonReader = PolygonFile (*)(const std::string& path, SceneFiles& files);

struct Format {
  const char* ending;
  PolygonReader reader;
};

constexpr std::array<Format, 4> formats{{
    {"obj", read_obj},
    {"off", read_off},
    {"ply", read_ply},
    {"stl", read_stl},
}};

}  // namespace

std::optional<PolygonFile> read_polygon_file(const std::string& path, SceneFiles& files) {
  const std::string ending = ending_of(path);
  for (const Format& format : formats) {
    if (ending == format.ending) {
      return format.reader(path, files);
    }
  }
  return std::nullopt;
}

}  // namespace dmpc::apps
