#include "apps/formats/landscape/names.h"

#include <algorithm>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

constexpr int picture_side_max = 4096;
/// The ground below trees is this many sizes larger than the grove, up to the second number.
constexpr int ground_beyond_grove = 3, ground_of_grove_max = 10;

/// The size that a name of a family says.
std::optional<int> size_said(std::string_view name, const std::string& family, int size_default, int size_max) {
  if (name.substr(0, family.size()) != family) {
    return std::nullopt;
  }
  for (int size = 1; size <= size_max; ++size) {
    if (name == family + "-" + std::to_string(size)) {
      return size;
    }
  }
  if (name == family) {
    return size_default;
  }
  throw core::InputError("'" + std::string(name) + "': expected " + family + " or " + family + "-N, N from 1 to " +
                         std::to_string(size_max));
}

}  // namespace

std::optional<int> landscape_size(std::string_view name) {
  return size_said(name, "landscape", landscape_size_default, landscape_size_max);
}

std::optional<int> grove_size(std::string_view name) { return size_said(name, "grove", grove_size_default, grove_size_max); }

int ground_size(int grove_size) { return std::min(grove_size + ground_beyond_grove, ground_of_grove_max); }

int ground_picture_side(int size) { return std::min(picture_side_max, 4 << size); }

}  // namespace dmpc::apps
