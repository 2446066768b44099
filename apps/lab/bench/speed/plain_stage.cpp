#include "apps/lab/bench/speed/plain_stage.h"

#include <algorithm>

#include "core/picture/hits/hit_geometry.h"

namespace dmpc::apps {

namespace {

using core::Vec3d;
using core::Vec3f;

template <class Record>
std::vector<Record> records_at(const core::LocalRecords& records, core::Address first, std::uint32_t count) {
  std::vector<Record> copies(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    copies[i] = core::read<Record>(records.find(core::advance(first, i * sizeof(Record))));
  }
  return copies;
}

/// Materials from all records, including material extensions, which are not referenced by number.
std::vector<PlainMaterial> materials_in(const core::LocalRecords& records, const core::DatabaseHeader& header) {
  std::vector<PlainMaterial> materials;
  for (const auto& record : records_at<core::MaterialRecord>(records, header.materials, header.material_count)) {
    materials.emplace_back(record);
  }
  std::size_t count = materials.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (materials[i].has_extension()) {
      const std::uint32_t place = materials[i].finish();
      count = std::min<std::size_t>(count, place);
      const std::byte* const finish =
          records.find(core::advance(header.materials, place * sizeof(core::MaterialExtensionRecord)));
      materials[i].has_microfacets() ? materials[i].add(core::read<core::MicrofacetRecord>(finish))
                                     : materials[i].add(core::read<core::MaterialExtensionRecord>(finish));
    }
  }
  return materials;
}

}  // namespace

/// on_film() is linear, so its values for the axes are the camera.
PlainCamera::PlainCamera(const core::Camera& camera) : eye(camera.eye()) {
  const double middle_x = 0.5 * (camera.width() - 1), middle_y = 0.5 * (camera.height() - 1);
  Vec3d forward, rightward, downward;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3d unit;
    unit[axis] = 1;
    const Vec3d seen = camera.on_film(unit);
    forward[axis] = seen.z;
    rightward[axis] = seen.x - middle_x * seen.z;
    downward[axis] = seen.y - middle_y * seen.z;
  }
  rightward = rightward * (1 / dot(rightward, rightward));
  downward = downward * (1 / dot(downward, downward));
  right = rightward;
  down = downward;
  corner = forward - rightward * middle_x - downward * middle_y;
}

void PlainMaterial::add(const core::MaterialExtensionRecord& finish) {
  highlight = finish.specular + color * specular;
  mirror = static_cast<float>(finish.mirror) / float{core::MaterialExtensionRecord::share_max};
  emission = finish.emission;
  refraction_index = finish.refraction_index;
}

/// The microfacets replace the material's highlight and mirror.
void PlainMaterial::add(const core::MicrofacetRecord& finish) {
  facets = {finish.metallic, finish.alpha, finish.reflectance, specular};
  highlight = {};
  emission = finish.emission;
  refraction_index = finish.refraction_index;
}

PlainStage::PlainStage(const Subject& subject)
    : settings_(subject.settings),
      records_(subject.database.bytes()),
      tree_(subject.database.primitives(), EmbreeMode::robust),
      camera_(settings_.camera),
      materials_(materials_in(records_, settings_.header)),
      lights_(records_at<core::LightRecord>(records_, settings_.header.lights, settings_.header.light_count)),
      emitters_(records_at<core::EmitterRecord>(records_, settings_.header.emitters, settings_.header.emitter_count)),
      choices_(records_at<core::ChoiceNode>(records_, core::choice_address(settings_.header, 0),
                                            core::choice_node_count(settings_.header.emitter_count))) {
  const PlainShapes& shapes = tree_.shapes();
  const std::vector<core::Database::Place> places = subject.database.find_places();
  shading_.reserve(shapes.triangles.size() + shapes.curved.size());
  for (const std::vector<std::uint32_t>* const ids : {&shapes.triangles, &shapes.curved}) {
    for (const std::uint32_t id : *ids) {
      core::HitState state;
      state.hit.lane = places[id].lane;
      core::read_surface(state, records_.find(places[id].leaf));
      shading_.push_back(state.shading);
    }
  }
}

/// The distance is solved again, since Embree's is a float.
PlainSurface PlainStage::curved_at(unsigned curved, const Vec3d& origin, const Vec3d& direction, float t) const {
  constexpr double rounding = 0x1p-20;
  const PlainQuadric& quadric = tree_.shapes().quadrics[curved];
  const double exact = quadric.distance(origin, direction, double{t} * (1 - rounding), double{t} * (1 + rounding));
  PlainSurface surface{.is_curved = true, .exact_point = origin + direction * (exact > 0 ? exact : double{t})};
  const Vec3d normal = quadric.normal_at(surface.exact_point);
  surface.point = Vec3f(surface.exact_point);
  surface.is_leaving = dot(direction, normal) > 0;
  surface.exact_normal = surface.is_leaving ? -normal : normal;
  surface.geometric_normal = Vec3f(normal);
  surface.normal = Vec3f(surface.exact_normal);
  surface.material = shading_[tree_.shapes().triangles.size() + curved].material();
  surface.radius = static_cast<float>(quadric.sphere_radius());
  return surface;
}

}  // namespace dmpc::apps
