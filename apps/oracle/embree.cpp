#include "apps/oracle/embree.h"

#include <array>

#include "apps/frontend/system/module.h"
#include "apps/oracle/curved.h"
#include "core/base/expect.h"

namespace dmpc::apps::embree {

namespace {

void set_bounds(const RTCBoundsFunctionArguments* arguments) {
  const Shapes& shapes = *static_cast<const Shapes*>(arguments->geometryUserPtr);
  const std::array<float, 6> box = bounds_of_curved(shapes.primitives[shapes.curved[arguments->primID]]);
  RTCBounds& bounds = *arguments->bounds_o;
  bounds.lower_x = box[0], bounds.lower_y = box[1], bounds.lower_z = box[2];
  bounds.upper_x = box[3], bounds.upper_y = box[4], bounds.upper_z = box[5];
}

}  // namespace

const Library& library() {
  static const auto* const opened = static_cast<const Library*>(open_module("embree", "asks Embree what rays hit"));
  return *opened;
}

OwnedScene::OwnedScene(RTCSceneFlags flags, RTCBuildQuality quality)
    : quality_(quality),
      device_(library_.new_device(nullptr)),
      scene_(device_ == nullptr ? nullptr : library_.new_scene(device_)) {
  core::expect(scene_ != nullptr, "Embree opens its device");
  library_.set_scene_flags(scene_, flags);
  library_.set_scene_build_quality(scene_, quality);
}

OwnedScene::~OwnedScene() {
  library_.release_scene(scene_);
  library_.release_device(device_);
}

void OwnedScene::attach(RTCGeometry geometry) {
  library_.set_geometry_build_quality(geometry, quality_);
  library_.commit_geometry(geometry);
  library_.attach_geometry(scene_, geometry);
  library_.release_geometry(geometry);
}

void OwnedScene::build() {
  library_.commit_scene(scene_);
  core::expect(library_.device_error(device_) == RTC_ERROR_NONE, "Embree builds the scene without an error");
}

Shapes::Shapes(std::span<const core::PrimitiveValues> given) : primitives(given) {
  for (std::uint32_t id = 0; id < given.size(); ++id) {
    (given[id].kind == core::PrimitiveKind::triangle ? triangles : curved).push_back(id);
  }
}

RTCGeometry triangle_mesh(RTCDevice device, const Shapes& shapes) {
  const std::vector<std::uint32_t>& ids = shapes.triangles;
  const Library& embree = library();
  RTCGeometry geometry = embree.new_geometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(
      embree.set_new_geometry_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * ids.size()));
  auto* indices = static_cast<unsigned*>(
      embree.set_new_geometry_buffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), ids.size()));
  core::expect(vertices != nullptr && indices != nullptr, "Embree has memory for the triangles");
  for (std::size_t index = 0; index < ids.size(); ++index) {
    for (std::size_t k = 0; k < 9; ++k) {
      vertices[9 * index + k] = shapes.primitives[ids[index]].value[k];
    }
    for (std::size_t k = 3 * index; k < 3 * index + 3; ++k) {
      indices[k] = static_cast<unsigned>(k);
    }
  }
  return geometry;
}

RTCGeometry curved_geometry(RTCDevice device, const Shapes& shapes, RTCIntersectFunctionN intersect,
                            RTCOccludedFunctionN occlude) {
  const Library& embree = library();
  RTCGeometry geometry = embree.new_geometry(device, RTC_GEOMETRY_TYPE_USER);
  embree.set_geometry_user_primitive_count(geometry, static_cast<unsigned>(shapes.curved.size()));
  embree.set_geometry_user_data(geometry, const_cast<Shapes*>(&shapes));
  embree.set_geometry_bounds_function(geometry, set_bounds, nullptr);
  embree.set_geometry_intersect_function(geometry, intersect);
  embree.set_geometry_occluded_function(geometry, occlude);
  return geometry;
}

}  // namespace dmpc::apps::embree
