#include "core/picture/hits/hit_state.h"

#include "core/base/expect.h"
#include "core/record/emitter.h"
#include "core/record/sky.h"
#include "core/scene/sky_cells.h"

namespace dmpc::core {

HitState begin_sky(const Ray& ray) {
  HitState state = begin_shading(ray, {});
  state.stage = HitState::Stage::sky;
  return state;
}

Address sky_record(const Ray& ray, const DatabaseHeader& header) {
  return sky_tile_address(header.sky, sky_place(header.sky, ray.full_direction()).tile);
}

RecordKind record_kind_of(const HitState& state) {
  switch (state.stage) {
    case HitState::Stage::instance:
    case HitState::Stage::placed_normals:
    case HitState::Stage::geometry:
      return RecordKind::leaf;
    case HitState::Stage::normals:
    case HitState::Stage::color_texture:
      return RecordKind::normals;
    case HitState::Stage::texture:
    case HitState::Stage::sky:
    case HitState::Stage::sky_aim:
      return RecordKind::tile;
    default:
      break;
  }
  expect(false, "tables, materials, lights and emitters are never absent by themselves");
  return RecordKind::leaf;
}

Address record_needed(const HitState& state, const DatabaseHeader& header) {
  switch (state.stage) {
    case HitState::Stage::instance:
    case HitState::Stage::placed_normals:
      return instance_of(state.hit);
    case HitState::Stage::geometry:
      return state.hit.leaf;
    case HitState::Stage::normals:
    case HitState::Stage::color_texture:
      return state.shading.normals();
    case HitState::Stage::texture:
      return record_needed(state.lookup);
    case HitState::Stage::material:
    case HitState::Stage::textured_material:
      return advance(header.materials, state.shading.material() * sizeof(MaterialRecord));
    case HitState::Stage::finish:
      return advance(header.materials, state.surface.material.finish() * sizeof(MaterialExtensionRecord));
    case HitState::Stage::light:
      return advance(header.lights, state.surface.next_light * sizeof(LightRecord));
    case HitState::Stage::emitter_choice:
      return choice_address(header, state.choosing().node);
    case HitState::Stage::emitter:
      return emitter_address(header, state.surface.next_light);
    case HitState::Stage::sky:
      return sky_record(state.ray, header);
    case HitState::Stage::sky_choice:
      return sky_choice_address(header.sky, state.choosing().node);
    case HitState::Stage::sky_aim:
      return sky_tile_address(header.sky, state.surface.next_light);
    default:
      return no_address;
  }
}

}  // namespace dmpc::core
