#include "apps/frontend/machine/machines.h"

#include <algorithm>

#include "apps/frontend/line/words.h"
#include "apps/frontend/machine/voxel_prices.h"
#include "core/base/ranges.h"
#include "core/trace/charge.h"
#include "core/trace/work.h"

namespace dmpc::apps {
namespace {

using core::Charge;
using nodes::MessageCost;
using nodes::Switching;
using nodes::TopologyKind;

/// A figure, and a sentence on it. Certainty: high, medium or low. "Quoted" figures are commonly given for the machine, but the
/// measurements behind them were not looked up; "assumed" ones have no source at all.
template <class T>
struct Figure {
  T value;
  const char* source;
};

struct Preset {
  const char* name;
  const char* title;
  Figure<TopologyKind> topology;
  Figure<std::uint32_t> uplinks = {1, "no tree of switches"};
  Figure<Switching> switching;
  Figure<std::uint64_t> short_bytes_max = {0, "one class of messages"};
  Figure<MessageCost> short_message = {{}, "as a long message"};
  Figure<MessageCost> long_message;
  Figure<std::uint64_t> hop_ns;
  Figure<std::uint64_t> service_ns;
  Figure<std::uint64_t> slowdown;  ///< an operation's, against the core on which the prices were measured
  /// Where the price of a cached look-up comes from, which all machines have times their slowdown.
  const char* cached_lookup_source =
      "the iPSC/2's, fitted there, carried over by the slowdown: not measured on this machine, low";
  Figure<bool> has_memory_port = {false, "assumed, low: nothing is known of such a bound"};
};

/// Calibrated: with it mount-6-t6 takes on one node the time that Table 3 of the 1994 paper prints for Mountain (`dmpc study
/// paper` shows both, and what to fit). The others of its day follow.
constexpr std::uint64_t ipsc2_slowdown = 37'100;
/// The 1994 paper: "about seven times faster".
constexpr std::uint64_t ipsc860_slowdown = ipsc2_slowdown / 7;

// "The 1994 paper": Badouel, Bouatouch, Priol, "Distributing Data and Control for Ray Tracing in Parallel". LogP: Culler and
// others, "LogP: Towards a Realistic Model of Parallel Computation", 1993, and later measurements in its terms.
constexpr Preset presets[] = {
    {.name = "ipsc2",
     .title = "Intel iPSC/2 of 1988: 80386 processors, hypercube; the machine of the 1994 article",
     .topology = {TopologyKind::hypercube,
                  "circuit-switched hypercube: S. Nugent, The iPSC/2 Direct-Connect Communications Technology, 1988, high; "
                  "e-cube routing: quoted, high"},
     .switching = {Switching::circuit, "Direct-Connect modules make a circuit and hold it: S. Nugent, 1988, high"},
     .short_bytes_max = {100, "quoted, high: a short message travels with its header, a longer one first asks for a buffer"},
     .short_message = {{.send_ns = 160'000, .latency_ns = 50'000, .receive_ns = 160'000, .byte_ps = 200'000},
                       "350 to 390 us in all and 0.2 us a byte: quoted, medium; the 160 us of each processor: assumed, low"},
     .long_message = {{.send_ns = 160'000, .latency_ns = 430'000, .receive_ns = 160'000, .byte_ps = 353'000},
                      "750 us in all and 353 ns a byte: computed from 0.9 MB/s at 1 KB and 2.75 MB/s at most in the 1994 paper, "
                      "good to 8 %, high; the 160 us of each processor: assumed, low"},
     .hop_ns = {10'300, "measured by Bokhari on the iPSC/860, which has the same routers; quoted as 10 to 15 us, medium"},
     .service_ns = {200'000, "assumed between 100 and 300 us, low"},
     .slowdown = {ipsc2_slowdown,
                  "80386 at 16 MHz with 80387; the factor to the measured core is fitted to Mountain on one node in Table 3 of "
                  "the 1994 paper, medium for Mountain, low for other scenes"},
     .cached_lookup_source = "fitted to Mountain on two nodes in Table 3 of the 1994 paper, not measured: with the search of the "
                             "cache it holds whatever else a second node costs there, low",
     .has_memory_port =
         {false,
          "one message in and one out at a time whatever the number of channels: quoted, low; off, since no figure "
          "of the 1994 paper can tell"}},
    {.name = "ipsc860",
     .title = "Intel iPSC/860 of 1990: i860 processors on the hypercube of the iPSC/2",
     .topology = {TopologyKind::hypercube, "hypercube and routers of the iPSC/2: quoted, high"},
     .switching = {Switching::circuit, "routers of the iPSC/2: quoted, high"},
     .short_bytes_max = {100, "as the iPSC/2: quoted, high"},
     .short_message = {{.send_ns = 29'000, .latency_ns = 1'000, .receive_ns = 29'000, .byte_ps = 380'000},
                       "65 to 75 us in all, a hop among them: quoted after Bokhari and Dunigan, medium; 0.36 to 0.40 us a byte: "
                       "quoted, high; the 29 us of each processor: assumed, low"},
     .long_message = {{.send_ns = 29'000, .latency_ns = 81'000, .receive_ns = 29'000, .byte_ps = 380'000},
                      "136 to 164 us in all, a hop among them: quoted after Bokhari and Dunigan, medium; 0.36 to 0.40 us a byte: "
                      "quoted, high; the 29 us of each processor: assumed, low"},
     .hop_ns = {10'300, "measured by Bokhari: quoted, high"},
     .service_ns = {30'000, "a seventh of the iPSC/2's: assumed, low"},
     .slowdown = {ipsc860_slowdown, "i860 at 40 MHz, 7 times the iPSC/2's node: the 1994 paper, medium"},
     .has_memory_port = {false, "as the iPSC/2: quoted, low; off"}},
    {.name = "paragon",
     .title = "Intel Paragon of 1993: i860XP processors, two-dimensional mesh",
     .topology = {TopologyKind::mesh, "two-dimensional mesh, wormhole routing along x, then y: quoted, high"},
     .switching = {Switching::circuit, "wormhole routing: what waits holds the links behind it, as a circuit does, medium"},
     .long_message =
         {{.send_ns = 20'000, .latency_ns = 30'000, .receive_ns = 20'000, .byte_ps = 5'882},
          "70 us in all and 170 MB/s with SUNMOS: NASA Ames, RNR-94-016, 1994, high; the 20 us of each processor: assumed, low"},
     .hop_ns = {40, "assumed, low"},
     .service_ns = {20'000, "assumed, low"},
     .slowdown = {ipsc860_slowdown * 40 / 50,
                  "i860XP at 50 MHz (TOP500 report of 1994) by its clock against the i860 at 40 MHz, medium"}},
    {.name = "cm5",
     .title = "Thinking Machines CM-5 of 1992: SPARC processors, fat tree",
     .topology = {TopologyKind::fat_tree, "fat tree with four children a switch: TOP500 report of 1994, high"},
     .uplinks = {2,
                 "two parents a switch in the lower levels, four above: quoted after C. Leiserson and others, The Network "
                 "Architecture of the Connection Machine CM-5, 1992, medium"},
     .switching = {Switching::packet, "messages travel as packets of 20 bytes: quoted after the same, high"},
     .long_message = {{.send_ns = 40'000, .latency_ns = 10'000, .receive_ns = 40'000, .byte_ps = 124'000},
                      "88 to 95 us in all with CMMD: quoted, medium; 8.06 MB/s: The Performance of PVM on MPP Systems, high; 10 "
                      "us of latency: assumed, near LogP's 6 us, low"},
     .hop_ns = {200, "assumed, low"},
     .service_ns = {40'000, "assumed, low"},
     .slowdown = {ipsc2_slowdown / 5, "SPARC at 32 MHz without its vector units, 5 times the iPSC/2's node: assumed, low"}},
    {.name = "cs2",
     .title = "Meiko CS-2 of 1993: SuperSPARC processors, fat tree",
     .topology = {TopologyKind::fat_tree, "multistage crossbar, a fat tree: Overview of Recent Supercomputers, medium"},
     .uplinks = {4, "the same bandwidth at every level: quoted, medium"},
     .switching = {Switching::packet, "packets through switches of eight links: quoted, medium"},
     .long_message = {{.send_ns = 30'000, .latency_ns = 25'000, .receive_ns = 30'000, .byte_ps = 24'100},
                      "83 to 87 us in all and 40 to 43 MB/s with MPI: quoted, medium; the 30 us of each processor: assumed, low"},
     .hop_ns = {200, "a layer of switches: Overview of Recent Supercomputers, medium"},
     .service_ns = {20'000, "assumed, low"},
     .slowdown = {ipsc2_slowdown / 15, "SuperSPARC of 40 MFLOPS, 15 times the iPSC/2's node: assumed, low"}},
    {.name = "myrinet",
     .title = "a cluster of 2005: Opteron processors on Myrinet-2000",
     .topology = {TopologyKind::fat_tree, "Clos network of switches: Myricom, high"},
     .uplinks = {4, "as many links up as down, as a Clos network has: quoted, medium"},
     .switching = {Switching::packet, "packets that switches cut through: Myricom, high"},
     .long_message =
         {{.send_ns = 800, .latency_ns = 1'400, .receive_ns = 800, .byte_ps = 4'049},
          "3.2 us in all through one switch and 247 MB/s with MPI over MX-2G, D cards with one port: Myricom, Performance "
          "Measurements of Myrinet-2000, high; the 0.8 us of each processor: assumed from LogP's 2 us of the Lanai cards "
          "before, low"},
     .hop_ns = {100, "half of what hardware and one switch take, 0.5 us with the fibres' ends: Myricom, the same page, medium"},
     .service_ns = {1'000, "assumed, low"},
     .slowdown = {8,
                  "an Opteron at 2.4 GHz: clock 1.4, instructions a clock 2, and half of the work by vectors a quarter as wide: "
                  "computed, not measured, low"}},
    {.name = "fdr",
     .title = "a cluster of 2015 on FDR InfiniBand, 56 Gbit/s",
     .topology = {TopologyKind::fat_tree, "FDR InfiniBand as a fat tree: quoted, medium"},
     .uplinks = {4, "as many links up as down, without oversubscription: quoted as usual, medium"},
     .switching = {Switching::packet, "packets of up to 4 KiB that switches cut through: InfiniBand, high"},
     .long_message =
         {{.send_ns = 300, .latency_ns = 400, .receive_ns = 300, .byte_ps = 158},
          "1.0 to 1.3 us in all with MPI through one switch, 0.2 to 0.4 us of them on each processor, and 6.3 GB/s of the "
          "link's 6.8: quoted, medium"},
     .hop_ns = {100, "a switch: quoted as 0.1 to 0.2 us, medium"},
     .service_ns = {400, "assumed, low"},
     .slowdown =
         {2, "a Xeon E5 of 2014 beside a core of a server of today, 1.4 to 2 times in SPEC CPU by one thread: quoted, medium"}},
    {.name = "gigabit",
     .title = "a cluster of today on gigabit Ethernet",
     .topology = {TopologyKind::fat_tree, "star or Clos network of switches, medium"},
     .uplinks = {4, "as many links up as down, as a star or a Clos network without oversubscription has: assumed, low"},
     .switching = {Switching::packet, "Ethernet frames: IEEE 802.3, high"},
     .long_message =
         {{.send_ns = 5'000, .latency_ns = 35'000, .receive_ns = 5'000, .byte_ps = 8'772},
          "30 to 60 us in all, 1 to 5 us of them on each processor, and 110 to 118 MB/s with the kernel's TCP: quoted, "
          "medium"},
     .hop_ns = {2'000, "a cable and half a switch: assumed, low"},
     .service_ns = {5'000, "assumed, low"},
     .slowdown = {1, "a node is one core as that on which the operations were measured, medium"}},
    {.name = "hdr",
     .title = "a cluster of today on HDR InfiniBand, 200 Gbit/s",
     .topology = {TopologyKind::fat_tree, "HDR InfiniBand as a fat tree: quoted, medium"},
     .uplinks = {4, "as many links up as down, without oversubscription: quoted as usual, medium"},
     .switching = {Switching::packet, "packets of up to 4 KiB that switches cut through: InfiniBand, high"},
     .long_message = {{.send_ns = 300, .latency_ns = 350, .receive_ns = 300, .byte_ps = 42},
                      "1.0 to 1.3 us in all with MPI through one switch, 0.2 to 0.4 us of them on each processor, and 24 GB/s: "
                      "quoted, medium"},
     .hop_ns = {100, "a switch: quoted, medium"},
     .service_ns = {300, "assumed, low"},
     .slowdown = {1, "a node is one core as that on which the operations were measured, medium"}},
    {.name = "ndr",
     .title = "a cluster of 2025 on NDR InfiniBand, 400 Gbit/s",
     .topology = {TopologyKind::fat_tree, "NDR InfiniBand as a fat tree: quoted, medium"},
     .uplinks = {4, "as many links up as down, without oversubscription: quoted as usual, medium"},
     .switching = {Switching::packet, "packets of up to 4 KiB that switches cut through: InfiniBand, high"},
     .long_message =
         {{.send_ns = 250, .latency_ns = 350, .receive_ns = 250, .byte_ps = 21},
          "0.24 us on the sender and 46.7 GB/s with UCX over 400 Gbit/s: openucx/ucx, issue 10649, 2025, medium; 0.9 to 1.2 "
          "us in all through one switch: quoted as HDR's, medium"},
     .hop_ns = {100, "a switch, as HDR's: quoted, medium"},
     .service_ns = {300, "as HDR's: assumed, low"},
     .slowdown = {1, "a node is one core as that on which the operations were measured, medium"}},
};

std::string operations_source(const Figure<std::uint64_t>& slowdown) {
  return std::to_string(slowdown.value) +
         " times the picoseconds of one core of a server: measured for rays, questions, steps, reads, tests and shading, with "
         "the look-ups "
         "of pages at home in them; assumed for page_install and ray_packing (low); for cached_lookup see there; " +
         slowdown.source;
}

MachineDescription description_of(const Preset& preset) {
  const bool is_one_class = preset.short_bytes_max.value == 0;
  const std::array<std::string, sourced_keys.size()> sources = {
      preset.topology.source,        preset.uplinks.source,        preset.switching.source,
      preset.short_bytes_max.source, preset.short_message.source,  preset.long_message.source,
      preset.hop_ns.source,          preset.service_ns.source,     operations_source(preset.slowdown),
      preset.cached_lookup_source,   preset.has_memory_port.source};
  MachineDescription description{
      .machine = {.name = preset.name,
                  .topology = preset.topology.value,
                  .uplinks = preset.uplinks.value,
                  .switching = preset.switching.value,
                  .short_bytes_max = preset.short_bytes_max.value,
                  .short_message = is_one_class ? preset.long_message.value : preset.short_message.value,
                  .long_message = preset.long_message.value,
                  .hop_ns = preset.hop_ns.value,
                  .service_ns = preset.service_ns.value,
                  .cost_ps = operation_costs_ps(preset.slowdown.value),
                  .has_memory_port = preset.has_memory_port.value,
                  .prices_for = price_bit(core::Structure::grid) | price_bit(core::Structure::extents)},
      .sources = {},
      .title = preset.title};
  for (std::size_t i = 0; i < sourced_keys.size(); ++i) {
    description.sources.emplace_back(sourced_keys[i], sources[i]);
  }
  return description;
}

/// The iPSC/2 with prices for the structure that the 1994 paper had.
MachineDescription with_voxel_prices(MachineDescription ipsc2) {
  ipsc2.machine.name = "ipsc2-1994";
  ipsc2.title = "the iPSC/2 with prices for --structure=voxels --voxels=article, the structure of the 1994 article";
  ipsc2.machine.prices_for = price_bit(core::Structure::voxels);
  set_prices(ipsc2.machine, fitted_voxel_prices);
  for (auto& [key, source] : ipsc2.sources) {
    if (key == "operation_ps") {
      source =
          "steps, reads and tests by one factor to the measured core, rays and hits by another: fitted to Mountain on 1 and 64 "
          "nodes and to Rings4 on 2 and 64 in Table 3 of the 1994 paper (dmpc study paper), medium; page_install, ray_packing, "
          "tile_read and question_setup are ipsc2's, low";
    } else if (key == "cached_lookup") {
      source = "fitted to the same four cells, not measured, low";
    }
  }
  return ipsc2;
}

}  // namespace

const std::vector<MachineDescription>& machine_presets() {
  static const std::vector<MachineDescription> all = [] {
    std::vector<MachineDescription> descriptions =
        core::mapped<MachineDescription>(presets, [&](const Preset& preset) { return description_of(preset); });
    descriptions.insert(descriptions.begin() + 1, with_voxel_prices(descriptions.front()));
    return descriptions;
  }();
  return all;
}

const MachineDescription* find_machine_preset(std::string_view name) {
  const auto& all = machine_presets();
  return core::find_in(all, name, [](const auto& preset) { return preset.machine.name; });
}

std::string machine_preset_names() {
  return joined(machine_presets(), ", ", [](const MachineDescription& preset) { return preset.machine.name; });
}

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
