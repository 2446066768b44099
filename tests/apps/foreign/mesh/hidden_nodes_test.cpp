#include "apps/foreign/mesh/hidden_nodes.h"

#include <doctest/doctest.h>

#include <string>

#include "tests/support/mesh_files.h"

namespace dmpc::tests::hidden_nodes_test {

namespace {

std::string packed(const std::string& text) { return "S" + bytes_of(static_cast<std::uint32_t>(text.size())) + text; }

}  // namespace

TEST_CASE("objects that an FBX file switches off are counted, in text and in binary") {
  CHECK(apps::count_hidden_nodes("P: \"Visibility\", \"Visibility\", \"\", \"A\",0\nP: \"Show\", \"bool\", \"\", \"\",0\r\n") ==
        2);
  CHECK(apps::count_hidden_nodes("P: \"Visibility\", \"Visibility\", \"\", \"A\",1\nP: \"Show\", \"bool\", \"\", \"\",1") == 0);
  const std::string head = "Kaydara FBX Binary  ",
                    property = packed("Visibility") + packed("Visibility") + packed("") + packed("A");
  CHECK(apps::count_hidden_nodes(head + property + "D" + bytes_of(0.0) + property + "D" + bytes_of(1.0)) == 1);
  CHECK(apps::count_hidden_nodes(head + packed("Show") + packed("bool") + packed("") + packed("") + "I" + bytes_of(0)) == 1);
  CHECK(apps::count_hidden_nodes(head + property + "D") == 0);
  CHECK(apps::count_hidden_nodes(head + property) == 0);
}

}  // namespace dmpc::tests::hidden_nodes_test
