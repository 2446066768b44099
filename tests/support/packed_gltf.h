// A glTF quad in many packings, of which all hold the same numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/support/mesh_files.h"

namespace dmpc::tests {

/// A document that is put together view by view.
class GltfDocument {
 public:
  /// A buffer view of these bytes, in the document's one buffer; `more` are further members, after a comma.
  std::size_t view(const std::string& bytes, const std::string& more = "") {
    bytes_.resize((bytes_.size() + 7) / 8 * 8);
    views_.push_back(R"({"buffer":0,"byteOffset":)" + std::to_string(bytes_.size()) + R"(,"byteLength":)" +
                     std::to_string(bytes.size()) + (more.empty() ? "" : "," + more) + "}");
    bytes_ += bytes;
    return views_.size() - 1;
  }
  /// A view that stands in no buffer but holds what `bytes` unpack to.
  std::size_t packed_view(const std::string& bytes, std::size_t stride, std::size_t count, const std::string& mode,
                          const std::string& filter = "NONE") {
    bytes_.resize((bytes_.size() + 7) / 8 * 8);
    views_.push_back(R"({"buffer":1,"byteLength":)" + std::to_string(stride * count) +
                     R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":)" + std::to_string(bytes_.size()) +
                     R"(,"byteLength":)" + std::to_string(bytes.size()) + R"(,"byteStride":)" + std::to_string(stride) +
                     R"(,"count":)" + std::to_string(count) + R"(,"mode":")" + mode + R"(","filter":")" + filter + R"("}}})");
    bytes_ += bytes;
    return views_.size() - 1;
  }
  std::size_t accessor(std::size_t view, int component_type, std::size_t count, const std::string& type,
                       const std::string& more = "") {
    return accessor(R"("bufferView":)" + std::to_string(view) + (more.empty() ? "" : "," + more), component_type, count, type);
  }
  std::size_t accessor(const std::string& members, int component_type, std::size_t count, const std::string& type) {
    accessors_.push_back("{" + members + (members.empty() ? "" : ",") + R"("componentType":)" + std::to_string(component_type) +
                         R"(,"count":)" + std::to_string(count) + R"(,"type":")" + type + "\"}");
    return accessors_.size() - 1;
  }
  /// Adds rows of `width` numbers, as they are; returns the accessor's number as text.
  template <class List>
  std::string add(const List& numbers, std::size_t width, const std::string& more = "") {
    using T = typename List::value_type;
    constexpr int type = std::is_floating_point_v<T> ? 5126
                                                     : 5120 +
                                                           (sizeof(T) == 4   ? 5
                                                            : sizeof(T) == 2 ? 2
                                                                             : 0) +
                                                           (std::is_unsigned_v<T> && sizeof(T) < 4 ? 1 : 0);
    std::string bytes;
    for (const T& number : numbers) {
      bytes += bytes_of(number);
    }
    const std::string kind = width == 1 ? "SCALAR" : width == 16 ? "MAT4" : "VEC" + std::to_string(width);
    return std::to_string(accessor(view(bytes), type, numbers.size() / width, kind, more));
  }

  /// One mesh with this one primitive; `more` are further members of the outermost object.
  std::string text(const std::string& primitive, const std::string& more = "") const {
    return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[)" + node + R"(],"meshes":[{"primitives":[)" +
           primitive + R"(]}],"accessors":[)" + joined(accessors_) + R"(],"bufferViews":[)" + joined(views_) +
           R"(],"buffers":[{"uri":"data:application/octet-stream;base64,)" + base64(bytes_) + R"(","byteLength":)" +
           std::to_string(bytes_.size()) + R"(},{"byteLength":1000000}])" + (more.empty() ? "" : "," + more) + "}";
  }

  std::string node = R"({"mesh":0})";

 private:
  static std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) {
      text += (text.empty() ? "" : ",") + part;
    }
    return text;
  }

  std::string bytes_;
  std::vector<std::string> views_, accessors_;
};

}  // namespace dmpc::tests
