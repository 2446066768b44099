#include "apps/embree.h"

#include "core/expect.h"

namespace dmpc::apps::embree {

RTCGeometry triangle_mesh(RTCDevice device, std::span<const core::PrimitiveValues> primitives,
                          std::span<const std::uint32_t> ids) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * ids.size()));
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), ids.size()));
  core::expect(vertices != nullptr && indices != nullptr, "Embree has memory for the triangles");
  for (std::size_t index = 0; index < ids.size(); ++index) {
    for (std::size_t k = 0; k < 9; ++k) {
      vertices[9 * index + k] = primitives[ids[index]].value[k];
    }
    for (std::size_t k = 3 * index; k < 3 * index + 3; ++k) {
      indices[k] = static_cast<unsigned>(k);
    }
  }
  return geometry;
}

}  // namespace dmpc::apps::embree
