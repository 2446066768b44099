#include "core/database/database_builder.h"

#include <algorithm>
#include <utility>

#include "core/base/box.h"
#include "core/base/expect.h"
#include "core/base/forget.h"
#include "core/database/faces/coplanar.h"
#include "core/database/faces/twins.h"
#include "core/database/shading/material_records.h"
#include "core/database/shading/texture_records.h"
#include "core/database/structure.h"
#include "core/record/choice_node.h"
#include "core/record/directory.h"
#include "core/record/texture_layout.h"
#include "core/scene/detail.h"
#include "core/scene/frame.h"
#include "core/scene/placed_objects.h"

namespace dmpc::core {

void forget_objects(Scene& scene) {
  forget(scene.objects);
  forget(scene.vertices);
  forget(scene.normals);
  forget(scene.spheres);
  forget(scene.cones);
  forget(scene.corners);
  scene.kept.reset();
}

void forget_texels(Texture& texture) {
  for (TextureLevel& level : texture.levels) {
    forget(level.texels);
  }
}

DatabaseBuilder::DatabaseBuilder(Input input)
    : scene_(input.scene),
      meshes_(input.meshes),
      writer_(input.options.page_size_bytes, std::move(input.places)),
      expendable_(input.expendable),
      options_(input.options),
      parallel_(input.options.threads) {
  const std::size_t page_size = options_.page_size_bytes;
  expect(page_size >= 512 && page_size <= 65536 && (page_size & (page_size - 1)) == 0,
         "a page is a power of two from 512 B to 64 KiB");
  expect(!options_.keeps_instances || (options_.structure == Structure::extents && options_.record_order == RecordOrder::spatial),
         "instances are kept in one tree of extents, in spatial order");
  result_.page_size_ = page_size;
  result_.structure_ = options_.structure;
}

std::optional<Database> DatabaseBuilder::build() {
  fit();
  conversion_ = convert(scene_, frame(), parallel_, {.meshes = meshes_});
  set_pad();  // instances of meshes may have added layers
  MacroCells cells = sort_into_macro_cells();
  if (settle_coplanar(conversion_, cells, scene_, frame(), parallel_)) {
    set_pad();                        // there are layers now
    cells = sort_into_macro_cells();  // may look for twins among the scene's objects
  }
  if (!keep()) {
    return std::nullopt;
  }
  if (expendable_ != nullptr) {
    forget_objects(*expendable_);
  }
  cells = cells_of(std::move(cells));
  header().primitive_count = static_cast<std::uint32_t>(primitive_count());
  if (options_.emitters_max > 0) {
    emitters_ = choose_emitters(conversion_, scene_, options_.emitters_max);
    for (EmitterRecord& emitter : emitters_.records) {
      emitter.primitive = id_of(emitter.primitive);
    }
  }
  result_.references_ = write_records(cells);
  give_back_freed();  // trees consist of many small allocations
  result_.dropped_ = conversion_.dropped;
  result_.duplicates_ = conversion_.duplicates;
  result_.shared_planes_ = conversion_.shared_planes;
  result_.primitives_ = HeldArray(std::move(conversion_.primitives));
  result_.sources_ = HeldArray(std::move(conversion_.sources));
  result_.collapsed_ = HeldArray(std::move(conversion_.collapsed));
  result_.close_faces_ = HeldArray(std::move(conversion_.close_faces));
  result_.planes_ = HeldArray(std::move(conversion_.planes));
  result_.bytes_ = HeldArray(std::move(writer_).finish());
  result_.page_count_ = (result_.bytes_.items().size() - overread_bytes) / result_.page_size_;
  return std::move(result_);
}

std::vector<Address> DatabaseBuilder::scattered() const {
  return scattered_places(writer_.sizes(), writer_.front_bytes(), options_.page_size_bytes);
}

void DatabaseBuilder::fit() {
  const Box bounds = bounds_of(scene_, parallel_);
  object_count_ = core::object_count(scene_);
  header().frame = fit_frame(bounds, object_count_, options_.cells_per_primitive);
  if (const auto place = place_of_detail(scene_, bounds)) {
    move_zero(header().frame, *place);
  }
  header().background = Color(scene_.background);
  header().ambient = Color(scene_.ambient);
  if (!bounds.empty()) {
    const Vec3d low = (bounds.low - frame().origin) * frame().scale, high = (bounds.high - frame().origin) * frame().scale;
    used_ = high + low - frame().low * 2.0;
    view_distance_ = eye_distance(scene_.view.from, bounds);
  }
  set_pad();
}

void DatabaseBuilder::set_pad() { result_.pad_ = options_.pad_share * insertion_pad(frame(), view_distance_, layers_above()); }

/// The highest layer of a plane.
std::int32_t DatabaseBuilder::layers_above() const {
  std::int32_t layers = conversion_.place_layers;
  for (const PrimitivePlane& plane : conversion_.planes) {
    layers = std::max(layers, plane.stored_as - std::int32_t{LeafHeader::exact_plane});
  }
  return layers;
}

/// If primitives are so large, so long, so far from the view or so concentrated that the lists would be long, duplicates are
/// removed; then cells of twice the size are tried, and finally a single one.
MacroCells DatabaseBuilder::sort_into_macro_cells() {
  for (;;) {
    if (auto cells = list_macro_cells()) {
      return std::move(*cells);
    }
    const bool is_first_try = !std::exchange(has_looked_for_twins_, true);
    if (!is_first_try || !drop_twins(conversion_, scene_, frame())) {
      coarsen();
    }
  }
}

std::optional<MacroCells> DatabaseBuilder::list_with(std::int64_t excess) const {
  return MacroCells::list(conversion_.primitives, frame(), pad(), parallel_, excess);
}

void DatabaseBuilder::join_cells() {
  header().frame.eye_extent = grid_high(frame()) - frame().low;
  while (macro_cells(frame()) != std::array<std::int32_t, 3>{1, 1, 1}) {
    coarsen();
  }
}

void DatabaseBuilder::coarsen() {
  core::coarsen(header().frame);
  set_pad();
}

std::size_t DatabaseBuilder::begin_page() {
  writer_.begin_page();
  return writer_.page_bytes() / options_.page_size_bytes;
}

void DatabaseBuilder::write_tables(std::optional<std::uint64_t> references) {
  header().region.high = grid_size(frame());
  header().directory_size = macro_cells(frame());
  header().directory = writer_.allocate_array<DirectoryEntry>(directory_entry_count(header().directory_size));
  if (references) {
    header().references = writer_.allocate_array<VoxelReference>(round_up(*references, std::uint64_t{2}));
  }
  write_lights();
  write_materials();
  write_emitters();
  write_sky_table();
  for (const Texture& texture : scene_.textures) {
    textures_.push_back(is_shown(texture) ? reference_to(texture, writer_) : TextureReference{});
  }
}

void DatabaseBuilder::write_directory(std::span<const DirectoryEntry> directory) {
  writer_.write(header().directory, 0, std::as_bytes(directory));
}

void DatabaseBuilder::write_lights() {
  header().light_count = static_cast<std::uint32_t>(scene_.lights.size());
  header().lights = writer_.allocate_array<LightRecord>(scene_.lights.size());
  for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
    const PointLight& light = scene_.lights[i];
    const bool falls_off = light.falls_off_from > 0;
    const Vec3d intensity = intensity_of(light, scene_) * (falls_off ? frame().scale * frame().scale : 1.0);
    writer_.write(header().lights, i * sizeof(LightRecord),
                  LightRecord{.position = Vec3f(to_local(frame(), light.position)),
                              .intensity = Color(intensity),
                              .spread = spread_of(light.cone, falls_off)});
  }
}

