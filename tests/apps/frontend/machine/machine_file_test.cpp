#include "apps/frontend/machine/machine_file.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "core/trace/charge.h"
#include "tests/support/complaint.h"
#include "tests/support/tables.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::machine_file_test {

using tests::contains;

namespace {

using tests::TemporaryFolder;
using tests::write_text;

/// A machine without sources, to be spoilt.
std::string plain_text() {
  MachineDescription description = *find_machine_preset("ipsc2");
  description.sources.clear();
  return machine_text(description);
}

/// `text` with the first `from` replaced.
std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string machine_complaint(const std::string& text) {
  return tests::complaint_of([&] { parse_machine(text, "m.json"); });
}

/// The complaint about the iPSC/2 with one change.
std::string machine_complaint_with(const std::string& from, const std::string& to) {
  return machine_complaint(with(plain_text(), from, to));
}

}  // namespace

TEST_CASE("a machine file may begin with a byte order mark") {
  const MachineDescription plain = load_machine("paragon");
  CHECK(parse_machine("\xef\xbb\xbf" + machine_text(plain), "m.json").machine.digest() == plain.machine.digest());
}

TEST_CASE("a machine's name that is nearly right is suggested") {
  CHECK_THROWS_WITH_AS(load_machine("ipsc3"), doctest::Contains("Did you mean ipsc2?"), core::InputError);
}

TEST_CASE("what is printed of a machine reads back as the same") {
  for (const MachineDescription& preset : machine_presets()) {
    CAPTURE(preset.machine.name);
    const std::string text = machine_text(preset);
    const MachineDescription again = parse_machine(text, "m.json");
    CHECK(machine_text(again) == text);
    CHECK(again.sources == preset.sources);
    CHECK(again.machine.name == preset.machine.name);
    CHECK(again.machine.topology == preset.machine.topology);
    CHECK(again.machine.short_bytes_max == preset.machine.short_bytes_max);
    CHECK(again.machine.long_message.receive_ns == preset.machine.long_message.receive_ns);
    CHECK(again.machine.cost_ps == preset.machine.cost_ps);
    CHECK(again.machine.digest() == preset.machine.digest());
    CHECK(again.machine.prices_for == preset.machine.prices_for);
  }
}

TEST_CASE("a preset is read as a machine file with a title, and what is wrong with it is no mistake of who runs dmpc") {
  const std::string preset = with(plain_text(), "{", R"({"title": "mine",)");
  CHECK(parse_preset(preset).title == "mine");
  CHECK(parse_preset(preset).machine.digest() == find_machine_preset("ipsc2")->machine.digest());
  for (const std::string& wrong : {plain_text(), with(preset, "hop_ns", "hop"), std::string("[")}) {
    CHECK_THROWS_AS(parse_preset(wrong), core::InternalError);
  }
}

TEST_CASE("a machine file is of a format that it may leave out, and of no other") {
  CHECK(contains(plain_text(), "\"format\": 2,"));
  CHECK(machine_complaint_with("\"format\": 2,", "").empty());
  CHECK(machine_complaint_with("\"format\": 2,", "\"format\": 3,") ==
        "m.json: format: expected 2, for files of this dmpc, got 3");
}

TEST_CASE("a machine file says for which structures its prices are, or does not") {
  const std::string key = "\"prices_for\": [\n    \"grid\",\n    \"extents\"\n  ]";
  const auto prices_for = [&](const std::string& given) {
    return parse_machine(with(plain_text(), key, given), "m.json").machine.prices_for;
  };
  CHECK(prices_for("\"prices_for\": [\"voxels\"]") == price_bit(core::Structure::voxels));
  CHECK(prices_for("\"prices_for\": [\"voxels\", \"grid\"]") ==
        (price_bit(core::Structure::voxels) | price_bit(core::Structure::grid)));
  CHECK(prices_for("\"prices_for\": []") == 0);
  CHECK(parse_machine(with(plain_text(), key + ",", ""), "m.json").machine.prices_for == 0);
  for (const std::string given : {"[\"octree\"]", "[1]", "\"voxels\"", "null", "{}"}) {
    CHECK(contains(machine_complaint_with(key, "\"prices_for\": " + given),
                   "m.json: prices_for: expected a list of grid, extents, voxels, got "));
  }
}

