#include "core/base/refusal.h"

namespace dmpc::core {

std::string Sentence::text(const FieldNames& name_of) const {
  std::string text;
  for (const auto& part : parts_) {
    const Field* const field = std::get_if<Field>(&part);
    text += field != nullptr ? name_of(*field) : std::string_view(std::get<std::string>(part));
  }
  return text;
}

}  // namespace dmpc::core
