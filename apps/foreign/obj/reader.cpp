#include "apps/foreign/obj/reader.h"

#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "apps/foreign/obj/libraries.h"
#include "apps/foreign/obj/materials.h"
#include "apps/foreign/obj/mesh.h"
#include "apps/foreign/obj/parser.h"

namespace dmpc::apps {
namespace {

obj::Geometry read_geometry(const std::string& path, SceneFiles& files) {
  const std::unique_ptr<FileBytes> file = files.open(path);
  return obj::parse_obj(
      text_of(*file), [&files](float share) { files.show_progress(share); }, files.totals());
}

void append(std::vector<std::string> more, std::vector<std::string>& all) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

PlacedFile read_obj(const std::string& path, SceneFiles& files) {
  PlacedFile result;
  obj::Geometry geometry = read_geometry(path, files);
  obj::Libraries libraries(geometry.material_names, path, files);
  for (const std::string& names : geometry.libraries) {
    libraries.read(names);
  }
  obj::Materials materials = obj::materials_of(geometry, libraries);
  result.notes = std::move(geometry.notes);
  append(std::move(libraries.notes), result.notes);
  libraries.note_repeated(result.notes);
  append(std::move(materials.notes), result.notes);
  result.missing = std::move(libraries.missing);
  if (!geometry.runs.empty()) {
    result.add(obj::mesh_of(std::move(geometry), materials));
  }
  result.materials = std::move(materials.list);
  return result;
}

}  // namespace dmpc::apps