TEST_CASE("a machine file from before questions had a price has them charged as a ray, half at either end") {
  const std::string key = ",\n    \"question_setup\": ", text = plain_text();
  const std::size_t begin = text.find(key);
  REQUIRE(begin != std::string::npos);
  std::string older = text;
  older.erase(begin, text.find_first_of(",\n}", begin + key.size()) - begin);
  const auto price = [](const nodes::Machine& machine, core::Charge charge) {
    return machine.cost_ps[static_cast<std::size_t>(charge)];
  };
  const nodes::Machine was = parse_machine(older, "m.json").machine, is = parse_machine(text, "m.json").machine;
  CHECK(price(was, core::Charge::question_setup) == price(is, core::Charge::ray_setup) / 2);
  CHECK(price(is, core::Charge::question_setup) < price(is, core::Charge::ray_setup));
  CHECK(machine_complaint_with("\"ray_setup\"", "\"ray_set_up\"").find("unknown key") != std::string::npos);
}

TEST_CASE("every figure reaches its own field") {
  const std::string text = R"({"name": "mine", "topology": "torus", "uplinks": 1, "switching": "packet", "short_bytes_max": 1,
    "short_message": {"send_ns": 2, "latency_ns": 3, "receive_ns": 4, "byte_ps": 5},
    "long_message": {"byte_ps": 9, "send_ns": 6, "latency_ns": 7, "receive_ns": 8}, "hop_ns": 10, "service_ns": 11,
    "operation_ps": {"ray_setup": 12, "cell_step": 13, "bvh_node_read": 14, "triangle_test": 15, "sphere_test": 16, "cone_test": 17,
      "shading": 18, "home_lookup": 19, "cached_lookup": 20, "page_install": 21, "ray_packing": 22, "tile_read": 23,
      "question_setup": 24}, "has_contention": false,
    "has_memory_port": false})";
  const MachineDescription description = parse_machine(text, "m.json");
  const nodes::Machine& machine = description.machine;
  CHECK(machine.name == "mine");
  CHECK(machine.topology == nodes::TopologyKind::torus);
  CHECK(machine.uplinks == 1);
  CHECK(machine.switching == nodes::Switching::packet);
  CHECK(machine.short_bytes_max == 1);
  const nodes::MessageCost &small = machine.short_message, &large = machine.long_message;
  CHECK(std::vector{small.send_ns, small.latency_ns, small.receive_ns, small.byte_ps} == std::vector<std::uint64_t>{2, 3, 4, 5});
  CHECK(std::vector{large.send_ns, large.latency_ns, large.receive_ns, large.byte_ps} == std::vector<std::uint64_t>{6, 7, 8, 9});
  CHECK(machine.hop_ns == 10);
  CHECK(machine.service_ns == 11);
  CHECK(machine.cost_ps == std::array<std::uint64_t, nodes::charge_count>{12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24});
  CHECK_FALSE(machine.has_contention);
  CHECK_FALSE(machine.has_memory_port);
  CHECK(parse_machine(with(plain_text(), "\"has_memory_port\": false", "\"has_memory_port\": true"), "m.json")
            .machine.has_memory_port);
  CHECK(description.sources.empty());
}

TEST_CASE("a machine on which all is free and one on which all takes as long as it may are taken") {
  CHECK_NOTHROW(parse_machine(machine_text({nodes::Machine(), {}}), "m.json"));
  CHECK(machine_complaint_with("\"hop_ns\": 10300", "\"hop_ns\": 1000000000") == "");
  CHECK(machine_complaint_with("\"name\": \"ipsc2\"", "\"name\": \"" + std::string(64, 'x') + "\"") == "");
}

TEST_CASE("what is wrong in a machine file is named with its key and what was expected") {
  for (const auto& row : tests::rows_in("apps/frontend/machine/slips.txt", 3)) {
    CHECK_MESSAGE(contains(machine_complaint_with(row[0], row[1]), row[2]), row[1]);
  }
  for (const std::string wrong :
       {"-1", "1.5", "1e3", "\"1\"", "true", "null", "[1]", "{}", "1000000001", "18446744073709551616"}) {
    CAPTURE(wrong);
    CHECK(contains(machine_complaint_with("10300", wrong), "m.json: hop_ns: expected a whole number from 0 to 1000000000, got "));
  }
  for (const std::string& wrong : {std::string(), std::string(65, 'x'), std::string("a\\nb")}) {
    CHECK(contains(machine_complaint_with("\"ipsc2\"", "\"" + wrong + "\""),
                   "m.json: name: expected 1 to 64 characters that can be printed, got "));
  }
}

