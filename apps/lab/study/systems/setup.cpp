#include "apps/lab/study/systems/setup.h"

#include <algorithm>
#include <array>

#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/words.h"
#include "apps/run/strategy_options.h"
#include "core/base/expect.h"
#include "nodes/size_text.h"

namespace dmpc::apps {
namespace {

bool has_pages(const StrategyOptions& options) {
  return options.strategy == Strategy::svm || options.strategy == Strategy::forest;
}
bool has_rays(const StrategyOptions& options) { return options.strategy == Strategy::dataflow; }
/// Not if the donor defines the system, or if no work moves.
bool may_choose_donor(const StrategyOptions& options) {
  return !has_rays(options) && options.pages.work_donor == svm::WorkDonor::ring && options.pages.work_item_side != 0U;
}
bool may_choose_residents(const StrategyOptions& options) {
  return options.strategy == Strategy::svm && options.pages.resident_percent == 0;
}

std::uint32_t number_from(const std::string& text) { return static_cast<std::uint32_t>(std::stoul(text)); }

/// An option of the search. set() is not called for the system's default.
struct Searchable {
  const char* name;
  std::vector<std::string> values;
  bool (*is_free)(const StrategyOptions& options);
  void (*set)(const std::string& value, SystemSetup& setup);
};

const std::vector<Searchable>& searchable_options() {
  static const std::vector<Searchable> all = {
      {"page-size",
       {"1KiB", "4KiB"},
       has_pages,
       [](const std::string& value, SystemSetup& setup) { setup.asked.page_size_bytes = parse_page_size(value); }},
      {"in-flight",
       {"1", "16", "64"},
       has_pages,
       [](const std::string& value, SystemSetup& setup) { setup.options.pages.in_flight = number_from(value); }},
      {"work-donor",
       {"ring", "host"},
       may_choose_donor,
       [](const std::string&, SystemSetup& setup) { setup.options.pages.work_donor = svm::WorkDonor::host; }},
      {"resident",
       {"0", "50"},
       may_choose_residents,
       [](const std::string& value, SystemSetup& setup) { setup.options.pages.resident_percent = number_from(value); }},
      {"backpressure",
       {"on", "off"},
       has_rays,
       [](const std::string&, SystemSetup& setup) { setup.options.rays.without_backpressure = true; }},
      {"ray-batch", {"default", "64"}, has_rays, [](const std::string& value, SystemSetup& setup) {
         setup.options.rays.ray_batch = number_from(value);
       }}};
  return all;
}

const Searchable& searchable(const std::string& name) {
  const auto& all = searchable_options();
  return *std::find_if(all.begin(), all.end(), [&](const Searchable& one) { return one.name == name; });
}

System without_structure(System system) {
  return system == System::replicated_extents ? System::replicated : system == System::svm_extents ? System::svm : system;
}

}  // namespace

std::string SystemSetup::name() const { return std::string(name_of(system)) + " on " + name_of(asked.structure); }

SystemSetup described_setup(System system) {
  const core::BuildOptions build = original_database_of(system).build;
  const bool is_original = build.structure == core::Structure::voxels;  // else the table "equal" shares the database
  SystemSetup setup{system, {build.structure, is_original, build.page_size_bytes}, strategy_of(system)};
  setup.options.pages.in_flight = 1;
  setup.options.rays.without_backpressure = true;
  setup.options.rays.balance.bsp.order = dataflow::CutOrder::alternating;
  return setup;
}

void give_whole_cache(SystemSetup& setup, std::size_t page_count) {
  if (setup.options.strategy == Strategy::svm) {
    const auto pages = static_cast<std::uint32_t>(page_count);
    const bool has_part = setup.options.pages.homes == svm::PageHomes::spread;
    setup.options.pages.cache_pages = std::max(1U, has_part ? pages - pages / setup.options.computer.node_count : pages);
  }
}

std::vector<SystemSetup> setups_on_all_structures(const std::vector<System>& systems) {
  std::vector<SystemSetup> setups;
  std::vector<System> known;
  for (const System any : systems) {
    const System system = without_structure(any);
    if (std::find(known.begin(), known.end(), system) != known.end()) {
      continue;
    }
    known.push_back(system);
    const StrategyOptions options = strategy_of(system);
    const std::size_t page = database_of(system).build.page_size_bytes;
    for (const core::Structure structure : {core::Structure::extents, core::Structure::grid, core::Structure::voxels}) {
      if (options.strategy != Strategy::forest || structure == core::Structure::extents) {
        setups.push_back({system, {structure, false, page}, options});
      }
    }
  }
  return setups;
}

std::vector<SearchedOption> searched_options(const SystemSetup& setup) {
  std::vector<SearchedOption> options;
  for (const Searchable& one : searchable_options()) {
    if (one.is_free(setup.options)) {
      SearchedOption option{one.name, one.values};
      const auto its_default = std::find(option.values.begin(), option.values.end(), option_texts(setup)[one.name]);
      core::expect(its_default != option.values.end(), "the default of an option is a value that the search tries");
      std::rotate(option.values.begin(), its_default, its_default + 1);
      options.push_back(std::move(option));
    }
  }
  return options;
}

SystemSetup with_setting(SystemSetup setup, const std::vector<SearchedOption>& options, const Search::Setting& setting) {
  for (std::size_t i = 0; i < options.size(); ++i) {
    if (setting[i] > 0) {
      searchable(options[i].name).set(options[i].values[setting[i]], setup);
    }
  }
  return setup;
}

std::string search_text() {
  return joined(searchable_options(), ", ",
                [](const Searchable& one) { return one.name + std::string(" {") + joined(one.values, ", ") + "}"; });
}

std::map<std::string, std::string> option_texts(const SystemSetup& setup) {
  const StrategyOptions& options = setup.options;
  std::map<std::string, std::string> texts;
  for (const std::string& word : words_between(options_of(setup.system), ' ')) {
    const std::size_t mark = word.find('=');
    texts[word.substr(2, mark - 2)] = word.substr(mark + 1);
  }
  texts["structure"] = name_of(setup.asked.structure);
  if (has_rays(options)) {
    texts["backpressure"] = options.rays.without_backpressure ? "off" : "on";
    texts["ray-batch"] = options.rays.ray_batch ? std::to_string(*options.rays.ray_batch) : "default";
    if (options.rays.balance.balance != dataflow::Balance::scattered) {
      texts["cuts"] = name_of(options.rays.balance.bsp.order);
    }
  } else {
    texts["work-donor"] = options.pages.work_item_side == 0U ? "none" : svm::name_of(options.pages.work_donor);
  }
  if (has_pages(options)) {
    texts["page-size"] = nodes::size_text(setup.asked.page_size_bytes);
    texts["in-flight"] = std::to_string(options.pages.in_flight.value_or(svm::modelled_in_flight));
  }
  if (options.strategy == Strategy::svm) {
    texts["resident"] = std::to_string(options.pages.resident_percent);
  }
  return texts;
}

std::string free_beforehand(const StrategyOptions& options) {
  if (has_rays(options)) {
    return options.rays.balance.is_by_load() ? "small picture for regions" : "";
  }
  return options.pages.resident_percent > 0 ? "small picture for residents" : "";
}

const MachineDescription& priced_for(core::Structure structure, const MachineDescription& machine) {
  static constexpr std::array<const char*, 2> one_computer = {"ipsc2", "ipsc2-1994"};
  const MachineDescription* const preset = find_machine_preset(machine.machine.name);
  const bool is_of_them = std::find(one_computer.begin(), one_computer.end(), machine.machine.name) != one_computer.end();
  if (!is_of_them || preset == nullptr || preset->machine.digest() != machine.machine.digest()) {
    return machine;
  }
  const char* const* const priced = std::find_if(one_computer.begin(), one_computer.end(), [&](const char* name) {
    return is_priced_for(find_machine_preset(name)->machine, structure);
  });
  return priced == one_computer.end() ? machine : *find_machine_preset(*priced);
}

}  // namespace dmpc::apps
