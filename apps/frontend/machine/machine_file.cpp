#include "apps/frontend/machine/machine_file.h"

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "apps/frontend/line/json_format.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/system/text_input.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"
#include "core/database/structure.h"
#include "core/trace/charge.h"
#include "nodes/topology.h"

namespace dmpc::apps {
namespace {

using Json = nlohmann::ordered_json;
using Keys = std::vector<std::string_view>;

constexpr std::size_t file_bytes_max = std::size_t{1} << 20U;
constexpr int depth_max = 8;
constexpr std::size_t name_characters_max = 64;
/// A message of a gigabyte is short by any standard that has long ones.
constexpr std::uint64_t bytes_max = 1'000'000'000;
/// One second.
constexpr std::uint64_t time_ns_max = 1'000'000'000;
/// A tenth of a second: a quantum of a hundred million operations still has a price.
constexpr std::uint64_t operation_ps_max = 100'000'000'000;
/// One millisecond.
constexpr std::uint64_t byte_ps_max = 1'000'000'000;

Json message_json(const nodes::MessageCost& cost) {
  return {{"send_ns", cost.send_ns}, {"latency_ns", cost.latency_ns}, {"receive_ns", cost.receive_ns}, {"byte_ps", cost.byte_ps}};
}

Json operations_json(const nodes::Machine& machine) {
  Json costs;
  for (std::size_t i = 0; i < nodes::charge_count; ++i) {
    costs[std::string(core::charge_names[i])] = machine.cost_ps[i];
  }
  return costs;
}

/// A value as a message shows it.
std::string shown(const Json& value) {
  constexpr std::size_t shown_max = 40;
  const std::string text = value.dump(-1, ' ', true);  // cut anywhere it is still one byte a character
  return text.size() <= shown_max ? text : text.substr(0, shown_max) + "...";
}

/// One object of the file: its keys are checked when it is made, its values when they are asked for.
class Fields {
 public:
  /// `place` is what leads to the object, "file: " or "file: key."; all of `keys` are there, some of `optional_keys`, no others.
  Fields(const Json& json, std::string place, const Keys& keys, const Keys& optional_keys = {})
      : json_(json), place_(std::move(place)) {
    for (const auto& [key, value] : json_.items()) {
      const auto is_key = [&key = key](std::string_view known) { return known == key; };
      if (std::none_of(keys.begin(), keys.end(), is_key) && std::none_of(optional_keys.begin(), optional_keys.end(), is_key)) {
        refuse(shown(key),
               "unknown key, expected " + joined(keys, ", ") + (keys.empty() ? "" : ", ") + joined(optional_keys, ", "));
      }
    }
    for (const std::string_view key : keys) {
      if (!json_.contains(key)) {
        refuse(key, "this key is missing");
      }
    }
  }

  std::uint64_t number(std::string_view key, std::uint64_t most) const {
    const Json& value = json_.at(std::string(key));
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most) {
      refuse(key, "expected a whole number from 0 to " + std::to_string(most), value);
    }
    return value.get<std::uint64_t>();
  }
  bool flag(std::string_view key) const {
    const Json& value = json_.at(std::string(key));
    if (!value.is_boolean()) {
      refuse(key, "expected true or false", value);
    }
    return value.get<bool>();
  }
  std::string text(std::string_view key) const {
    const Json& value = json_.at(std::string(key));
    if (!value.is_string()) {
      refuse(key, "expected a text", value);
    }
    return value.get<std::string>();
  }
  Fields object(std::string_view key, const Keys& keys, const Keys& optional_keys = {}) const {
    const Json& value = json_.at(std::string(key));
    if (!value.is_object()) {
      refuse(key, "expected an object", value);
    }
    return Fields(value, place_ + std::string(key) + ".", keys, optional_keys);
  }

  const Json& json() const { return json_; }
  [[noreturn]] void refuse(std::string_view key, const std::string& reason) const {
    throw core::InputError(place_ + std::string(key) + ": " + reason);
  }
  [[noreturn]] void refuse(std::string_view key, const std::string& expected, const Json& value) const {
    refuse(key, expected + ", got " + shown(value));
  }

 private:
  const Json& json_;
  std::string place_;
};

std::string machine_name_in(const Fields& fields) {
  std::string name = fields.text("name");
  const bool is_printable = std::none_of(name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; });
  if (name.empty() || name.size() > name_characters_max || !is_printable) {
    fields.refuse("name", "expected 1 to " + std::to_string(name_characters_max) + " characters that can be printed",
                  fields.json().at("name"));
  }
  return name;
}

/// What `parse` makes of a name.
template <class Parse>
auto named(const Fields& fields, std::string_view key, const Parse& parse) {
  const std::string name = fields.text(key);
  try {
    return parse(name);
  } catch (const core::InputError& error) {
    fields.refuse(key, error.what());
  }
}