TEST_CASE("uplinks are a fat tree's, from 1 to 4") {
  const std::string tree = with(plain_text(), "\"hypercube\"", "\"fat-tree\"");
  for (const std::string uplinks : {"1", "2", "4"}) {
    const std::string text = with(tree, "\"uplinks\": 1", "\"uplinks\": " + uplinks);
    CHECK(std::to_string(parse_machine(text, "m.json").machine.uplinks) == uplinks);
  }
  CHECK(contains(machine_complaint(with(tree, "\"uplinks\": 1", "\"uplinks\": 0")),
                 "m.json: uplinks: expected a whole number from 1 to 4, got 0"));
  CHECK(contains(machine_complaint(with(tree, "\"uplinks\": 1", "\"uplinks\": 5")), "m.json: uplinks: expected a whole number"));
  CHECK(contains(machine_complaint_with("\"uplinks\": 1", "\"uplinks\": 2"),
                 "m.json: uplinks: expected 1, for only the switches of a fat-tree have more, got 2"));
}

TEST_CASE("memory ports without contention are refused, both named") {
  const std::string ported = with(plain_text(), "\"has_memory_port\": false", "\"has_memory_port\": true");
  CHECK(machine_complaint(ported) == "");
  CHECK(machine_complaint_with("true", "false") == "");
  CHECK(contains(machine_complaint(with(ported, "\"has_contention\": true", "\"has_contention\": false")),
                 "m.json: has_memory_port: true does not go with has_contention false: "));
}

TEST_CASE("what is no JSON is named with its place") {
  CHECK(contains(machine_complaint(""), "m.json:1:1: this is no JSON"));
  CHECK(contains(machine_complaint("{\n  \"name\": \"a\",,"), "m.json:2:15: this is no JSON"));
  CHECK(contains(machine_complaint("{\"name\": \"\xff\"}"), "m.json:1:11: this is no JSON"));
  CHECK(contains(machine_complaint(plain_text() + "x"), "this is no JSON"));
  CHECK(contains(machine_complaint_with("10300", "1e999"), "m.json: a number is out of all range"));
  for (const std::string other : {"3", "[]", "null", "\"ipsc2\""}) {
    CHECK(contains(machine_complaint(other), "m.json: expected an object of a machine's figures"));
  }
}

TEST_CASE("every key but the format, the sources and the newest price must be there") {
  const auto whole = nlohmann::ordered_json::parse(plain_text());
  for (const auto& [key, value] : whole.items()) {
    auto rest = whole;
    rest.erase(key);
    CHECK(machine_complaint(rest.dump()) ==
          (key == "sources" || key == "format" || key == "prices_for" ? "" : "m.json: " + key + ": this key is missing"));
    for (const auto& [inner, unused] : value.items()) {
      if (value.is_object()) {
        rest = whole;
        rest[key].erase(inner);
        CHECK(machine_complaint(rest.dump()) ==
              (inner == "question_setup" ? "" : "m.json: " + key + "." + inner + ": this key is missing"));
      }
    }
  }
}

TEST_CASE("values in values without end are refused") {
  const std::string deep(200'000, '[');
  CHECK(contains(machine_complaint(deep), "m.json: expected at most 8 "));
  CHECK(contains(machine_complaint_with("10300", deep), "m.json: expected at most 8 "));
}

TEST_CASE("a name is a machine's, and anything else a file's") {
  const TemporaryFolder folder;
  const std::string mine = folder / "mine.json";
  write_text(mine, with(plain_text(), "\"ipsc2\"", "\"mine\""));
  CHECK(load_machine("cm5").machine.name == "cm5");
  CHECK(load_machine(mine).machine.name == "mine");
  write_text(mine, "{}");
  CHECK_THROWS_WITH_AS(load_machine(mine), (mine + ": name: this key is missing").c_str(), core::InputError);
}

TEST_CASE("what is neither a machine nor a file that can be read is named with the machines that there are") {
  const TemporaryFolder folder;
  for (const std::string& name :
       {std::string(), std::string("ipsc3"), (folder / "missing.json").string(), folder.path().string()}) {
    CAPTURE(name);
    const std::string message = name +
                                ": this is neither a machine (ipsc2, ipsc2-1994, ipsc860, paragon, cm5, cs2, myrinet, fdr, "
                                "gigabit, hdr, ndr) nor a file ";
    CHECK_THROWS_WITH_AS(load_machine(name), doctest::Contains(message.c_str()), core::InputError);
  }
  write_text(folder / "large", std::string((1U << 20U) + 1, ' '));
  CHECK_THROWS_WITH_AS(load_machine(folder / "large"), doctest::Contains("1 MiB at most"), core::InputError);
  CHECK_THROWS_WITH_AS(load_machine("/dev/zero"), doctest::Contains("it is a device or the like"), core::InputError);
}

}  // namespace dmpc::apps::machine_file_test