/// Emitters' materials follow the scene's, and extensions follow all, in the order of their materials.
void DatabaseBuilder::write_materials() {
  std::vector<Material> materials = scene_.materials;
  materials.insert(materials.end(), emitters_.materials.begin(), emitters_.materials.end());
  const MaterialRecords records = material_records(materials, options_.for_paths);
  const std::size_t count = records.materials.size() + records.finishes.size();
  expect(count <= 0x3fffffffU, "a database has no room for more materials");
  header().material_count = count & 0x3fffffffU;
  counts().materials = records.materials.size();
  header().has_emission = std::any_of(scene_.materials.begin(), scene_.materials.end(),
                                      [](const Material& material) { return !(material.emission == Vec3d{}); })
                              ? 1
                              : 0;
  header().materials = writer_.allocate_array<MaterialRecord>(count);
  writer_.write(header().materials, 0, std::as_bytes(std::span(records.materials)));
  writer_.write(header().materials, records.materials.size() * sizeof(MaterialRecord),
                std::as_bytes(std::span(records.finishes)));
}

void DatabaseBuilder::write_emitters() {
  counts().emitters_met = emitters_.others;
  counts().emitters_covered = emitters_.covered;
  if (emitters_.records.empty()) {
    return;
  }
  header().emitter_count = static_cast<std::uint32_t>(emitters_.records.size());
  header().drawn_materials = static_cast<std::uint32_t>(scene_.materials.size());
  header().emitter_density = emitters_.density;
  header().emitters = writer_.allocate_array<EmitterRecord>(emitters_.records.size());
  const Address choices = writer_.allocate_array<ChoiceNode>(emitters_.choices.size());
  expect(choices == choice_address(header(), 0), "choices stand behind all emitters");
  writer_.write(header().emitters, 0, std::as_bytes(std::span(emitters_.records)));
  writer_.write(choices, 0, std::as_bytes(std::span(emitters_.choices)));
}

