#include "apps/foreign/pbrt/reader.h"

#include "apps/foreign/pbrt/statements.h"
#include "apps/foreign/text/small_letters.h"

namespace dmpc::apps::pbrt {

bool is_pbrt_path(const std::string& path) {
  const std::string name = in_small_letters(path);
  return name.ends_with(".pbrt") || name.ends_with(".pbrt.gz");
}

PlacedFile read_pbrt(const std::string& path, const std::optional<Resolution>& size, SceneFiles& files, core::Copies copies) {
  return Statements(path, files, copies).read(size);
}

}  // namespace dmpc::apps::pbrt
