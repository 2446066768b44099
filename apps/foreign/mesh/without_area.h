// The error about a file of which nothing is seen, with what was said of it.
#pragma once

#include <string>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps {

/// Throws core::InputError "WHAT; expected a mesh of triangles or polygons", and the notes, a line each, which may say why.
[[noreturn]] inline void refuse_without_area(const std::string& what, const std::vector<std::string>& notes) {
  std::string text = what + "; expected a mesh of triangles or polygons";
  for (const std::string& note : notes) {
    text += "\n  " + note;
  }
  throw core::InputError(text);
}

}  // namespace dmpc::apps
