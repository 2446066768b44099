#include "apps/foreign/gltf/extensions.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>

#include "apps/foreign/mesh/count_note.h"
#include "apps/frontend/line/words.h"
#include "core/base/expect.h"

namespace dmpc::apps::gltf {
namespace {

/// What is shown as it is meant, as far as any material is, and what no picture of ours would show in another way.
const std::set<std::string> shown = {"KHR_draco_mesh_compression",
                                     "EXT_meshopt_compression",
                                     "KHR_mesh_quantization",
                                     "EXT_mesh_gpu_instancing",
                                     "KHR_node_visibility",
                                     "KHR_texture_transform",
                                     "EXT_texture_webp",
                                     "KHR_lights_punctual",
                                     "KHR_materials_ior",
                                     "KHR_materials_transmission",
                                     "KHR_materials_variants",
                                     "KHR_materials_emissive_strength",
                                     "KHR_animation_pointer",
                                     "KHR_node_selectability",
                                     "KHR_node_hoverability",
                                     "KHR_xmp",
                                     "KHR_xmp_json_ld",
                                     "FB_ngon_encoding",
                                     "MSFT_lod"};

/// Extensions of materials that change the picture, and what is said of them. Clear coats are said for all formats.
const std::map<std::string, std::string> materials = {
    {"KHR_materials_anisotropy", "materials whose highlights are longer one way, shown round"},
    {"KHR_materials_clearcoat", ""},
    {"KHR_materials_diffuse_transmission", "materials that let light through diffusely, shown without that"},
    {"KHR_materials_dispersion", "materials that split light into colours, shown without that"},
    {"KHR_materials_iridescence", "iridescent materials, shown without that"},
    {"KHR_materials_pbrSpecularGlossiness", "materials of specular and glossiness, of which colour and glossiness are shown"},
    {"KHR_materials_sheen", "materials with a sheen, shown without it"},
    {"KHR_materials_specular", "materials with a specular strength or colour of their own, shown without it"},
    {"KHR_materials_unlit", "unlit materials, shown in the light"},
    {"KHR_materials_volume", "materials that absorb light within, shown without that"}};

std::vector<std::string> names_in(const Document& document, const std::string& key, const auto& is_wanted) {
  std::vector<std::string> names;
  for (const Part& part : document.root().list(key)) {
    const std::string name = part.as_text();
    if (is_wanted(name) && std::find(names.begin(), names.end(), name) == names.end()) {
      names.push_back(name);
    }
  }
  return names;
}

}  // namespace

void check_required(const Document& document) {
  const auto names = names_in(document, "extensionsRequired", [](const std::string& name) { return !shown.contains(name); });
  if (!names.empty()) {
    throw core::InputError("requires what is not shown here: " + joined(names, ", ") +
                           "; export it without that, or take it out of the file's extensionsRequired");
  }
}

void note_extensions(const Document& document, std::vector<std::string>& notes) {
  std::map<std::string, std::uint64_t> counts;
  for (const Part& material : document.root().list("materials")) {
    for (const auto& [name, what] : materials) {
      counts[name] += material.extension(name) ? 1 : 0;
    }
  }
  for (const auto& [name, what] : materials) {
    note_count(notes, what, what.empty() ? 0 : counts[name]);
  }
  const auto unknown = names_in(document, "extensionsUsed",
                                [](const std::string& name) { return !shown.contains(name) && !materials.contains(name); });
  if (!unknown.empty()) {
    notes.push_back("extensions of glTF that are not shown: " + joined(unknown, ", "));
  }
}

}  // namespace dmpc::apps::gltf