nodes::TopologyKind topology_of(const Fields& fields) { return named(fields, "topology", nodes::parse_topology); }

nodes::MessageCost message_of(const Fields& fields) {
  return {.send_ns = fields.number("send_ns", time_ns_max),
          .latency_ns = fields.number("latency_ns", time_ns_max),
          .receive_ns = fields.number("receive_ns", time_ns_max),
          .byte_ps = fields.number("byte_ps", byte_ps_max)};
}

/// Reads `operation_ps`. Old files have no price for questions; these then cost as much as a ray did: half of a ray's price at
/// either end.
std::array<std::uint64_t, nodes::charge_count> operations_of(const Fields& fields) {
  constexpr auto newest = static_cast<std::size_t>(core::Charge::question_setup);
  const Keys all(core::charge_names.begin(), core::charge_names.end());
  const Fields given =
      fields.object("operation_ps", Keys(all.begin(), all.begin() + newest), Keys(all.begin() + newest, all.end()));
  std::array<std::uint64_t, nodes::charge_count> costs_ps{};
  for (std::size_t i = 0; i < nodes::charge_count; ++i) {
    const bool is_as_ray = i == newest && !given.json().contains(std::string(all[newest]));
    costs_ps[i] =
        is_as_ray ? costs_ps[static_cast<std::size_t>(core::Charge::ray_setup)] / 2 : given.number(all[i], operation_ps_max);
  }
  return costs_ps;
}

std::vector<std::pair<std::string, std::string>> sources_of(const Fields& fields) {
  std::vector<std::pair<std::string, std::string>> sources;
  if (fields.json().contains("sources")) {
    const Fields given = fields.object("sources", {}, Keys(sourced_keys.begin(), sourced_keys.end()));
    for (const auto& [key, unused] : given.json().items()) {
      sources.emplace_back(key, given.text(key));
    }
  }
  return sources;
}

std::uint32_t uplinks_of(const Fields& fields) {
  const std::uint64_t uplinks = fields.number("uplinks", nodes::Topology::uplinks_max);
  if (uplinks == 0) {
    fields.refuse("uplinks", "expected a whole number from 1 to " + std::to_string(nodes::Topology::uplinks_max) + ", got 0");
  }
  if (uplinks > 1 && topology_of(fields) != nodes::TopologyKind::fat_tree) {
    fields.refuse("uplinks", "expected 1, for only the switches of a fat-tree have more, got " + std::to_string(uplinks));
  }
  return static_cast<std::uint32_t>(uplinks);
}

/// A file need not say which structures its prices are for.
std::uint32_t prices_for(const Fields& fields) {
  const auto& names = core::structure_names;
  const Json given = fields.json().value("prices_for", Json::array());
  std::uint32_t bits = 0;
  for (const Json& one : given.is_array() ? given : Json::array({nullptr})) {
    const auto found = std::find(names.begin(), names.end(), one.is_string() ? one.get<std::string>() : "");
    if (found == names.end()) {
      fields.refuse("prices_for", "expected a list of " + joined(names, ", "), given);
    }
    bits |= price_bit(static_cast<core::Structure>(found - names.begin()));
  }
  return bits;
}

/// A port is something to contend for.
bool has_memory_port(const Fields& fields) {
  const bool has_port = fields.flag("has_memory_port");
  if (has_port && !fields.flag("has_contention")) {
    fields.refuse("has_memory_port",
                  "true does not go with has_contention false: without contention no message waits for a port");
  }
  return has_port;
}

/// A file need not say it.
void check_format(const Fields& fields) {
  if (fields.json().contains("format") && fields.json().at("format") != json_format) {
    fields.refuse("format", "expected " + std::to_string(json_format) + ", for files of this dmpc", fields.json().at("format"));
  }
}

MachineDescription description_of(const Fields& fields) {
  check_format(fields);
  const Keys message_keys = {"send_ns", "latency_ns", "receive_ns", "byte_ps"};
  return {.machine = {.name = machine_name_in(fields),
                      .topology = topology_of(fields),
                      .uplinks = uplinks_of(fields),
                      .switching = named(fields, "switching", nodes::parse_switching),
                      .short_bytes_max = fields.number("short_bytes_max", bytes_max),
                      .short_message = message_of(fields.object("short_message", message_keys)),
                      .long_message = message_of(fields.object("long_message", message_keys)),
                      .hop_ns = fields.number("hop_ns", time_ns_max),
                      .service_ns = fields.number("service_ns", time_ns_max),
                      .cost_ps = operations_of(fields),
                      .has_contention = fields.flag("has_contention"),
                      .has_memory_port = has_memory_port(fields),
                      .prices_for = prices_for(fields)},
          .sources = sources_of(fields)};
}

