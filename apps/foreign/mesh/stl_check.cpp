#include "apps/foreign/mesh/stl_check.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include "apps/edge/system/byte_order_mark.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::size_t header_bytes = 80, facet_bytes = 50;

/// Files in binary begin with "solid", too, now and then.
bool is_text(std::string_view file) {
  const std::string_view beginning = file.substr(0, 1000);
  return beginning.substr(0, beginning.find_first_not_of(" \t\r\n") + 5).find("solid") != std::string_view::npos &&
         std::none_of(beginning.begin(), beginning.end(), [](char letter) { return letter == '\0'; });
}

void check_text(std::string_view file) {
  const std::size_t end = file.rfind("endsolid"), facet = file.rfind("endfacet");
  const bool is_whole = end != std::string_view::npos && (facet == std::string_view::npos || facet < end);
  if (!is_whole) {
    throw core::InputError("the file is cut short: it does not end with 'endsolid'");
  }
}

void check_binary(std::string_view file) {
  std::uint32_t count = 0;
  if (file.size() < header_bytes + sizeof count) {
    throw core::InputError("is no STL: it neither begins with 'solid' nor has the 84 bytes with which binary ones begin");
  }
  std::memcpy(&count, file.data() + header_bytes, sizeof count);
  const std::uint64_t room = (file.size() - header_bytes - sizeof count) / facet_bytes;
  if (room < count) {
    throw core::InputError("the file is cut short: it has room for " + std::to_string(room) + " facets, and says that it has " +
                           std::to_string(count));
  }
}

}  // namespace

std::string_view stl_without_mark(std::string_view file) {
  const std::string_view rest = without_mark(file);
  return is_text(rest) ? rest : file;
}

bool has_stl_colour(std::string_view file) {
  return !is_text(file) && file.substr(0, header_bytes).find("COLOR=") != std::string_view::npos;
}

void check_stl(std::string_view file) { is_text(file) ? check_text(file) : check_binary(file); }

}  // namespace dmpc::apps
