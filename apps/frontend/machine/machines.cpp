#include "apps/frontend/machine/machines.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "apps/frontend/line/words.h"
#include "apps/frontend/machine/machine_file.h"
#include "core/base/ranges.h"
#include "core/trace/charge.h"
#include "core/trace/work.h"

namespace dmpc::apps {

extern const char* const machine_preset_files[];  // defined in a source that CMake generates from presets/, in their order

namespace {

/// Who renders on one machine does not wait until all are read.
template <std::size_t index>
const MachineDescription& preset_at() {
  static const MachineDescription preset = parse_preset(machine_preset_files[index]);
  return preset;
}

template <std::size_t... indices>
constexpr auto all_presets(std::index_sequence<indices...>) {
  return std::array{&preset_at<indices>...};
}

constexpr auto preset_reads = all_presets(std::make_index_sequence<machine_names.size()>());

}  // namespace

const std::vector<MachineDescription>& machine_presets() {
  static const auto all = core::mapped<MachineDescription>(preset_reads, [](const auto& read) { return read(); });
  return all;
}

const MachineDescription* find_machine_preset(std::string_view name) {
  const auto found = std::find(machine_names.begin(), machine_names.end(), name);
  return found == machine_names.end() ? nullptr : &preset_reads[static_cast<std::size_t>(found - machine_names.begin())]();
}

std::string machine_preset_names() { return joined(machine_names, ", "); }

std::string name_with_links(const nodes::Machine& machine) {
  const char* const links = !machine.has_contention ? " without contention" : machine.has_memory_port ? " with memory ports" : "";
  return machine.name + links;
}

std::vector<std::string_view> priced_structures(const nodes::Machine& machine) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < core::structure_names.size(); ++i) {
    if (is_priced_for(machine, static_cast<core::Structure>(i))) {
      names.push_back(core::structure_names[i]);
    }
  }
  return names;
}

std::string price_note(const nodes::Machine& machine, core::Structure structure) {
  if (machine.prices_for == 0 || is_priced_for(machine, structure)) {
    return "";
  }
  const auto& all = machine_presets();
  const auto other =
      std::find_if(all.begin(), all.end(), [&](const auto& preset) { return is_priced_for(preset.machine, structure); });
  const std::string name(core::structure_names[static_cast<std::size_t>(structure)]);
  return machine.name + " has prices for other structures (" + joined(priced_structures(machine), ", ") + ") than " + name +
         ", so virtual times may be far off; " + other->machine.name + " has prices for " + name;
}

std::array<std::uint64_t, nodes::charge_count> operation_costs_ps(std::uint64_t slowdown) {
  using core::Charge;
  const core::WorkPrices& measured = core::measured_prices;
  std::array<std::uint64_t, nodes::charge_count> costs_ps{};
  const auto set = [&](Charge charge, std::uint64_t ps) { costs_ps[static_cast<std::size_t>(charge)] = ps * slowdown; };
  set(Charge::ray_setup, measured.ray_ps);
  set(Charge::cell_step, measured.cell_step_ps);
  set(Charge::bvh_node_read, measured.bvh_node_read_ps);
  set(Charge::triangle_test, measured.primitive_test_ps[0]);
  set(Charge::sphere_test, measured.primitive_test_ps[1]);
  set(Charge::cone_test, measured.primitive_test_ps[2]);
  set(Charge::shading, measured.shading_ps);
  set(Charge::tile_read, measured.tile_read_ps);
  // 61 to 69 ns a question for its two ends: walks with their questions against the same walks alone (rings-4-t1, mount-6-t6,
  // balls-4 and tetra-9 as extents, primary rays of 512x512, batches of 1,024, least of 40 runs on one thread's clock).
  set(Charge::question_setup, 32'000);
  set(Charge::home_lookup, 0);  // the measured prices hold it
  // The search of the cache: fitted to Mountain on two nodes in Table 3 of the 1994 paper.
  set(Charge::cached_lookup, 3'160);
  set(Charge::page_install, 10'000);  // an entry of a table: the page itself comes by direct memory access
  set(Charge::ray_packing, 2'000);    // 96 bytes copied
  return costs_ps;
}

}  // namespace dmpc::apps
