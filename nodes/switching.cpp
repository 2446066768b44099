#include "nodes/switching.h"

#include <string>

#include "core/base/expect.h"

namespace dmpc::nodes {

std::string_view name_of(Switching switching) { return switching == Switching::circuit ? "circuit" : "packet"; }

Switching parse_switching(std::string_view name) {
  for (const Switching switching : {Switching::circuit, Switching::packet}) {
    if (name == name_of(switching)) {
      return switching;
    }
  }
  throw core::InputError("there is no switching \"" + std::string(name) + "\": use circuit or packet");
}

}  // namespace dmpc::nodes
