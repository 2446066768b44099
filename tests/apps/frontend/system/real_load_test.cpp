#include "apps/frontend/system/real_load.h"

#include <doctest/doctest.h>

#include <string>

namespace dmpc::tests::real_load_test {

TEST_CASE("the machine has a core and no load below nothing") {
  CHECK(apps::core_count() >= 1);
  CHECK(apps::machine_load() >= 0);
}

TEST_CASE("the note on the load has that of before, that of now, and the cores") {
  const std::string note = apps::load_note(1.25);
  CHECK(note.starts_with("Load of the machine, whose cores are " + std::to_string(apps::core_count()) + ": 1.2 before, "));
  CHECK(note.ends_with(" after."));
}

}  // namespace dmpc::tests::real_load_test
