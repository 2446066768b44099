#include "apps/run/systems.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

// Systems that partitioned space had plain cells with lists of their contents.
constexpr core::Structure cells = core::Structure::voxels, boxes = core::Structure::extents;
constexpr std::array<SystemDescription, 13> descriptions = {{
    {System::replicated, "replicated", "every node has the whole scene and renders its part of the picture", cells,
     "a plain grid, as the article"},
    {System::replicated_extents, "replicated-extents", "the same with one tree of boxes for the scene", boxes,
     "a tree of extents"},
    {System::svm, "svm", "a shared virtual memory (Badouel, Bouatouch, Priol 1994): pages travel from node to node", cells,
     "a plain grid"},
    {System::svm_extents, "svm-extents", "the same with one tree of boxes for the scene, a page each for its subtrees", boxes,
     "nobody described it"},
    {System::svm_resident, "svm-resident",
     "as svm, with the advantages of green-paddon: the host assigns all work, and half of the pages that a node keeps are those "
     "that a small picture uses most",
     boxes, "not described: that of green-paddon, with which it is compared"},
    {System::pixel_machine, "pixel-machine",
     "after the Pixel Machine (Potmesil, Hoffert 1989): each node has every m-th pixel of every n-th line for good, and pages "
     "come from the host, where the article of 1994 says that virtual memory was",
     boxes, "a tree of bounding volumes"},
    {System::green_paddon, "green-paddon",
     "after Green and Paddon (1989): the host has all pages and assigns all work, nodes ask their parents in a tree for pages, "
     "and "
     "half of what a node keeps is what a small picture uses most; the top of their octree, which every node had, is paged, too",
     boxes, "an octree, to which of ours a tree of boxes is nearest"},
    {System::forest, "forest",
     "after Goldsmith and Salmon (1988): every node has the top of one tree and queries the owners of subtrees; idle nodes get "
     "pixels of busy ones, which the original did not do",
     boxes, "a tree of bounding volumes"},
    {System::forest_static, "forest-static",
     "after Goldsmith and Salmon (1988): the same, but each node has every m-th pixel of every n-th line for good", boxes,
     "a tree of bounding volumes"},
    {System::equal_size, "equal-size", "after Cleary and others (1986): rays travel between regions of equal size", cells,
     "cells of equal size"},
    {System::scattered, "scattered",
     "after Kobayashi and others (1988): rays travel between regions of equal size, 16 a node, neighbours on different nodes",
     cells, "cells of equal size"},
    {System::subsampled, "subsampled",
     "Badouel, Bouatouch, Priol (1994): rays travel between regions of equal work, by a small picture", cells, "a plain grid"},
    {System::moving, "moving",
     "after Dippe and Swensen (1984), Nemoto and Omachi (1986): the same, but idle nodes take units of busy ones' regions, with "
     "their rays to come, while rays travel; 16 units a node",
     cells, "cells of equal size (Nemoto, Omachi)"},
}};

std::string text_of_value(std::uint32_t value) { return std::to_string(value); }
std::string text_of_value(const std::optional<std::uint32_t>& value) { return std::to_string(*value); }
template <class T>
std::string text_of_value(const T& value) {
  return std::string(name_of(value));
}

/// The settings of a system; others have render's defaults.
struct SystemSettings {
  Strategy strategy = Strategy::svm;
  core::Structure structure = core::Structure::grid;
  std::optional<std::uint32_t> work_item_side = {};
  std::optional<svm::WorkDonor> work_donor = {};
  std::optional<std::uint32_t> resident_percent = {};
  std::optional<svm::PixelShares> pixel_shares = {};
  std::optional<svm::PageHomes> homes = {};
  std::optional<dataflow::Balance> balance = {};
  std::optional<std::uint32_t> regions_a_node = {};
};

