#include "apps/frontend/machine/drawn_machine.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "apps/frontend/machine/machine_command.h"
#include "apps/frontend/machine/machine_file.h"
#include "core/trace/charge.h"

namespace dmpc::tests::drawn_machine_test {

namespace {

using apps::doubt_of;
using apps::drawn;

double factor(const nodes::Machine& drawn, core::Charge charge) {
  const auto i = static_cast<std::size_t>(charge);
  return static_cast<double>(drawn.cost_ps[i]) / static_cast<double>(apps::find_machine_preset("hdr")->machine.cost_ps[i]);
}

}  // namespace

TEST_CASE("a price may be off by the lowest certainty of its source, and of a price without one nothing is certain") {
  CHECK(doubt_of("quoted, high", "") == 1.1);
  CHECK(doubt_of("quoted, high; e-cube routing: quoted, medium", "") == 1.3);
  CHECK(doubt_of("below the slowdown", "") == 2);
  CHECK(doubt_of("", "") == 2);
  CHECK(doubt_of("measured", "") == 2);
  const char* const of_two = "750 us in all, high; the 160 us of each processor: assumed, low";
  CHECK(doubt_of(of_two, "") == 1.1);
  CHECK(doubt_of(of_two, "processor") == 2);
  CHECK(doubt_of("1 us in all, 0.3 us on each processor: quoted, medium", "") == 1.3);
  CHECK(doubt_of("assumed for page_install (low); one core, medium", "page_install") == 2);
  CHECK(doubt_of("assumed for page_install (low); one core, medium", "") == 1.3);
}

TEST_CASE("the presets say what is certain of them") {
  const auto doubt = [](const char* machine, const std::string& key, const char* part) {
    const auto& sources = apps::find_machine_preset(machine)->sources;
    return doubt_of(std::find_if(sources.begin(), sources.end(), [&](const auto& one) { return one.first == key; })->second,
                    part);
  };
  CHECK(doubt("hdr", "operation_ps", "") == 1.3);
  CHECK(doubt("ipsc2", "operation_ps", "") == 2);
  CHECK(doubt("ipsc2-1994", "operation_ps", "") == 1.3);
  CHECK(doubt("ipsc2-1994", "operation_ps", "page_install") == 2);
  CHECK(doubt("ipsc2", "long_message", "") == 1.1);
  CHECK(doubt("ipsc2", "long_message", "processor") == 2);
}

TEST_CASE("a draw moves prices within their doubts, what has one source together, and is the same again") {
  const apps::MachineDescription& hdr = *apps::find_machine_preset("hdr");
  double least = 1, most = 1;
  for (std::uint32_t draw = 0; draw < 100; ++draw) {
    const nodes::Machine machine = drawn(hdr, draw);
    const double shading = factor(machine, core::Charge::shading), look_up = factor(machine, core::Charge::cached_lookup);
    CHECK(shading == doctest::Approx(factor(machine, core::Charge::ray_setup)).epsilon(1e-3));
    CHECK((shading > 1 / 1.301 && shading < 1.301));
    CHECK((look_up > 0.499 && look_up < 2.001));
    least = std::min(least, look_up);
    most = std::max(most, look_up);
    CHECK(machine.digest() == drawn(hdr, draw).digest());
    CHECK(machine.digest() != hdr.machine.digest());
  }
  CHECK((least < 0.6 && most > 1.7));
}

TEST_CASE("a machine without sources is drawn by the widest doubt") {
  apps::MachineDescription unknown{.machine = apps::find_machine_preset("hdr")->machine, .sources = {}};
  double most = 1;
  for (std::uint32_t draw = 0; draw < 100; ++draw) {
    most = std::max(most, factor(drawn(unknown, draw), core::Charge::shading));
  }
  CHECK((most > 1.7 && most <= 2.001));
}

TEST_CASE("dmpc machine prints the machine of a draw, with the sources by which it was drawn") {
  std::ostringstream printed;
  CHECK(apps::machine_command({.machine = "hdr", .draw = 7}, printed) == 0);
  const apps::MachineDescription& hdr = *apps::find_machine_preset("hdr");
  const apps::MachineDescription seventh = apps::parse_machine(printed.str(), "printed");
  CHECK(seventh.machine.digest() == drawn(hdr, 7).digest());
  CHECK(seventh.sources == hdr.sources);
}

}  // namespace dmpc::tests::drawn_machine_test
