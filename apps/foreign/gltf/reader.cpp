#include "apps/foreign/gltf/reader.h"

#include <filesystem>
#include <memory>

#include "apps/foreign/gltf/extensions.h"
#include "apps/foreign/gltf/materials.h"
#include "apps/foreign/gltf/nodes.h"
#include "apps/foreign/gltf/places.h"
#include "apps/foreign/mesh/count_note.h"

namespace dmpc::apps::gltf {
namespace {

namespace fs = std::filesystem;

/// glTF's numbers are floats, except those of nodes.
constexpr double float_rounding = 0x1p-25;

PlacedFile read_document(const Document& document, const OpenNamed& open, const MeshOptions& options, SceneTotals& totals) {
  PlacedFile file;
  file.coordinate_rounding = float_rounding;
  Buffers buffers(document, open);
  Accessors accessors(document, buffers, totals);
  const std::vector<MaterialTraits> materials = read_materials(document, buffers, totals, file);
  Meshes meshes = read_meshes(document, buffers, accessors, materials, totals);
  const Pose pose = options.animation ? pose_at(*options.animation, document, accessors, file.notes) : Pose{};
  Nodes nodes = read_nodes(document, accessors, meshes, pose, options.size, totals);
  file.views = std::move(nodes.views);
  file.lights = std::move(nodes.lights);
  place_meshes(document, accessors, nodes, std::move(meshes), materials, totals, file);
  const std::size_t animations = document.root().list("animations").size() - (options.animation ? 1 : 0);
  note_count(file.notes, "animations not played", animations);
  note_extensions(document, file.notes);
  return file;
}

}  // namespace

PlacedFile read_gltf(const std::string& path, const MeshOptions& options, SceneFiles& files) {
  const std::unique_ptr<FileBytes> bytes = files.open(path);
  const Document document = parse_document(bytes->bytes());
  check_required(document);
  const OpenNamed open = [&](const std::string& name) {
    const fs::path folder = fs::path(path).parent_path();
    const auto found = files.meant(folder, name);
    const std::unique_ptr<FileBytes> file = files.open((found.empty() ? folder / name : found.front()).string());
    return std::vector<std::byte>(file->bytes().begin(), file->bytes().end());
  };
  return read_document(document, open, options, files.totals());
}

}  // namespace dmpc::apps::gltf