MachineDescription machine_in(const Json& json, const std::string& file) {
  if (!json.is_object()) {
    throw core::InputError(file + ": expected an object of a machine's figures, see dmpc machine ipsc2 for an example");
  }
  return description_of(Fields(json, file + ": ",
                               {"name", "topology", "uplinks", "switching", "short_bytes_max", "short_message", "long_message",
                                "hop_ns", "service_ns", "operation_ps", "has_contention", "has_memory_port"},
                               {"format", "prices_for", "sources"}));
}

/// "line:column" of the last of the first `byte_count` bytes.
std::string position(std::string_view text, std::size_t byte_count) {
  const std::string_view before = text.substr(0, std::min(text.size(), byte_count == 0 ? 0 : byte_count - 1));
  const std::size_t line_begin = before.rfind('\n') + 1;  // 0 without one
  return std::to_string(1 + std::count(before.begin(), before.end(), '\n')) + ":" +
         std::to_string(before.size() - line_begin + 1);
}

/// Finds what the parser would take: keys that an object has twice, and values too deep for any function that calls itself.
class Watch {
 public:
  explicit Watch(const std::string& file) : file_(file) {}

  void note(int depth, Json::parse_event_t event, const Json& parsed) {
    if (depth > depth_max) {
      throw core::InputError(file_ + ": expected at most " + std::to_string(depth_max) + " objects in each other");
    }
    if (event == Json::parse_event_t::object_start) {
      open_.emplace_back();
    } else if (event == Json::parse_event_t::object_end) {
      open_.pop_back();
    } else if (event == Json::parse_event_t::key && !open_.back().insert(parsed.get<std::string>()).second) {
      throw core::InputError(file_ + ": " + shown(parsed) + ": this key is given twice");
    }
  }

 private:
  const std::string& file_;
  std::vector<std::set<std::string>> open_;
};

Json parse_json(std::string_view text, const std::string& file) {
  Watch watch(file);
  try {
    return Json::parse(text, [&watch](int depth, Json::parse_event_t event, const Json& parsed) {
      watch.note(depth, event, parsed);
      return true;
    });
  } catch (const Json::parse_error& error) {
    throw core::InputError(file + ":" + position(text, error.byte) + ": this is no JSON, see dmpc machine ipsc2 for an example");
  } catch (const Json::exception&) {
    throw core::InputError(file + ": a number is out of all range");
  }
}

/// " Did you mean ipsc2?"; empty if no machine's name is near.
std::string name_meant(const std::string& typed) {
  const std::vector<std::string> names(machine_names.begin(), machine_names.end());
  return core::did_you_mean(typed, names);
}

std::string read_text(const std::string& path) {
  std::string text(file_bytes_max + 1, '\0');
  try {
    TextInput stream(path);
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
  } catch (const core::InputError& error) {
    const std::string meant = name_meant(path), what = error.what(), named = path + ": ";
    throw core::InputError(named + "this is neither a machine (" + machine_preset_names() + ") nor a file that can be read: it " +
                           what.substr(what.starts_with(named) ? named.size() : 0) + (meant.empty() ? "" : ".") + meant);
  }
  if (text.size() > file_bytes_max) {
    throw core::InputError(path + ": a machine file has 1 MiB at most");
  }
  return text;
}

}  // namespace

Json machine_json(const nodes::Machine& machine) {
  return {{"name", machine.name},
          {"topology", nodes::name_of(machine.topology)},
          {"uplinks", machine.uplinks},
          {"switching", nodes::name_of(machine.switching)},
          {"short_bytes_max", machine.short_bytes_max},
          {"short_message", message_json(machine.short_message)},
          {"long_message", message_json(machine.long_message)},
          {"hop_ns", machine.hop_ns},
          {"service_ns", machine.service_ns},
          {"operation_ps", operations_json(machine)},
          {"has_contention", machine.has_contention},
          {"has_memory_port", machine.has_memory_port},
          {"prices_for", priced_structures(machine)}};
}

std::string machine_text(const MachineDescription& description) {
  Json json = {{"format", json_format}};
  json.update(machine_json(description.machine));
  json["sources"] = Json::object();
  for (const auto& [key, source] : description.sources) {
    json["sources"][key] = source;
  }
  return json.dump(2) + "\n";
}

MachineDescription parse_machine(std::string_view text, const std::string& file) {
  return machine_in(parse_json(text, file), file);
}

MachineDescription parse_preset(std::string_view text) {
  const std::string place = "machine preset";
  try {
    Json json = parse_json(text, place);
    const std::string title = json.at("title");
    json.erase("title");
    MachineDescription preset = machine_in(json, place);
    preset.title = title;
    return preset;
  } catch (const core::InputError& error) {
    throw core::InternalError(error.what());
  } catch (const Json::exception& error) {
    throw core::InternalError(place + ": " + error.what());
  }
}

MachineDescription load_machine(const std::string& name_or_file) {
  if (const MachineDescription* const preset = find_machine_preset(name_or_file)) {
    return *preset;
  }
  return parse_machine(read_text(name_or_file), name_or_file);
}

}  // namespace dmpc::apps
