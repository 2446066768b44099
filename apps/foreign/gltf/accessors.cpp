#include "apps/foreign/gltf/accessors.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <string>

namespace dmpc::apps::gltf {
namespace {

using Bytes = std::span<const std::byte>;

/// glTF's numbers for types of numbers, which are OpenGL's.
enum class Number : std::uint16_t { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };

std::size_t bytes_of(Number type) {
  return type == Number::int8 || type == Number::uint8 ? 1 : type == Number::int16 || type == Number::uint16 ? 2 : 4;
}

Number number_of(const Part& part) {
  const Part type = part.get("componentType");
  const std::uint64_t code = type.as_whole();
  if (code < 5120 || code > 5126 || code == 5124) {
    type.fail("is " + std::to_string(code) + ", expected 5120 to 5123, 5125 or 5126");
  }
  return static_cast<Number>(code);
}

std::size_t width_of(const Part& accessor) {
  static const std::map<std::string, std::size_t> widths = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                            {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
  const Part type = accessor.get("type");
  const auto found = widths.find(type.as_text());
  return found == widths.end() ? (type.fail("is '" + type.as_text() + "', expected SCALAR, VEC2, VEC3 or VEC4"), 0)
                               : found->second;
}

template <class T>
T at(const std::byte* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

template <class T>
float integer(const std::byte* bytes, bool is_normalized) {
  const auto value = static_cast<float>(at<T>(bytes));
  return is_normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0F) : value;
}

float float_at(const std::byte* bytes, Number type, bool is_normalized) {
  switch (type) {
    case Number::int8:
      return integer<std::int8_t>(bytes, is_normalized);
    case Number::uint8:
      return integer<std::uint8_t>(bytes, is_normalized);
    case Number::int16:
      return integer<std::int16_t>(bytes, is_normalized);
    case Number::uint16:
      return integer<std::uint16_t>(bytes, is_normalized);
    case Number::uint32:
      return integer<std::uint32_t>(bytes, is_normalized);
    case Number::float32:
      return at<float>(bytes);
  }
  return 0;
}

std::uint32_t index_at(const std::byte* bytes, Number type) {
  return type == Number::uint8    ? at<std::uint8_t>(bytes)
         : type == Number::uint16 ? at<std::uint16_t>(bytes)
                                  : at<std::uint32_t>(bytes);
}

void check_is_index(const Part& part, Number type) {
  if (type != Number::uint8 && type != Number::uint16 && type != Number::uint32) {
    part.fail("the componentType is " + std::to_string(static_cast<int>(type)) + ", expected one of indices: 5121, 5123 or 5125");
  }
}

/// Elements that lie at equal distances in a view.
struct Row {
  Bytes bytes;
  std::size_t stride = 0;

  const std::byte* operator[](std::size_t i) const { return bytes.data() + i * stride; }
};

/// The elements of `part`, which names a view and perhaps an offset in it.
Row row_of(Buffers& buffers, const Part& part, std::uint64_t count, std::size_t element_bytes) {
  const View view = buffers.view(part.required_index("bufferView", buffers.view_count(), "bufferViews"));
  const std::uint64_t offset = part.whole("byteOffset", 0);
  const std::uint64_t stride = view.stride_bytes == 0 ? element_bytes : view.stride_bytes;
  if (stride < element_bytes) {
    part.fail("has elements of " + std::to_string(element_bytes) + " bytes in a view with a byteStride of " +
              std::to_string(stride));
  }
  const std::uint64_t room = offset <= view.bytes.size() ? view.bytes.size() - offset : 0;
  if (count > 0 && (room < element_bytes || (room - element_bytes) / stride < count - 1)) {
    part.fail(std::to_string(count) + " elements of " + std::to_string(element_bytes) + " bytes from byte " +
              std::to_string(offset) + " on reach beyond their view, which has " + std::to_string(view.bytes.size()) + " bytes");
  }
  return {view.bytes.subspan(count > 0 ? offset : 0), stride};
}

/// Calls take(index, bytes of the value) for each element that a sparse accessor replaces.
template <class Take>
void for_each_replaced(Buffers& buffers, const Part& accessor, std::size_t element_bytes, const Take& take) {
  const auto sparse = accessor.find("sparse");
  if (!sparse) {
    return;
  }
  const std::uint64_t count = sparse->get("count").as_whole(), all = accessor.get("count").as_whole();
  const Part places = sparse->get("indices");
  const Number type = number_of(places);
  check_is_index(places, type);
  const Row indices = row_of(buffers, places, count, bytes_of(type));
  const Row values = row_of(buffers, sparse->get("values"), count, element_bytes);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t index = index_at(indices[i], type);
    if (index >= all) {
      places.fail("entry " + std::to_string(i) + " is " + std::to_string(index) + ", and there are but " + std::to_string(all));
    }
    take(index, values[i]);
  }
}

/// The numbers of all its elements, `width` each, as `take` makes them of bytes. `stored`: the type whose bytes stay as they are.
template <class T, class Take>
std::vector<T> numbers_of(Buffers& buffers, SceneTotals& totals, const Part& accessor, std::size_t width, Number stored,
                          const Take& take) {
  const Number type = number_of(accessor);
  const std::uint64_t count = accessor.get("count").as_whole();
  const std::size_t number_bytes = bytes_of(type), element_bytes = width * number_bytes;
  const bool has_view = accessor.find("bufferView").has_value();
  if (!has_view) {  // zeros, as many as it likes
    totals.add({.bytes = count * width * sizeof(T)}, [&accessor] { return accessor.where() + ": "; });
  }
  const Row row = has_view ? row_of(buffers, accessor, count, element_bytes) : Row{};
  std::vector<T> numbers(count * width);
  const auto take_element = [&](std::size_t i, const std::byte* bytes) {
    for (std::size_t k = 0; k < width; ++k) {
      numbers[i * width + k] = take(bytes + k * number_bytes, type);
    }
  };
  if (type == stored && row.stride == element_bytes && count > 0) {  // most files' vertices, and large ones' indices
    std::memcpy(numbers.data(), row[0], count * element_bytes);
  } else {
    for (std::size_t i = 0; i < count && row.stride > 0; ++i) {
      take_element(i, row[i]);
    }
  }
  for_each_replaced(buffers, accessor, element_bytes, take_element);
  return numbers;
}

}  // namespace

const Part& Accessors::accessor(const Part& where) const { return accessors_[where.as_index(count(), "accessors")]; }

std::uint64_t Accessors::count_of(const Part& where) { return accessor(where).get("count").as_whole(); }

Values Accessors::values(const Part& where, std::size_t width, std::size_t other_width) {
  const Part& part = accessor(where);
  const std::size_t numbers = width_of(part);
  if (numbers != width && numbers != other_width) {
    where.fail("refers to " + part.where() + ", whose type is " + part.get("type").as_text() + "; expected " +
               std::to_string(width) + " numbers");
  }
  const auto take = [is_normalized = part.flag("normalized")](const std::byte* bytes, Number type) {
    return float_at(bytes, type, is_normalized);
  };
  return {numbers, numbers_of<float>(buffers_, totals_, part, numbers, Number::float32, take)};
}

std::vector<std::uint32_t> Accessors::indices(const Part& where) {
  const Part& part = accessor(where);
  if (width_of(part) != 1) {
    where.fail("refers to " + part.where() + ", whose type is " + part.get("type").as_text() + "; expected SCALAR");
  }
  check_is_index(part, number_of(part));
  return numbers_of<std::uint32_t>(buffers_, totals_, part, 1, Number::uint32, index_at);
}

}  // namespace dmpc::apps::gltf
