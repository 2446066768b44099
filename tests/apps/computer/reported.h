// The page that a program writes.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/apps/computer/ran.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests {

/// What run(words) writes with --report, without a complaint.
template <class Run>
std::string reported(const Run& run, std::vector<std::string> words) {
  const TemporaryFolder folder;
  const std::string file = folder / "page.html";
  words.push_back("--report=" + file);
  const Ran ran = run(words);
  REQUIRE_MESSAGE(ran.status == 0, ran.errors);
  CHECK_MESSAGE(ran.errors.empty(), ran.errors);
  return file_text(file);
}

inline void check_has(const std::string& page, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    CHECK_MESSAGE(contains(page, part), part);
  }
}

/// A page of a program speaks of neither rays nor pictures.
inline void check_knows_no_rays(const std::string& page) {
  for (const std::string word : {"ray", "rays", "pixel", "pixels", "scene", "film", "shading", "tracing", "quantum", "host"}) {
    for (const std::string after : {" ", ".", "<", ","}) {
      CHECK_MESSAGE(!contains(page, " " + word + after), word);
    }
  }
}

}  // namespace dmpc::tests