/// Only pictures with path tracing use textures of numbers that are not colours.
bool DatabaseBuilder::is_shown(const Texture& texture) const {
  return options_.for_paths || texture.format != TexelFormat::linear;
}

void DatabaseBuilder::write_sky_table() {
  if (!options_.for_paths || !scene_.sky.is_there()) {
    return;
  }
  const Vec3d up = zenith_of(scene_);
  sky_ = sky_records(scene_.sky, sky_middle(up), up);
  sky_.reference.choices = writer_.allocate_array<ChoiceNode>(sky_.choices.size());
  writer_.write(sky_.reference.choices, 0, std::as_bytes(std::span(sky_.choices)));
  counts().sky_tiles = sky_.tiles.size();
  if (expendable_ != nullptr) {
    forget(expendable_->sky.texels);
  }
}

/// The tiles follow all other records in one piece, once these are allocated.
void DatabaseBuilder::write_sky_tiles() {
  if (!sky_.tiles.empty()) {
    writer_.begin_page();
    sky_.reference.tiles = writer_.allocate_array<TextureTile>(sky_.tiles.size());
    writer_.write(sky_.reference.tiles, 0, std::as_bytes(std::span(sky_.tiles)));
    header().sky = sky_.reference;
    forget(sky_.tiles);
  }
}

/// Each texture is allocated at once, and its texels are freed as soon as it is written: they can be most of a scene.
void DatabaseBuilder::write_textures() {
  std::size_t tiles = 0;
  for (const TextureReference& texture : textures_) {
    tiles += tile_count(texture);
  }
  writer_.reserve(tiles * sizeof(TextureTile) + textures_.size() * options_.page_size_bytes);
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    if (is_shown(scene_.textures[i])) {
      write_tiles(scene_.textures[i], textures_[i], writer_);
      counts().texture_tiles += tile_count(textures_[i]);
    }
    if (expendable_ != nullptr) {
      forget_texels(expendable_->textures[i]);
    }
  }
}

void DatabaseBuilder::write_normals(Conversion& conversion) {
  counts().normals += conversion.smooth.size();
  for (const Conversion::Smooth& smooth : conversion.smooth) {
    conversion.shading[smooth.primitive] = ShadingReference::smooth(writer_.add(smooth.normals));
  }
  forget(conversion.smooth);
  counts().textured += conversion.textured.size();
  for (Conversion::Textured& textured : conversion.textured) {
    if (textured.texture != Material::no_texture) {
      textured.normals.texture = textures_[textured.texture];
    }
    conversion.shading[textured.primitive] = ShadingReference::smooth(add_textured(textured));
  }
  forget(conversion.textured);
}

Address DatabaseBuilder::add_textured(Conversion::Textured& triangle) {
  if (!options_.for_paths || triangle.facets == Microfacets::no_texture) {
    return writer_.add(triangle.normals);
  }
  expect(triangle.texture != Material::no_texture, "a texture of metal and roughness lies where that of a colour does");
  ++counts().faceted;
  triangle.normals.has_facets = 1;
  return writer_.add(FacetedNormals{.textured = triangle.normals, .facets = textures_[triangle.facets]});
}

}  // namespace dmpc::core
