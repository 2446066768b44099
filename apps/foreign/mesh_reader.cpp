#include "apps/foreign/mesh_reader.h"

#include <array>
#include <string_view>

#include "apps/foreign/gltf/reader.h"
#include "apps/foreign/obj/reader.h"
#include "apps/foreign/pbrt/reader.h"
#include "apps/foreign/placed_scene.h"
#include "apps/foreign/polygon/off.h"
#include "apps/foreign/polygon/ply.h"
#include "apps/foreign/polygon/stl.h"
#include "apps/frontend/line/small_letters.h"
#include "core/base/expect.h"
#include "core/base/forget.h"

namespace dmpc::apps {
namespace {

using MeshFileReader = PlacedFile (*)(const std::string& path, const MeshOptions& options, SceneFiles& files);

/// What takes no options.
template <PlacedFile (*read)(const std::string&, SceneFiles&)>
PlacedFile without_options(const std::string& path, const MeshOptions& /*options*/, SceneFiles& files) {
  return read(path, files);
}

struct MeshFormat {
  std::string_view ending;
  MeshFileReader reader;
};

constexpr std::array mesh_formats{
    MeshFormat{"glb", gltf::read_gltf},           MeshFormat{"gltf", gltf::read_gltf},
    MeshFormat{"obj", without_options<read_obj>}, MeshFormat{"off", without_options<read_off>},
    MeshFormat{"pbrt", pbrt::read_pbrt},          MeshFormat{"gz", pbrt::read_pbrt},
    MeshFormat{"ply", without_options<read_ply>}, MeshFormat{"stl", without_options<read_stl>},
};

PlacedFile read(const std::string& path, const MeshOptions& options, SceneFiles& files) {
  const std::string ending = ending_of(path);
  for (const MeshFormat& format : mesh_formats) {
    if (ending == format.ending) {
      return format.reader(path, options, files);
    }
  }
  throw core::InputError("its name does not say what it is: nothing that ends in '." + ending + "' is read here");
}

}  // namespace

MeshScene read_mesh(const std::string& path, const MeshOptions& options, SceneFiles& files) {
  MeshScene mesh = placed_scene(read(path, options, files), path, options, files);
  core::give_back_freed();
  return mesh;
}

}  // namespace dmpc::apps
