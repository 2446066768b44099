#include "apps/foreign/obj/materials.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "apps/edge/line/number_text.h"
#include "apps/edge/line/shown_text.h"
#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/surface.h"
#include "apps/foreign/text/name_list.h"

namespace dmpc::apps::obj {
namespace {

using core::Vec3d;

/// What of the materials that some face has is not shown.
class Losses {
 public:
  void add(const MtlMaterial& material);
  void note(std::vector<std::string>& notes) const;

 private:
  std::set<std::string> textures_;
  std::map<std::string, std::uint64_t> options_;
  std::uint64_t emissive_ = 0, light_textures_ = 0, coated_ = 0, filtered_ = 0, other_colors_ = 0, contradictory_ = 0,
                beyond_ = 0, dark_ = 0, beyond_shine_ = 0, beyond_shares_ = 0, beyond_index_ = 0, without_exponent_ = 0,
                otherwise_lit_ = 0, halos_ = 0;
};

bool is_beyond_unit(double share) { return share < 0 || share > 1; }
bool is_beyond_unit(const Vec3d& v) { return is_beyond_unit(v.x) || is_beyond_unit(v.y) || is_beyond_unit(v.z); }

/// How much of something there is: d, Tr, Pr and Pm.
bool has_share_beyond_unit(const MtlMaterial& material) {
  const auto& m = material;
  return is_beyond_unit(m.d.value_or(0)) || is_beyond_unit(m.transparency.value_or(0)) ||
         is_beyond_unit(m.roughness.value_or(0)) || is_beyond_unit(m.metallic.value_or(0));
}

void Losses::add(const MtlMaterial& material) {
  const Vec3d white{1, 1, 1};
  textures_.insert(material.other_textures.begin(), material.other_textures.end());
  if (material.texture) {
    for (const std::string& option : material.texture->left_out) {
      ++options_[option];
    }
  }
  emissive_ += emission_of(material) == Vec3d{} ? 0 : 1;
  light_textures_ += material.has_light_texture ? 1 : 0;
  coated_ += material.has_clear_coat ? 1 : 0;
  filtered_ += opacity_of(material) < 1 && material.filter.value_or(white) != white ? 1 : 0;
  other_colors_ += material.has_other_colors ? 1 : 0;
  contradictory_ += contradicts_itself(material) ? 1 : 0;
  without_exponent_ += lacks_exponent(material) ? 1 : 0;
  otherwise_lit_ += material.illumination.value_or(1) < 1 || material.illumination.value_or(1) > 9 ? 1 : 0;
  halos_ += material.has_halo ? 1 : 0;
  beyond_ += is_beyond_unit(material.diffuse.value_or(white)) || is_beyond_unit(material.specular) ? 1 : 0;
  dark_ += std::min({material.emission.x, material.emission.y, material.emission.z}) < 0 ? 1 : 0;
  beyond_shine_ += material.shine < 0 || material.shine > shine_max ? 1 : 0;
  beyond_shares_ += has_share_beyond_unit(material) ? 1 : 0;
  beyond_index_ += material.refraction_index > 0 ? 0 : 1;
}

void Losses::note(std::vector<std::string>& notes) const {
  note_count(notes, "textures not used, since they are not of a surface's colour", textures_.size());
  for (const auto& [option, count] : options_) {
    note_count(notes, "textures' option " + option + ", which is not followed", count);
  }
  note_count(notes, "materials that shine by themselves, and light other things by paths, not by --transport=whitted", emissive_);
  note_count(notes, "materials whose own light is a texture's, shown without it", light_textures_);
  note_count(notes, "materials with a clear coat, shown without it", coated_);
  note_count(notes, "materials that colour what shines through them (Tf), shown without that", filtered_);
  note_count(notes, "materials with colours by spectral curves or CIE XYZ, which are not followed", other_colors_);
  note_count(notes, "materials whose d and Tr contradict each other, shown by d", contradictory_);
  note_count(notes, "materials with a Ks and no Ns, shown without a highlight", without_exponent_);
  note_count(notes, "materials with an illum other than 1 to 9, shaded all the same", otherwise_lit_);
  note_count(notes, "materials with d -halo, as opaque at their edges as elsewhere", halos_);
  note_count(notes, "materials with colours outside 0 to 1, brought into it", beyond_);
  note_count(notes, "materials with a d, Tr, Pr or Pm outside 0 to 1, brought into it", beyond_shares_);
  note_count(notes, "materials with an Ns outside 0 to " + grouped(shine_max) + ", brought into it", beyond_shine_);
  note_count(notes, "materials with a Ke below 0, taken for 0", dark_);
  note_count(notes, "materials with an Ni of 0 or less, shown as if they had none", beyond_index_);
}

class Resolver {
 public:
  Resolver(const Geometry& geometry, const Libraries& libraries) : geometry_(geometry), libraries_(libraries) {}

