#include "apps/foreign/obj/materials.h"

#include <algorithm>
#include <map>
#include <set>

#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/surface.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"

namespace dmpc::apps::obj {
namespace {

using core::Vec3d;

bool is_beyond_unit(double share) { return share < 0 || share > 1; }
bool is_beyond_unit(const Vec3d& v) { return is_beyond_unit(v.x) || is_beyond_unit(v.y) || is_beyond_unit(v.z); }

constexpr Vec3d white{1, 1, 1};

/// A feature of a material that is not shown.
struct Loss {
  std::string what;
  bool (*is_there)(const MtlMaterial&);
};

const std::vector<Loss>& losses() {
  static const std::vector<Loss> all = {
      {"materials whose own light is a texture's, shown without it", [](const auto& m) { return m.has_light_texture; }},
      {"materials with a clear coat, shown without it", [](const auto& m) { return m.has_clear_coat; }},
      {"materials that colour what shines through them (Tf), shown without that",
       [](const auto& m) { return opacity_of(m) < 1 && m.filter.value_or(white) != white; }},
      {"materials with colours by spectral curves or CIE XYZ, which are not followed",
       [](const auto& m) { return m.has_other_colors; }},
      {"materials whose d and Tr contradict each other, shown by d", contradicts_itself},
      {"materials with a Ks and no Ns, shown without a highlight", lacks_exponent},
      {"materials with an illum other than 1 to 9, shaded all the same",
       [](const auto& m) { return m.illumination.value_or(1) < 1 || m.illumination.value_or(1) > 9; }},
      {"materials with d -halo, as opaque at their edges as elsewhere", [](const auto& m) { return m.has_halo; }},
      {"materials with colours outside 0 to 1, brought into it",
       [](const auto& m) { return is_beyond_unit(m.diffuse.value_or(white)) || is_beyond_unit(m.specular); }},
      {"materials with a d, Tr, Pr or Pm outside 0 to 1, brought into it",
       [](const auto& m) {
         return is_beyond_unit(m.d.value_or(0)) || is_beyond_unit(m.transparency.value_or(0)) ||
                is_beyond_unit(m.roughness.value_or(0)) || is_beyond_unit(m.metallic.value_or(0));
       }},
      {"materials with an Ns outside 0 to " + grouped(shine_max) + ", brought into it",
       [](const auto& m) { return m.shine < 0 || m.shine > shine_max; }},
      {"materials with a Ke below 0, taken for 0",
       [](const auto& m) {
         return std::min({m.emission.x, m.emission.y, m.emission.z}) < 0;
       }},
      {"materials with an Ni of 0 or less, shown as if they had none", [](const auto& m) { return !(m.refraction_index > 0); }}};
  return all;
}

/// Notes losses of materials that faces use.
void note_losses(const std::vector<MtlMaterial>& materials, std::vector<std::string>& notes) {
  std::set<std::string> textures;
  std::map<std::string, std::uint64_t> options;
  for (const MtlMaterial& material : materials) {
    textures.insert(material.other_textures.begin(), material.other_textures.end());
    for (const std::string& option : material.texture ? material.texture->left_out : std::vector<std::string>()) {
      ++options[option];
    }
  }
  note_count(notes, "textures not used, since they are not of a surface's colour", textures.size());
  for (const auto& [option, count] : options) {
    note_count(notes, "textures' option " + option + ", which is not followed", count);
  }
  for (const Loss& loss : losses()) {
    note_count(notes, loss.what, static_cast<std::uint64_t>(std::ranges::count_if(materials, loss.is_there)));
  }
}

bool is_unseen_by_tr(const MtlMaterial& material) { return !material.d && material.transparency == 1; }

}  // namespace

class Resolver {
 public:
  Resolver(const Geometry& geometry, const Libraries& libraries) : geometry_(geometry), libraries_(libraries) {}