constexpr SystemSettings settings_of(System system) {
  using core::Structure, dataflow::Balance, svm::PageHomes, svm::PixelShares;
  switch (system) {
    case System::replicated:
      return {.strategy = Strategy::replicated};
    case System::replicated_extents:
      return {.strategy = Strategy::replicated, .structure = Structure::extents};
    case System::svm:
      return {.pixel_shares = PixelShares::submaps, .homes = PageHomes::spread};
    case System::svm_extents:
      return {.structure = Structure::extents, .pixel_shares = PixelShares::submaps, .homes = PageHomes::spread};
    case System::pixel_machine:
      return {.structure = Structure::extents,
              .work_item_side = 0,
              .pixel_shares = PixelShares::interleaved,
              .homes = PageHomes::host};
    case System::svm_resident:
      return {.work_donor = svm::WorkDonor::host, .resident_percent = 50, .homes = PageHomes::spread};
    case System::green_paddon:
      return {.work_donor = svm::WorkDonor::host, .resident_percent = 50, .homes = PageHomes::tree};
    case System::forest:
      return {.strategy = Strategy::forest, .structure = Structure::extents};
    case System::forest_static:
      return {.strategy = Strategy::forest,
              .structure = Structure::extents,
              .work_item_side = 0,
              .pixel_shares = PixelShares::interleaved};
    case System::equal_size:
      return {.strategy = Strategy::dataflow, .balance = Balance::equal_size};
    case System::scattered:
      return {.strategy = Strategy::dataflow, .balance = Balance::scattered, .regions_a_node = 16};
    case System::subsampled:
      return {.strategy = Strategy::dataflow, .balance = Balance::subsampled};
    case System::moving:
      break;
  }
  return {.strategy = Strategy::dataflow, .balance = Balance::moving, .regions_a_node = 16};
}

/// Calls visit(option, field, value) for each setting of the system.
template <class Visit>
void for_each_setting(System system, StrategyOptions& run, DatabaseOptions& database, const Visit& visit) {
  const SystemSettings settings = settings_of(system);
  const auto visit_if_said = [&](const char* option, auto& field, const auto& value) {
    if (value) {
      visit(option, field, *value);
    }
  };
  visit("--strategy", run.strategy, settings.strategy);
  visit("--structure", database.build.structure, settings.structure);
  visit_if_said("--work-item", run.pages.work_item_side, settings.work_item_side);
  visit_if_said("--work-donor", run.pages.work_donor, settings.work_donor);
  visit_if_said("--resident", run.pages.resident_percent, settings.resident_percent);
  visit_if_said("--pixels", run.pages.pixel_shares, settings.pixel_shares);
  visit_if_said("--homes", run.pages.homes, settings.homes);
  visit_if_said("--balance", run.rays.balance.balance, settings.balance);
  visit_if_said("--regions", run.rays.balance.regions_a_node, settings.regions_a_node);
}

const SystemDescription& description_of(System system) {
  const auto* const found = std::find_if(descriptions.begin(), descriptions.end(),
                                         [&](const SystemDescription& description) { return description.system == system; });
  core::expect(found != descriptions.end(), "a system has a description");
  return *found;
}

/// Returns whether a structure may replace the system's present one: its original one, or for a grid voxels, which are a grid.
bool may_have(System system, core::Structure structure) {
  return structure == description_of(system).had ||
         (settings_of(system).structure == core::Structure::grid && structure == core::Structure::voxels);
}

}  // namespace

std::span<const SystemDescription> systems() { return descriptions; }

const char* name_of(System system) { return description_of(system).name; }

std::string options_of(System system) {
  StrategyOptions run;
  DatabaseOptions database;
  std::string text;
  for_each_setting(system, run, database, [&](const char* option, const auto&, const auto& value) {
    text += std::string(text.empty() ? "" : " ") + option + "=" + text_of_value(value);
  });
  return text;
}

void add_system_option(OptionSet options, std::optional<System>& system) {
  OptionSet::Choices<System> choices;
  for (const SystemDescription& description : descriptions) {
    choices.push_back({description.name, description.system});
  }
  options.add_choice<System>("--system", system, choices, "none",
                             "A system by name, in place of the options that define it; dmpc list systems lists them");
}

void settle_system(const OptionSet& options, System system, StrategyOptions& run, DatabaseOptions& database) {
  const bool keeps_structure = options.is_given("--structure") && may_have(system, database.build.structure);
  for_each_setting(system, run, database, [&](const char* option, auto& field, const auto& value) {
    if (keeps_structure && std::string_view(option) == "--structure") {
      return;
    }
    if (options.is_given(option) && field != value) {
      throw core::UsageError(std::string(option) + "=" + text_of_value(field) + " does not go with --system=" + name_of(system) +
                             ", which is " + options_of(system));
    }
    field = value;
  });
}

}  // namespace dmpc::apps