  Materials resolve();

 private:
  std::uint32_t add(const MtlMaterial& source);
  MtlMaterial colored(MtlMaterial material) const;
  const MtlMaterial* source_of(std::uint32_t name) const;
  /// MeshLab (until 2023) and OpenMVS write a Tr of 1 for what is opaque: what every face has is not meant to be unseen.
  bool is_tr_of_what_is_opaque() const;
  std::uint32_t index_of(std::uint32_t name);
  /// Leaves textures out that lie on no face.
  void judge_textures();

  const Geometry& geometry_;
  const Libraries& libraries_;
  Materials result_;
  Losses losses_;
  std::map<const MtlMaterial*, std::uint32_t> known_;
  std::vector<std::string> unknown_;
  bool is_tr_opaque_ = false;  ///< that of every material
};

bool is_unseen_by_tr(const MtlMaterial& material) { return !material.d && material.transparency == 1; }

const MtlMaterial* Resolver::source_of(std::uint32_t name) const {
  return name == none ? nullptr : libraries_.find(geometry_.material_names[name]);
}

bool Resolver::is_tr_of_what_is_opaque() const {
  return !geometry_.runs.empty() && std::ranges::all_of(geometry_.runs, [this](const Run& run) {
    const MtlMaterial* const source = source_of(run.name);
    return source != nullptr && is_unseen_by_tr(*source);
  });
}

/// What names no colour is white below colours of vertices.
MtlMaterial Resolver::colored(MtlMaterial material) const {
  if (!material.diffuse && !geometry_.colors.empty()) {
    material.diffuse = Vec3d{1, 1, 1};
  }
  return material;
}

std::uint32_t Resolver::add(const MtlMaterial& source) {
  FileMaterial material{.material = shown_material(colored(source))};
  MaterialUse use{.name = source.name.empty() ? "what has no material" : "what has material '" + clipped(source.name, 60) + "'",
                  .texture = std::nullopt};
  if (source.texture) {
    material.texture = TextureUse{.path = source.texture->name, .edges = source.texture->edges};
    material.texture->edges.alpha = TextureAlpha::said;
    use.texture = source.texture->place;
  }
  result_.list.push_back(std::move(material));
  result_.uses.push_back(std::move(use));
  return static_cast<std::uint32_t>(result_.list.size() - 1);
}

/// Of the run's name. All without a material share one, whose key is null.
std::uint32_t Resolver::index_of(std::uint32_t name) {
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
    losses_.add(shown);
  }
  return known->second;
}

void Resolver::judge_textures() {
  std::vector<bool> is_placed(result_.list.size());
  std::uint64_t plain_faces = 0;
  std::vector<std::uint64_t> plain(result_.list.size());
  for (std::size_t run = 0; run < geometry_.runs.size(); ++run) {
    const bool is_last = run + 1 == geometry_.runs.size();
    const std::size_t end = is_last ? geometry_.faces.ends.size() : geometry_.runs[run + 1].first_face;
    for (std::size_t face = geometry_.runs[run].first_face; face < end; ++face) {
      const bool has_places = geometry_.faces.has_places(face);
      const std::uint32_t material = result_.of_runs[run];
      is_placed[material] = is_placed[material] || has_places;
      plain[material] += has_places ? 0 : 1;
    }
  }
  std::set<std::string> without;
  for (std::size_t i = 0; i < result_.list.size(); ++i) {
    if (result_.list[i].texture && !is_placed[i]) {
      without.insert(result_.list[i].texture->path);
      result_.list[i].texture.reset();
      result_.uses[i].texture.reset();
    }
    plain_faces += result_.list[i].texture ? plain[i] : 0;
  }
  note_count(result_.notes, "textures not shown, since no corner has a place on it", without.size());
  note_count(result_.notes, "faces without a place on their texture, shown in their plain colour", plain_faces);
}

Materials Resolver::resolve() {
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
  losses_.note(result_.notes);
  return std::move(result_);
}

}  // namespace

Materials materials_of(const Geometry& geometry, const Libraries& libraries) { return Resolver(geometry, libraries).resolve(); }

}  // namespace dmpc::apps::obj