  Materials resolve() {
    is_tr_opaque_ = is_tr_of_what_is_opaque();
    std::map<std::uint32_t, std::uint32_t> of_names;
    for (const Run& run : geometry_.runs) {
      const auto [known, is_new] = of_names.try_emplace(run.name, 0);
      if (is_new) {
        known->second = index_of(run.name);
      }
      result_.of_runs.push_back(known->second);
    }
    note_count(result_.notes,
               "materials with a Tr of 1 and no d, as all are, shown as opaque: some programs write it so (a d of 0 hides them)",
               is_tr_opaque_ ? known_.size() : 0);
    note_names(result_.notes, "materials that are named and in no file of materials, shown grey", unknown_);
    judge_textures();
    note_losses(used_, result_.notes);
    return std::move(result_);
  }

 private:
  std::uint32_t add(const MtlMaterial& source) {
    FileMaterial material{.material = shown_material(colored(source))};
    if (source.texture) {
      material.texture = TextureUse{.path = source.texture->name, .edges = source.texture->edges};
      material.texture->edges.alpha = TextureAlpha::said;
    }
    result_.list.push_back(std::move(material));
    result_.places.push_back(source.texture ? source.texture->place : TexturePlace{});
    return static_cast<std::uint32_t>(result_.list.size() - 1);
  }

  /// Materials without a colour are white if vertices have colours.
  MtlMaterial colored(MtlMaterial material) const {
    if (!material.diffuse && !geometry_.colors.empty()) {
      material.diffuse = Vec3d{1, 1, 1};
    }
    return material;
  }

  const MtlMaterial* source_of(std::uint32_t name) const {
    return name == none ? nullptr : libraries_.find(geometry_.material_names[name]);
  }

  /// MeshLab (until 2023) and OpenMVS write a Tr of 1 for opaque materials: faces cannot all be meant to be invisible.
  bool is_tr_of_what_is_opaque() const {
    return !geometry_.runs.empty() && std::ranges::all_of(geometry_.runs, [this](const Run& run) {
      const MtlMaterial* const source = source_of(run.name);
      return source != nullptr && is_unseen_by_tr(*source);
    });
  }

  /// Returns the index of a run's material. All runs without a material share one, with a null key.
  std::uint32_t index_of(std::uint32_t name) {
    const MtlMaterial* const source = source_of(name);
    if (name != none && source == nullptr) {
      unknown_.push_back(geometry_.material_names[name]);
    }
    const auto [known, is_new] = known_.try_emplace(source, 0);
    if (is_new) {
      MtlMaterial shown = source == nullptr ? MtlMaterial{} : *source;
      if (is_tr_opaque_) {
        shown.transparency.reset();
      }
      known->second = add(shown);
      used_.push_back(std::move(shown));
    }
    return known->second;
  }

  /// Drops textures if no face of their material has texture coordinates.
  void judge_textures() {
    std::vector<bool> is_placed(result_.list.size());
    std::uint64_t plain_faces = 0;
    std::vector<std::uint64_t> plain(result_.list.size());
    geometry_.for_each_face([&](std::uint32_t face, std::size_t run) {
      const bool has_places = geometry_.faces.has_places(face);
      const std::uint32_t material = result_.of_runs[run];
      is_placed[material] = is_placed[material] || has_places;
      plain[material] += has_places ? 0 : 1;
    });
    std::set<std::string> without;
    for (std::size_t i = 0; i < result_.list.size(); ++i) {
      if (result_.list[i].texture && !is_placed[i]) {
        without.insert(result_.list[i].texture->path);
        result_.list[i].texture.reset();
      }
      plain_faces += result_.list[i].texture ? plain[i] : 0;
    }
    note_count(result_.notes, "textures not shown, since no corner has a place on it", without.size());
    note_count(result_.notes, "faces without a place on their texture, shown in their plain colour", plain_faces);
  }

  const Geometry& geometry_;
  const Libraries& libraries_;
  Materials result_;
  std::vector<MtlMaterial> used_;
  std::map<const MtlMaterial*, std::uint32_t> known_;
  std::vector<std::string> unknown_;
  bool is_tr_opaque_ = false;  ///< for every material
};

Materials materials_of(const Geometry& geometry, const Libraries& libraries) { return Resolver(geometry, libraries).resolve(); }

}  // namespace dmpc::apps::obj
