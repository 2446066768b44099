// Any bytes as OBJ or MTL, which Assimp reads and we look through beforehand: OBJ is refused with core::InputError, or let pass;
// MTL is made plain, once for all. The first byte says which.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "apps/edge/system/byte_order_mark.h"
#include "apps/foreign/mesh/mtl_text.h"
#include "apps/foreign/mesh/obj_check.h"
#include "core/base/expect.h"
#include "tests/fuzz/targets.h"

namespace dmpc::fuzz {

namespace {

using Check = void (*)(std::string_view file);

void check_mtl(std::string_view file) {
  apps::MtlTextures textures, none;
  const std::string plain = apps::plain_mtl("a.mtl", file, textures).text;
  core::expect(plain.size() <= file.size() + 1, "options are left out");
  const bool is_marked = plain.starts_with(apps::byte_order_mark);
  core::expect(is_marked || apps::plain_mtl("a.mtl", plain, none).text == plain, "what is plain stays so");
  core::expect(is_marked || none.left_out.empty(), "what is plain has no option but -clamp");
}

}  // namespace

void try_mesh_text(const std::uint8_t* data, std::size_t size) {
  constexpr std::array<Check, 2> checks{apps::check_obj, check_mtl};
  if (size == 0) {
    return;
  }
  const std::string_view file(reinterpret_cast<const char*>(data) + 1, size - 1);
  constexpr std::array<const char*, 2> kinds{"OBJ", "MTL"};
  const std::size_t kind = data[0] % checks.size();
  bool is_refused = false;
  try {
    checks[kind](file);
  } catch (const core::InputError& error) {
    core::expect(!std::string_view(error.what()).empty(), "who refuses says why");
    is_refused = true;
  }
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    covered().count(std::string(kinds[i]) + " let pass", i == kind && !is_refused);
    if (checks[i] != check_mtl) {  // which refuses nothing
      covered().count(std::string(kinds[i]) + " refused", i == kind && is_refused);
    }
  }
}

}  // namespace dmpc::fuzz
