#include "apps/foreign/gltf/meshopt.h"

#include <meshoptimizer.h>

#include <cstdint>
#include <string>

namespace dmpc::apps::gltf {
namespace {

struct Layout {
  std::string mode, filter;
  std::uint64_t count = 0, stride = 0;
};

/// What the library asserts, as input that is refused.
void check(const Part& packing, const Layout& layout) {
  const bool is_list = layout.mode == "TRIANGLES" || layout.mode == "INDICES";
  const bool has_stride =
      is_list ? layout.stride == 2 || layout.stride == 4 : layout.stride > 0 && layout.stride <= 256 && layout.stride % 4 == 0;
  const bool has_filter_stride = layout.filter == "OCTAHEDRAL"   ? layout.stride == 4 || layout.stride == 8
                                 : layout.filter == "QUATERNION" ? layout.stride == 8
                                                                 : true;
  if (!has_stride || !has_filter_stride || (is_list && layout.filter != "NONE") ||
      (layout.mode == "TRIANGLES" && layout.count % 3 != 0)) {
    packing.fail("mode, filter, byteStride and count do not go together");
  }
}

int decode(const Layout& layout, std::vector<std::byte>& result, const unsigned char* bytes, std::size_t size) {
  if (layout.mode == "TRIANGLES") {
    return meshopt_decodeIndexBuffer(result.data(), layout.count, layout.stride, bytes, size);
  }
  return layout.mode == "INDICES" ? meshopt_decodeIndexSequence(result.data(), layout.count, layout.stride, bytes, size)
                                  : meshopt_decodeVertexBuffer(result.data(), layout.count, layout.stride, bytes, size);
}

void apply_filter(const Layout& layout, std::vector<std::byte>& result) {
  if (layout.filter == "OCTAHEDRAL") {
    meshopt_decodeFilterOct(result.data(), layout.count, layout.stride);
  } else if (layout.filter == "QUATERNION") {
    meshopt_decodeFilterQuat(result.data(), layout.count, layout.stride);
  } else if (layout.filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(result.data(), layout.count, layout.stride);
  }
}

}  // namespace

std::optional<Part> packing_of(const Part& view) { return view.extension("EXT_meshopt_compression"); }

std::vector<std::byte> unpacked(const Part& packing, std::span<const std::byte> packed) {
  const Layout layout{packing.choice("mode", {"ATTRIBUTES", "TRIANGLES", "INDICES"}),
                      packing.choice("filter", {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"}, "NONE"),
                      packing.get("count").as_whole(), packing.get("byteStride").as_whole()};
  check(packing, layout);
  // A byte stands for at most 16 elements (of four bytes, all alike), so a number too large is no call for memory.
  if (layout.count > (packed.size() + 1) * 64) {
    packing.fail("says that " + std::to_string(packed.size()) + " bytes hold " + std::to_string(layout.count) + " elements");
  }
  std::vector<std::byte> result(layout.count * layout.stride);
  if (decode(layout, result, reinterpret_cast<const unsigned char*>(packed.data()), packed.size()) != 0) {
    packing.fail("the packed bytes are damaged: meshoptimizer cannot unpack them");
  }
  apply_filter(layout, result);
  return result;
}

}  // namespace dmpc::apps::gltf
