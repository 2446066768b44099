#include "apps/foreign/mesh/xml_counts.h"

#include <doctest/doctest.h>

#include <string>

#include "core/base/expect.h"

namespace dmpc::tests::xml_counts_test {

TEST_CASE("arrays of Collada have as many values as they say, and accessors look at no more") {
  const auto check = [](const std::string& array, const std::string& accessor) {
    apps::check_counts("<float_array id='a' " + array + "</float_array>\n<accessor source='#a' " + accessor + "/>", "dae");
  };
  check("count='6'>1 2 3 4 5 6", "count='2' stride='3'");
  check("count='6'>\n1 2 3\n4 5 6\n", "count='2' offset='2' stride='2'");
  check("count='0'>", "count='0' stride='3'");
  CHECK_THROWS_WITH_AS(check("count='7'>1 2 3 4 5 6", "count='2' stride='3'"),
                       "line 1: an array says that it has 7 values, and has 6", core::InputError);
  CHECK_THROWS_WITH_AS(check("count='6'>1 2 3 4 5 6", "count='3' stride='3'"),
                       "line 2: an accessor looks at 9 values of an array that has 6", core::InputError);
  CHECK_THROWS_AS(check("count='6'>1 2 3 4 5 6", "count='2' stride='3' offset='1'"), core::InputError);
  CHECK_THROWS_AS(check("count='6'>1 2 3 4 5 6", "count='60' stride='60'"), core::InputError);
  for (const std::string lie : {"-1", "1e9", "4294967296", "18446744073709551616", ""}) {
    CAPTURE(lie);
    CHECK_THROWS_AS(check("count='" + lie + "'>1", "count='1'"), core::InputError);
    CHECK_THROWS_AS(check("count='1'>1", "count='" + lie + "'"), core::InputError);
  }
}

TEST_CASE("indices of Collada, and how many primitives there are, are whole numbers") {
  apps::check_counts("<triangles count='1'><p>0 1\n2</p></triangles><vcount>3 4</vcount><param name='X'/>", "dae");
  for (const std::string bad : {"12.7", "-1", "1x"}) {
    CHECK_THROWS_WITH_AS(apps::check_counts("<p>0 1\n" + bad + "</p>", "dae"),
                         ("line 2: found '" + bad + "', expected a whole number from 0 on").c_str(), core::InputError);
  }
  CHECK_THROWS_AS(apps::check_counts("<triangles count='4294967295'>", "dae"), core::InputError);
  CHECK_THROWS_AS(apps::check_counts("<triangles count='1.5'>", "dae"), core::InputError);
}

TEST_CASE("a vertex of AMF has three numbers, and a triangle three whole ones") {
  const std::string vertex = "<coordinates><x>1.5</x><y>-2</y><z>3e1</z></coordinates>";
  apps::check_counts(vertex + "<triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle>", "amf");
  CHECK_THROWS_WITH_AS(apps::check_counts("\n<coordinates><x>1</x><y>2</y></coordinates>", "amf"),
                       "line 2: expected an x, a y and a z", core::InputError);
  CHECK_THROWS_AS(apps::check_counts("<coordinates><x>1</x><y>2</y><z></z></coordinates>", "amf"), core::InputError);
  CHECK_THROWS_AS(apps::check_counts("<triangle><v1>0</v1><v2>1</v2></triangle>", "amf"), core::InputError);
  CHECK_THROWS_AS(apps::check_counts("<triangle><v1>0</v1><v2>1</v2><v3>1.9</v3></triangle>", "amf"), core::InputError);
  apps::check_counts("<p>1.5</p><coordinates></coordinates>", "fbx");
}

}  // namespace dmpc::tests::xml_counts_test
