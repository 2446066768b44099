#include <draco/compression/decode.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>

#include "apps/foreign/gltf/primitive.h"

namespace dmpc::apps::gltf {
namespace {

std::unique_ptr<draco::Mesh> unpacked_mesh(const Part& packing, std::span<const std::byte> bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
  if (!mesh.ok()) {
    packing.fail("Draco cannot unpack it: " + mesh.status().error_msg_string());
  }
  return std::move(mesh).value();
}

/// Colours and weights are shares, which glTF keeps as numbers of bytes or words; some writers say so to the accessor alone, and
/// not in the packed bytes (glTF 2.0, 3.7.2.1).
float whole_of(const draco::PointAttribute& attribute, const std::string& name) {
  const bool is_share = name.starts_with("COLOR") || name.starts_with("WEIGHTS");
  if (!is_share || attribute.normalized()) {
    return 1;
  }
  return attribute.data_type() == draco::DT_UINT8 ? 255.0F : attribute.data_type() == draco::DT_UINT16 ? 65535.0F : 1.0F;
}

/// Each value over `whole_of()` it.
Values values_of(const draco::Mesh& mesh, const std::string& name, const Part& id, std::size_t wanted) {
  const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id.as_whole()));
  const std::size_t width = attribute == nullptr ? 0 : static_cast<std::size_t>(attribute->num_components());
  if (width != wanted && !(wanted == color_width && width == opaque_color_width)) {
    id.fail(attribute == nullptr ? "the packed bytes have no such attribute"
                                 : "the packed attribute has another number of components");
  }
  Values values{width, std::vector<float>(mesh.num_points() * width)};
  for (std::uint32_t point = 0; point < mesh.num_points(); ++point) {
    const draco::AttributeValueIndex index = attribute->mapped_index(draco::PointIndex(point));
    if (index.value() >= attribute->size() ||
        !attribute->ConvertValue(index, static_cast<std::int8_t>(width), &values.numbers[point * width])) {
      id.fail("the packed attribute has a value that cannot be read");
    }
  }
  const float whole = whole_of(*attribute, name);
  std::transform(values.numbers.begin(), values.numbers.end(), values.numbers.begin(),
                 [whole](float value) { return value / whole; });
  return values;
}

}  // namespace

Primitive read_draco(const Part& packing, Buffers& buffers, const std::map<std::string, std::size_t>& widths) {
  const View view = buffers.view(packing.required_index("bufferView", buffers.view_count(), "bufferViews"));
  const auto mesh = unpacked_mesh(packing, view.bytes);
  Primitive result;
  for (const auto& [name, width] : widths) {
    result.attributes[name] = values_of(*mesh, name, packing.get("attributes").get(name), width);
  }
  for (std::uint32_t face = 0; face < mesh->num_faces(); ++face) {
    for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(face))) {
      result.indices.push_back(corner.value());
    }
  }
  return result;
}

}  // namespace dmpc::apps::gltf
